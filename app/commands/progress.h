#pragma once
/// A progress bar on stderr: text, bar, per cent, time left. Nothing at all unless stderr is a
/// terminal. Update may be called from any thread and as often as one likes: between two redraws
/// it costs one clock reading and one atomic load. The same goes to the stream of --events
/// (event_stream.h), where the title is the name of a stage.
#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>

namespace ambrig {

class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Progress(std::string title);
  /// For tests: draws to `file` descriptor when `draw`.
  Progress(std::string title, int file, bool draw);
  ~Progress();  // clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// fraction in [0, 1]; `text` says what is going on ("t = 1.2 s, 31x real time").
  void Update(double fraction, std::string_view text = {});
  /// Every update of every bar from now on is told to `listener` too, from the thread that makes
  /// it; an empty one ends that. For a program that shows its own (Python).
  static void Listen(std::function<void(double fraction)> listener);
  /// Clears the bar so that a line may be printed; the next Update draws it again.
  void Clear();

 private:
  /// Columns of the terminal, 80 where it does not say.
  std::size_t Columns() const;
  void Draw(double fraction, std::string_view text, Clock::time_point now);

  const std::string title_;
  const int file_;
  const bool draw_;
  const Clock::time_point begin_;
  std::atomic<Clock::rep> next_;  // no redraw before this time
  std::mutex mutex_;
  bool drawn_ = false;
};

/// Title, bar and text of one line of the terminal, never as wide as `columns`: the text is cut.
std::string ProgressLine(std::string_view title, double fraction, double elapsed,
                         std::string_view text, std::size_t columns);

/// "[#######-----]  58 %  00:12 left" : the bar's text for a fraction after `elapsed` seconds.
std::string ProgressText(double fraction, double elapsed, int width = 16);

}  // namespace ambrig
