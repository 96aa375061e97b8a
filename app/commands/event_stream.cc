#include "app/commands/event_stream.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

#include "core/base/errors.h"

namespace ambrig {
namespace {

constexpr auto kBetweenShares = std::chrono::milliseconds(200);
constexpr auto kBetweenPartials = std::chrono::seconds(1);

}  // namespace

void EventStream::Open(int file, std::atomic<bool>* stop) {
  const int flags = ::fcntl(file, F_GETFL);
  if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY)
    throw InputError(
        fmt::format("--events {}: is not open for writing, allowed: a file descriptor that the "
                    "caller opened, as in --events 3 3>events.jsonl",
                    file));
  begin_ = Clock::now();
  stop_ = stop;
  file_ = file;
}

bool EventStream::Due(Clock::time_point* last, Clock::duration least) {
  const auto now = Clock::now();
  const std::scoped_lock lock(mutex_);
  if (last->time_since_epoch().count() != 0 && now - *last < least) return false;
  *last = now;
  return true;
}

void EventStream::Put(const nlohmann::ordered_json& line) {
  std::string text =
      line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
  const std::scoped_lock lock(mutex_);
  std::string_view rest = text;
  while (!rest.empty()) {
    const ssize_t n = ::write(file_, rest.data(), rest.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      file_ = -1;
      *stop_ = true;
      return;
    }
    rest.remove_prefix(static_cast<std::size_t>(n));
  }
}

void EventStream::Stage(std::string_view name) {
  if (!open()) return;
  {
    const std::scoped_lock lock(mutex_);
    if (stage_ == name) return;
    stage_ = name;
  }
  Put({{"event", "stage"}, {"stage", name}});
}

void EventStream::Share(double fraction, std::string_view text) {
  if (!open() || std::isnan(fraction) || !Due(&share_, kBetweenShares)) return;
  Put({{"event", "progress"},
       {"share", std::clamp(fraction, 0.0, 1.0)},
       {"text", text},
       {"seconds", std::chrono::duration<double>(Clock::now() - begin_).count()}});
}

void EventStream::Partial(const nlohmann::ordered_json& result) {
  if (open() && Due(&partial_, kBetweenPartials)) Put({{"event", "partial"}, {"result", result}});
}

void EventStream::Warning(std::string_view text) {
  if (open()) Put({{"event", "warning"}, {"text", text}});
}

void EventStream::Done(int code, std::string_view error) {
  if (!open()) return;
  nlohmann::ordered_json line{{"event", "done"}, {"code", code}};
  if (!error.empty()) line["error"] = error;
  Put(line);
}

EventStream& Events() {
  static EventStream events;
  return events;
}

}  // namespace ambrig
