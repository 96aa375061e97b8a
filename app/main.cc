#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <new>
#include <system_error>

#include "app/commands/command.h"
#include "app/commands/command_line.h"
#include "app/commands/event_stream.h"
#include "app/json/provenance.h"
#include "app/text/screen.h"
#include "core/base/errors.h"
#include "core/math/no_solution.h"

namespace {

/// Output that was not read to its end (`ambrig parameters | head`) is no error.
bool IsClosedPipe(const std::system_error& e) { return e.code().value() == EPIPE; }

/// The disk that standard output goes to is full or broken: all other outputs name their file
/// themselves.
bool CannotPrint(const std::system_error& e) {
  const int code = e.code().value();
  return code == ENOSPC || code == EDQUOT || code == EFBIG || code == EIO;
}

/// One line for the person, the same for the program that listens.
int Fail(int code, const std::string& what) {
  const std::string line = ambrig::PrintableLine(what);
  fmt::print(stderr, "ambrig: {}\n", line);
  ambrig::Events().Done(code, line);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGINT, [](int) { ambrig::interrupted = true; });
  std::signal(SIGTERM, [](int) { ambrig::interrupted = true; });
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of its writer
  ambrig::SetCommandLine(argc, argv);
  try {
    const int code = ambrig::RunCommandLine(argc, argv);
    ambrig::Events().Done(code);
    return code;
  } catch (const ambrig::InputError& e) {
    return Fail(2, e.what());
  } catch (const ambrig::NoSolution& e) {
    return Fail(2, e.what());
  } catch (const ambrig::Interrupted&) {
    ambrig::TellInterrupted();
    return ambrig::kInterruptedCode;
  } catch (const std::filesystem::filesystem_error& e) {
    return Fail(2, fmt::format("{}: {}", e.path1().string(), e.code().message()));
  } catch (const std::bad_alloc&) {
    return Fail(2, "this needs more memory than the machine has");
  } catch (const std::system_error& e) {
    if (IsClosedPipe(e)) return 0;
    if (CannotPrint(e))
      return Fail(2, fmt::format("cannot write standard output: {}", e.code().message()));
    return Fail(3, fmt::format("program error: {}", e.what()));
  } catch (const std::exception& e) {
    return Fail(3, fmt::format("program error: {}", e.what()));
  }
}
