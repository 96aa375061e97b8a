#pragma once
/// What a command tells a program that started it (`--events FD`): one JSON object a line.
///   {"event":"stage","stage":"screening"}               another part of the work begins
///   {"event":"progress","share":0.42,"text":"...","seconds":3.1}   at most five a second
///   {"event":"partial","result":{...}}                  the answer so far, at most one a second
///   {"event":"warning","text":"..."}
///   {"event":"done","code":0}                           the last line; with "error" where there is
///   one
/// A reader that goes away ends the work as Ctrl-C does.
#include <atomic>
#include <chrono>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace ambrig {

class EventStream {
 public:
  using Clock = std::chrono::steady_clock;

  /// Writes to this file descriptor from now on; `stop` is set when its reader goes away.
  /// @throws InputError when it cannot be written.
  void Open(int file, std::atomic<bool>* stop);
  bool open() const { return file_.load(std::memory_order_relaxed) >= 0; }

  void Stage(std::string_view name);  // a repeated name is told once
  void Share(double fraction, std::string_view text);
  void Partial(const nlohmann::ordered_json& result);
  void Warning(std::string_view text);
  void Done(int code, std::string_view error = {});

 private:
  void Put(const nlohmann::ordered_json& line);
  /// Whether `last` lies at least `least` back; it is then set to now.
  bool Due(Clock::time_point* last, Clock::duration least);

  std::atomic<int> file_{-1};
  std::atomic<bool>* stop_ = nullptr;
  std::mutex mutex_;
  std::string stage_;
  Clock::time_point begin_{}, share_{}, partial_{};
};

/// The process has one.
EventStream& Events();

}  // namespace ambrig
