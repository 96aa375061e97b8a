#pragma once
/// Looks at the folder every few seconds (files arrive by rename, also over a network, where the
/// kernel tells nothing): tells the pages what changed, and starts `ambrig watch` for the folders
/// that a logger writes to.
#include <condition_variable>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "workbench/event_log.h"
#include "workbench/jobs.h"
#include "workbench/served_folder.h"

namespace ambrig::workbench {

class WatchedFolders {
 public:
  WatchedFolders(const ServedFolder& folder, Jobs& jobs, EventLog& events);
  ~WatchedFolders();

  /// [ { "case", "folder" } ], kept in .ambrig/watched.json.
  nlohmann::ordered_json All() const;
  /// @throws InputError
  void Set(const std::string& case_file, const std::string& folder, bool on);

 private:
  struct Watched {
    std::string case_file, folder;
    std::string seen;  // the finished files when `ambrig watch` was last started
  };
  void Look();
  void TellChanges(const std::vector<ServedFile>& files);
  void StartWatches(const std::vector<ServedFile>& files);
  void Store() const;

  const ServedFolder& folder_;
  Jobs& jobs_;
  EventLog& events_;
  mutable std::mutex mutex_;
  std::condition_variable closed_;
  bool closing_ = false;
  std::vector<Watched> watched_;
  std::map<std::string, std::pair<std::uint64_t, double>> known_;  // size, time
  bool first_ = true;
  std::thread thread_;
};

}  // namespace ambrig::workbench
