#include "app/commands/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "app/commands/event_stream.h"
#include "app/text/screen.h"

namespace ambrig {
namespace {

constexpr auto kRedraw = std::chrono::milliseconds(100);

void Put(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(file, text.data(), text.size());
    if (n <= 0) return;  // a closed terminal is no reason to stop the work
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

std::string Minutes(double seconds) {
  const long s = std::lround(seconds);
  return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60)
                   : fmt::format("{:02}:{:02}", s / 60, s % 60);
}

std::mutex listener_mutex;
std::function<void(double)> listener;
std::atomic<bool> listening{false};

void TellListener(double fraction) {
  if (!listening.load(std::memory_order_relaxed)) return;
  const std::lock_guard guard(listener_mutex);
  if (listener) listener(fraction);
}

}  // namespace

void Progress::Listen(std::function<void(double)> told) {
  const std::lock_guard guard(listener_mutex);
  listener = std::move(told);
  listening = static_cast<bool>(listener);
}

std::string ProgressText(double fraction, double elapsed, int width) {
  const double done = std::isnan(fraction) ? 0.0 : std::clamp(fraction, 0.0, 1.0);
  const int full = static_cast<int>(done * width);
  std::string text =
      fmt::format("[{}{}] {:3.0f} %", std::string(static_cast<std::size_t>(full), '#'),
                  std::string(static_cast<std::size_t>(width - full), '-'), std::floor(100 * done));
  // Before two per cent or half a second the estimate is noise.
  if (done >= 1)
    text += "  " + Minutes(elapsed);
  else if (done > 0.02 && elapsed > 0.5)
    text += "  " + Minutes(elapsed * (1 - done) / done) + " left";
  return text;
}

std::string ProgressLine(std::string_view title, double fraction, double elapsed,
                         std::string_view text, std::size_t columns) {
  // A line as wide as the terminal wraps on some; a title leaves room for the bar.
  const std::size_t room = std::max<std::size_t>(columns, 2) - 1;
  std::string line = Shortened(title, room / 3) + " " + ProgressText(fraction, elapsed);
  if (!text.empty()) line += "  " + std::string(text);
  return Shortened(line, room);
}

Progress::Progress(std::string title)
    : Progress(std::move(title), STDERR_FILENO, ::isatty(STDERR_FILENO) == 1) {
  Events().Stage(title_);
}

Progress::Progress(std::string title, int file, bool draw)
    : title_(std::move(title)),
      file_(file),
      draw_(draw),
      begin_(Clock::now()),
      next_(begin_.time_since_epoch().count()) {}

Progress::~Progress() { Clear(); }

void Progress::Update(double fraction, std::string_view text) {
  TellListener(fraction);
  Events().Share(fraction, text);
  if (!draw_) return;
  const auto now = Clock::now();
  Clock::rep due = next_.load(std::memory_order_relaxed);
  if (now.time_since_epoch().count() < due) return;
  const Clock::rep later = (now + kRedraw).time_since_epoch().count();
  if (!next_.compare_exchange_strong(due, later, std::memory_order_relaxed)) return;
  Draw(fraction, text, now);
}

std::size_t Progress::Columns() const {
  winsize size{};
  return ::ioctl(file_, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kScreenColumns;
}

void Progress::Draw(double fraction, std::string_view text, Clock::time_point now) {
  const double elapsed = std::chrono::duration<double>(now - begin_).count();
  const std::lock_guard lock(mutex_);
  // \r and "erase to the end of the line": the bar stays on one line.
  Put(file_, fmt::format("\r{}\x1b[K", ProgressLine(title_, fraction, elapsed, text, Columns())));
  drawn_ = true;
}

void Progress::Clear() {
  const std::lock_guard lock(mutex_);
  if (drawn_) Put(file_, "\r\x1b[K");
  drawn_ = false;
}

}  // namespace ambrig
