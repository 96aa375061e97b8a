#pragma once
/// Rotors whose numbers scatter: every number of a shaft's file that has an `sd` is sampled from
/// its normal distribution (sampled again outside its physical range). Of every such rotor the
/// modes at one speed, the damped critical speeds and the response to given unbalances are
/// computed, and the quantiles taken over the rotors: of each mode and each critical speed of the
/// rotor as it stands in the file, and of the orbit's long half axis at each probe and speed. The
/// k-th rotor is the same whatever the number of threads and of rotors.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "analysis/shaft/shaft_campbell.h"
#include "analysis/shaft/shaft_unbalance.h"
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

struct ScatteredCritical {
  DampedCritical nominal;
  ScatterBand speed, decrement;  // [rad/s], [-]
  int found = 0;                 // rotors that have it; the others are not in the bands
};

struct ScatteredResponse {
  std::string unbalance, probe;
  std::vector<double> nominal;         // long half axis at each speed [m]
  std::vector<ScatterBand> amplitude;  // [m]
};

struct ScatterPlan {
  double speed = 0;  // of the modes [rad/s]
  int modes = 10, rotors = 100;
  std::uint64_t seed = 1;
  std::vector<DampedCritical> criticals;  // of the rotor as it stands in the file
  std::vector<UnbalanceCase> unbalance;   // the same for every rotor
  std::vector<ShaftProbe> probes;
  std::vector<double> speeds;  // of the response [rad/s]
};

struct ShaftScatter {
  std::vector<std::string> parameters;  // that have an sd
  int rotors = 0;
  double speed = 0;  // [rad/s]
  std::vector<ScatteredMode> modes;
  std::vector<ScatteredCritical> criticals;
  std::vector<double> speeds;  // of the responses [rad/s]
  std::vector<ScatteredResponse> responses;
};

/// `tolerances` as ReadBeam gives them with `file`. @throws InputError when no number has an sd.
ShaftScatter ScatterShaft(const BeamFile& file, const std::vector<Tolerance>& tolerances,
                          const ScatterPlan& plan,
                          const std::function<bool(double)>& go_on = nullptr);

}  // namespace ambrig
