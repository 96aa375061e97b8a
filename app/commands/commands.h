#pragma once
/// The commands of `ambrig`: each one parses its options, calls, prints. Exit codes: 0 done, 1 an
/// expectation is not met, 2 wrong input, 3 an error of the program, 130 interrupted.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/commands/command.h"

namespace ambrig {

inline constexpr const char* kForceHelp =
    "overwrite also files that ambrig did not make, and TOML that somebody changed since";

/// Options that every command has.
struct CommonOptions {
  std::string json, html;
  bool force = false;  // overwrite what ambrig did not make
  void AddTo(CLI::App& command);
  /// Before the work: the output files may be written and replace no `inputs` and nothing that
  /// ambrig did not make; `more`: files of the command's own. @throws InputError
  void CheckOutputs(const std::vector<std::string>& inputs,
                    std::vector<std::string> more = {}) const;
  /// Writes the JSON if asked for (temporary name, then renamed).
  void WriteJson(const nlohmann::ordered_json& document) const;
};

/// Files as given and the `wanted` ones in the given folders, sorted. @throws InputError (`none`:
/// nothing found)
std::vector<std::string> FindFiles(const std::vector<std::string>& paths,
                                   const std::function<bool(const std::filesystem::path&)>& wanted,
                                   const char* none);
/// Scenario files as given and those with [expect] in the given folders, sorted. @throws InputError
std::vector<std::string> FindScenarios(const std::vector<std::string>& paths);

/// 1 for a yes, else 0; terminal colours only on a terminal.
bool ColourTerminal();
std::string Coloured(const std::string& text,
                     const char* colour);  // "green" | "red" | "yellow" | "bold"

}  // namespace ambrig
