#include "python/module/call_command.h"

#include <cstdio>
#include <cstdlib>
#include <mutex>

#include "app/commands/commands.h"
#include "app/commands/progress.h"
#include "core/base/errors.h"
#include "python/module/background.h"

namespace ambrig::python {

namespace py = pybind11;

namespace {

/// What C and C++ print goes to a string while it lives; Python's own prints go where they went.
class PrintedText {
 public:
  PrintedText() : before_(stdout) {
    std::fflush(stdout);
    if (FILE* file = open_memstream(&text_, &size_)) stdout = file;
  }
  ~PrintedText() {
    Close();
    std::free(text_);
  }
  PrintedText(const PrintedText&) = delete;
  PrintedText& operator=(const PrintedText&) = delete;
  std::string Text() {
    Close();
    return text_ ? std::string(text_, size_) : std::string();
  }

 private:
  void Close() {
    if (stdout == before_) return;
    std::fclose(stdout);
    stdout = before_;
  }
  FILE* before_;
  char* text_ = nullptr;
  std::size_t size_ = 0;
};

int Call(const std::vector<std::string>& arguments) {
  CLI::App app{"", "ambrig"};
  Work work;
  AddCommands(app, work);
  std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());  // as CLI11 wants them
  try {
    app.parse(reversed);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    throw InputError("ambrig " + (arguments.empty() ? "" : arguments[0]) + ": " + e.what());
  }
  return work ? work() : 0;
}

}  // namespace

py::tuple CallCommand(const std::vector<std::string>& arguments, const py::object& progress) {
  static std::timed_mutex one_at_a_time;
  while (true) {  // another thread's command: Ctrl-C ends the waiting too
    {
      const py::gil_scoped_release released;
      if (one_at_a_time.try_lock_for(std::chrono::milliseconds(80))) break;
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  const std::lock_guard guard(one_at_a_time, std::adopt_lock);
  Watch watch;
  watch.stop = &interrupted;
  interrupted = false;
  Progress::Listen([&](double fraction) { watch.fraction = fraction; });
  struct Silence {
    ~Silence() { Progress::Listen({}); }
  } silence;
  PrintedText printed;
  int code = 0;
  InBackground([&] { code = Call(arguments); }, watch, progress);
  return py::make_tuple(code, printed.Text());
}

}  // namespace ambrig::python
