#pragma once
/// The records of a folder that a logger writes to, examined one by one as they come and kept in a
/// journal.
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/journal.h"
#include "discovery/watch/record_state.h"

namespace ambrig {

struct WatchOptions {
  std::string case_file, folder, journal;
  double settle = 5;    // [s] without a change, then a file is taken as finished
  bool explain = true;  // what left its band
  int candidates = 5;   // of an explanation
};

class FolderWatch {
 public:
  using Progress = std::function<void(double fraction, const std::string& text)>;

  /// Reads case and journal. @throws InputError
  explicit FolderWatch(WatchOptions options);

  /// Examines the files that are new and finished, oldest first; each is in the journal before the
  /// next begins. `told` is called after each. @return names of the records of this pass
  /// @throws InputError for a case that cannot be used, Interrupted
  std::vector<std::string> Pass(const Progress& progress,
                                const std::function<void(const nlohmann::ordered_json&)>& told);
  /// "case", "folder", "journal", "references", "records" by time, "waiting", "warnings".
  nlohmann::ordered_json Document() const;

 private:
  struct Found {
    std::string name, path;  // in the folder
    std::uint64_t size = 0;
    double changed = 0;  // [s] since 1970
  };
  std::vector<Found> NewFiles();
  bool Known(const Found& file) const;
  nlohmann::ordered_json Examine(const Found& file, const Progress& progress);
  /// The state of the case's own record, from the journal where it is of the same model.
  RecordState ReferenceOf(std::size_t record, const std::string& model);
  void Explained(const std::string& text, nlohmann::ordered_json& entry, const Progress& progress);
  void Keep(const nlohmann::ordered_json& entry);

  const WatchOptions options_;
  std::string case_text_, rig_text_;
  std::vector<std::string> stems_;       // of the case's records
  std::vector<std::string> data_files_;  // of the case's records
  std::vector<nlohmann::ordered_json> entries_;
  std::vector<std::string> waiting_;  // files that are still written to
  std::unique_ptr<Journal> journal_;
};

}  // namespace ambrig
