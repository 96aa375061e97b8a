#pragma once
/// A page as a headless browser builds it, for tests of reports.
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/core/temporary_folder.h"

namespace ambrig::testing {

struct BuiltPage {
  int exit_code = -1;
  std::string dom, console;  // the document after all scripts; what the browser logged

  std::size_t Count(const std::string& what) const {
    std::size_t n = 0;
    for (std::size_t at = dom.find(what); at != std::string::npos; at = dom.find(what, at + 1)) ++n;
    return n;
  }
  /// Figures that the plotting library drew.
  std::size_t figures() const { return Count("class=\"plot js-plotly-plot\""); }
  bool clean() const { return console.find("CONSOLE") == std::string::npos; }
};

inline bool HasBrowser() { return std::system("command -v chromium > /dev/null 2>&1") == 0; }

inline BuiltPage BuildInBrowser(const std::filesystem::path& page) {
  const TemporaryFolder folder;
  const std::string command =
      "chromium --headless --no-sandbox --disable-gpu --no-first-run "
      "--disable-background-networking "
      "--disable-component-update --disable-sync --user-data-dir=" +
      folder.File("profile") +
      " --window-size=1300,14000 --virtual-time-budget=8000 --enable-logging=stderr --dump-dom "
      "file://" +
      std::filesystem::absolute(page).string() + " 2> " + folder.File("console.txt");
  BuiltPage built;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return built;
  std::array<char, 65536> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    built.dom.append(buffer.data(), n);
  built.exit_code = WEXITSTATUS(pclose(pipe));
  std::ifstream file(folder.File("console.txt"));
  built.console.assign(std::istreambuf_iterator<char>(file), {});
  return built;
}

}  // namespace ambrig::testing
