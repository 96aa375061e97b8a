#pragma once
/// Commanded signals of a scenario: force, reference, current or duty over time.
/// Every kind is zero outside [start, stop). Source: docs/guide/files.md.
#include <string>
#include <vector>

#include "core/base/toml.h"

namespace ambrig {

struct Excitation {
  std::string target;  // "A.x", "z", "A.coil1"
  std::string port;    // force | reference | current | duty
  std::string kind;    // multisine | sine | chirp | step | pulse | ramp | samples
  double start = 0, stop = kInfinity;
  double amplitude = 1;
  double frequency = 0, phase = 0, f0 = 0, f1 = 0;
  std::vector<double> frequencies, phases;
  std::vector<double> samples;
  double sample_rate = 0, sample_start = 0;
  std::string where;  // file:line for errors

  double Value(double t) const;
  /// Where the row after the last sample would stand [s]; from there on the last value holds.
  double SamplesEnd() const {
    return sample_start + static_cast<double>(samples.size()) / sample_rate;
  }
};

/// Reads one [[excitation]]; relative sample files are looked up beside the scenario.
Excitation ReadExcitation(const TomlTable& table, const std::string& directory, double duration);

}  // namespace ambrig
