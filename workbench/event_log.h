#pragma once
/// What happened, numbered, for every page that listens.
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

namespace ambrig::workbench {

class EventLog {
 public:
  /// Gives the event its number `seq`. The oldest are forgotten beyond some thousand.
  void Add(nlohmann::ordered_json event);
  /// Lines (JSON, each ended by a newline) after `seq`, which becomes the last one's number. Waits
  /// for one up to `wait`; then a line {"event":"beat"}. {"event":"resync"} where numbers were
  /// forgotten or are not of this server. "" once closed.
  std::string After(std::uint64_t* seq, std::chrono::milliseconds wait);
  std::uint64_t last() const;
  /// Ends all waits.
  void Close();

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> lines_;
  std::uint64_t first_ = 1;  // number of lines_.front()
  bool closed_ = false;
};

}  // namespace ambrig::workbench
