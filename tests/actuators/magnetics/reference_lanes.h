#pragma once
/// Stators of the reference rig (scenarios/library/rigs/reference.toml) as the engine builds them.
#include <cmath>
#include <string>

#include "rig/rig_assembly.h"
#include "rig/rig_file.h"

namespace ambrig {

inline const RigParameters& ReferenceLanesRig() {
  static const RigParameters rig =
      ReadRig(AMBRIG_SOURCE_DIR "/scenarios/library/rigs/reference.toml");
  return rig;
}

/// Bearing "A", "B" (radial) or "Z" (thrust), steps of 1/18 of 40 us.
inline StatorLanes LanesOf(const std::string& bearing) {
  Plant plant = BuildPlant(TrueRig(ReferenceLanesRig()));
  for (BearingPlant& b : plant.bearings)
    if (b.name == bearing) {
      b.lanes.SetStep(40e-6 / 18);
      return std::move(b.lanes);
    }
  throw std::logic_error("no bearing " + bearing);
}

/// One piece: every coil at its voltage [V] for the whole period.
inline VoltagePattern Constant(const Lane& voltage) {
  VoltagePattern p;
  for (int j = 0; j < kLanes; ++j)
    for (int q = 0; q < 3; ++q) p.drop[q][j] = voltage[j];
  for (int j = 0; j < kLanes; ++j)
    p.gain[0][j] = p.gain[1][j] = p.gain[2][j] = voltage[j] > 0 ? 1e-300 : -1e-300;
  return p;
}

inline Lane All(double value) {
  Lane lane;
  for (double& v : lane.v) v = value;
  return lane;
}

}  // namespace ambrig
