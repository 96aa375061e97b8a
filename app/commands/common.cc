#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "app/commands/commands.h"
#include "app/commands/event_stream.h"
#include "app/commands/outputs.h"
#include "core/base/atomic_file.h"
#include "core/base/errors.h"
#include "scenarios/scenario.h"

namespace ambrig {

void CommonOptions::AddTo(CLI::App& command) {
  command.add_option("--json", json, "write the result as JSON to FILE")
      ->type_name("FILE")
      ->check(OutputFile());
  command.add_option("--html", html, "write the report as one HTML file to FILE")
      ->type_name("FILE")
      ->check(OutputFile());
  if (command.get_option_no_throw("--events") == nullptr)  // `diff` compares events, in no time
    command
        .add_option_function<int>(
            "--events", [](int file) { Events().Open(file, &interrupted); },
            "write stages, progress and the end as JSON lines to this open file descriptor")
        ->type_name("FD")
        ->check(CLI::Range(0, 1 << 20));
  command.add_flag("--force", force, kForceHelp);
}

void CommonOptions::CheckOutputs(const std::vector<std::string>& inputs,
                                 std::vector<std::string> more) const {
  more.push_back(json);
  more.push_back(html);
  for (const std::string& file : more) RefuseInputAsOutput(file, inputs);
  RefuseOneFileTwice(more);
  RefuseOverwriting(more, force);
}

void CommonOptions::WriteJson(const nlohmann::ordered_json& document) const {
  if (!json.empty()) WriteFileAtomically(json, MarkedJson(document));
}

std::vector<std::string> FindFiles(const std::vector<std::string>& paths,
                                   const std::function<bool(const std::filesystem::path&)>& wanted,
                                   const char* none) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    if (!std::filesystem::exists(path))
      throw InputError(fmt::format("{}: no such file or folder", path));
    if (!std::filesystem::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    std::error_code error;
    std::filesystem::recursive_directory_iterator entry(path, error), end;
    for (; !error && entry != end; entry.increment(error))
      if (wanted(entry->path())) files.push_back(entry->path().string());
    if (error) throw InputError(fmt::format("{}: {}", path, error.message()));
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) throw InputError(none);
  return files;
}

namespace {

/// A file that cannot be read counts too: the row of it says why, and the others are run.
bool IsScenario(const std::filesystem::path& file) {
  if (file.extension() != ".toml") return false;
  try {
    return HasExpectations(file.string());
  } catch (const InputError&) {
    return true;
  }
}

}  // namespace

std::vector<std::string> FindScenarios(const std::vector<std::string>& paths) {
  return FindFiles(
      paths, IsScenario,
      "no scenario with [expect] found, allowed: files, or folders whose scenarios have a table "
      "[expect] (it may be empty)");
}

bool ColourTerminal() { return isatty(STDOUT_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr; }

std::string Coloured(const std::string& text, const char* colour) {
  if (!ColourTerminal()) return text;
  const std::string c = colour;
  const char* code = c == "green" ? "32" : c == "red" ? "31" : c == "yellow" ? "33" : "1";
  return std::string("\033[") + code + "m" + text + "\033[0m";
}

}  // namespace ambrig
