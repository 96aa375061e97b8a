#pragma once
/// Rotors whose numbers scatter: every number of a shaft's file that has an `sd` is drawn from its normal
/// distribution (drawn again outside its physical range), the modes of every such rotor are found at one
/// speed, and of each mode of the rotor as it stands in the file the quantiles of frequency and log
/// decrement are taken. The k-th rotor is the same whatever the number of threads and of rotors.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/base/toml.h"
#include "rotor/shaft/beam_file.h"

namespace ambrig {

struct ScatterBand {
  double low = 0, middle = 0, high = 0;  // 5, 50 and 95 % quantiles
};

struct ScatteredMode {
  double nominal_frequency = 0, nominal_decrement = 0;  // [Hz], [-]
  ScatterBand frequency, decrement;
};

struct ShaftScatter {
  std::vector<std::string> parameters;  // that have an sd
  int rotors = 0;
  double speed = 0;  // [rad/s]
  std::vector<ScatteredMode> modes;
};

/// `tolerances` as ReadBeam gives them with `file`. @throws InputError when no number has an sd.
ShaftScatter ScatterShaft(const BeamFile& file, const std::vector<Tolerance>& tolerances,
                          double speed, int modes, int rotors, std::uint64_t seed,
                          const std::function<bool(double)>& go_on = nullptr);

}  // namespace ambrig
