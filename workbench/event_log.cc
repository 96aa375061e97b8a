#include "workbench/event_log.h"

namespace ambrig::workbench {
namespace {
constexpr std::size_t kMostLines = 4000;
}

void EventLog::Add(nlohmann::ordered_json event) {
  const std::scoped_lock lock(mutex_);
  event["seq"] = first_ + lines_.size();
  lines_.push_back(event.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
                   '\n');
  if (lines_.size() > kMostLines) {
    lines_.pop_front();
    ++first_;
  }
  changed_.notify_all();
}

std::string EventLog::After(std::uint64_t* seq, std::chrono::milliseconds wait) {
  std::unique_lock lock(mutex_);
  const auto end = [&] { return first_ + lines_.size() - 1; };
  if (*seq > end() || *seq + 1 < first_) {
    *seq = end();
    return "{\"event\":\"resync\",\"seq\":" + std::to_string(*seq) + "}\n";
  }
  changed_.wait_for(lock, wait, [&] { return closed_ || *seq < end(); });
  if (closed_) return "";
  if (*seq >= end()) return "{\"event\":\"beat\"}\n";
  std::string text;
  while (*seq < end() && text.size() < (1 << 19)) text += lines_[++*seq - first_];
  return text;
}

std::uint64_t EventLog::last() const {
  const std::scoped_lock lock(mutex_);
  return first_ + lines_.size() - 1;
}

void EventLog::Close() {
  const std::scoped_lock lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

}  // namespace ambrig::workbench
