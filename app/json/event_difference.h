#pragma once
/// Events of two runs (the "events" of NAME.json) beside each other: which came, went or moved.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ambrig {

struct EventDifference {
  enum class Kind { kCame, kWent, kMoved };
  Kind kind = Kind::kCame;
  std::string event;             // "detected A.coil3", with the class when there is one
  double before = 0, after = 0;  // [s]; of a moved one both
};

/// Events of a kind, target and class belong together in their order; where one run has more of
/// them, those are the new (or gone) ones without which the others moved least. One has moved when
/// its times differ by more than `tolerance` [s]. Earliest first.
std::vector<EventDifference> CompareEvents(const nlohmann::json& a, const nlohmann::json& b,
                                           double tolerance);

/// @throws InputError for an array of anything but events of a run; `file`: that it stands in.
void CheckEvents(const nlohmann::json& events, const std::string& file);

/// "detected A.coil3 moved from 20.12 ms to 20.20 ms".
std::string EventDifferenceText(const EventDifference& e);

}  // namespace ambrig
