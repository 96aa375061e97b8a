#pragma once
/// Two runs compared, record and events, as text lines and as JSON.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/json/event_difference.h"
#include "core/record/record_difference.h"

namespace ambrig {

/// A run as it stands in files: the record and, where NAME.json lies beside it, the events.
struct RunFiles {
  std::string file;
  Record record;
  nlohmann::json events;  // null: no NAME.json
};

/// @throws InputError
RunFiles ReadRun(const std::string& record_file);

struct RunDifference {
  std::string a, b;  // files
  RecordDifference record;
  bool events_known = false;
  std::vector<EventDifference> events;
  bool identical() const { return record.identical() && events.empty(); }
  bool agrees() const { return record.agrees() && events.empty(); }
};

RunDifference CompareRuns(const RunFiles& a, const RunFiles& b, const RecordTolerances& t);

/// What differs, the first instant and channel first; one line each, no more than `most` events
/// and `most` channels.
std::vector<std::string> DifferenceLines(const RunDifference& d, std::size_t most = 10);

nlohmann::ordered_json DifferenceJson(const RunDifference& d);

}  // namespace ambrig
