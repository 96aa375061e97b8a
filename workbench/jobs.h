#pragma once
/// Commands as child processes of this binary: a queue, their progress, their end. What a job did
/// stands in .ambrig/jobs/N of the served folder (job.json, events.jsonl, log.txt, result.json,
/// report.html), so that a killed server or a closed page loses nothing.
#include <condition_variable>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "workbench/event_log.h"
#include "workbench/job_table.h"

namespace ambrig::workbench {

struct Job {
  int id = 0;
  JobOrder order;
  std::string state = "queued";  // queued, running, done, failed, stopped, interrupted
  std::string error, started;    // one line; ISO 8601, UTC
  int code = -1;                 // exit code
  double seconds = 0;
  int pid = 0;
  bool stop = false;
};

class Jobs {
 public:
  /// Runs of the playground that are kept, the newest: each change of it makes some, and nobody
  /// comes back to the old ones.
  static constexpr int kRunsKept = 60;

  /// Reads the jobs of earlier servers: those that were running are "interrupted".
  /// `program`: this binary. @throws InputError
  Jobs(const ServedFolder& folder, std::string program, EventLog& events);
  ~Jobs();  // stops what runs

  /// Checks and queues. @throws InputError
  nlohmann::ordered_json Start(const nlohmann::json& request);
  /// nullptr JSON when there is none.
  nlohmann::ordered_json State(int id) const;
  nlohmann::ordered_json All() const;
  /// Ctrl-C, after ten seconds SIGKILL. False when there is none or it has ended.
  bool Stop(int id);
  /// Whether a job of a command about a file waits or runs.
  bool Active(const std::string& command, const std::string& subject) const;
  /// The newest finished job of a command about a file; 0: none.
  int Latest(const std::string& command, const std::string& subject) const;
  std::string FolderOf(int id) const;  // absolute

 private:
  void ReadEarlier();
  void ForgetOldRunsLocked();
  void Work();
  void RunJob(int id);
  void TakeLine(int id, const std::string& line);
  void Finish(int id, int code, double seconds);
  std::string LastWords(int id) const;
  nlohmann::ordered_json JsonOf(const Job& job) const;
  void Store(const Job& job) const;
  Job* NextLocked();

  const ServedFolder& folder_;
  const std::string program_;
  EventLog& events_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::map<int, Job> jobs_;
  int heavy_running_ = 0, light_running_ = 0;
  bool closing_ = false;
  std::vector<std::thread> workers_, killers_;
};

}  // namespace ambrig::workbench
