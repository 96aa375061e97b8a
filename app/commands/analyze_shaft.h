#pragma once
/// ambrig analyze of a file without magnetic bearings: a beam of ours with [rotor], or ROSS's.
#include "analysis/shaft/shaft_analysis.h"
#include "app/commands/commands.h"

namespace ambrig {

/// Options that a shaft alone has.
struct ShaftCommand {
  std::vector<std::string> unbalance, probes, forces, coupling, alford;
  std::string ground;
  double grade = 0;  // [mm/s]
  int modes = 10, rotors = 0;
  bool campbell = false;
  std::uint64_t seed = 1;

  void AddTo(CLI::App& command);
  /// Names of the options that were given, "" when none.
  std::string Given() const;
};

/// What both kinds of file take.
struct ShaftRequest {
  std::string file, out;
  double lowest = 0, highest = 0, fastest = 0;  // [rad/s]
};

/// @throws InputError naming the option.
ShaftOptions ReadShaftOptions(const ShaftRequest& request, const ShaftCommand& command);

/// Whether a file holds a shaft alone: JSON, ROSS's TOML, or a [rotor] without bearings and
/// controller.
bool IsShaftFile(const std::string& file);

/// Exit code.
int AnalyseShaftFile(const ShaftRequest& request, const ShaftCommand& shaft,
                     const CommonOptions& common);

}  // namespace ambrig
