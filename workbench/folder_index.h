#pragma once
/// What the folder holds: each file's kind, hash, and for a result whether it is still that of the
/// files.
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "workbench/jobs.h"
#include "workbench/served_folder.h"

namespace ambrig::workbench {

class FolderIndex {
 public:
  FolderIndex(const ServedFolder& folder, const Jobs& jobs) : folder_(folder), jobs_(jobs) {}

  /// { "files": [ { "name", "kind", "size", "changed" } ], "cases": [ { "name", "records",
  /// "rig", "compare": {...}, "explain": {...}, "watch": {...} } ], "scenarios": [ { "name", "run"
  /// } ], "campaigns": [ { "name", "campaign" } ] }; kind: case, rig, scenario, campaign, study,
  /// record, result, report, other.
  nlohmann::ordered_json Folder();
  /// A file with its hash; "" when it cannot be read.
  std::string HashOf(const std::string& name);
  /// The newest finished result of `command` about `subject`: { "job", "result", "fresh", "stale":
  /// [ files that changed since ] }; null when there is none.
  nlohmann::ordered_json Result(const std::string& command, const std::string& subject);

 private:
  struct Known {
    double changed = 0;
    std::uint64_t size = 0;
    std::string kind, hash;
    std::size_t records = 0;
    std::string rig;
  };
  Known& About(const ServedFile& file);
  nlohmann::ordered_json CaseJson(const ServedFile& file, const Known& known);
  nlohmann::ordered_json SubjectJson(const std::string& name,
                                     const std::vector<const char*>& commands);
  /// What the lists show of a finished job, and the hashes of what it read.
  nlohmann::ordered_json Short(const std::string& command, int job);
  nlohmann::ordered_json StaleOf(const nlohmann::ordered_json& inputs);

  const ServedFolder& folder_;
  const Jobs& jobs_;
  std::mutex mutex_;
  std::map<std::string, Known> known_;
  std::map<int, nlohmann::ordered_json> short_;  // by job: its result never changes
};

}  // namespace ambrig::workbench
