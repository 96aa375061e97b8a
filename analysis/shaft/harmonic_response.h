#pragma once
/// Response of a shaft at one speed to harmonic forces at planes, or to a harmonic motion of the
/// ground, over the frequency w:
///   (K - w² M + i w (D + Omega G)) q = f,  x(t) = Re(q e^{i w t})
/// Supports as they are at the speed. Ground that moves by u pushes what its supports carry with
/// (k + i w c - w² m) u.
#include "analysis/shaft/shaft_unbalance.h"

namespace ambrig {

struct HarmonicForce {
  ShaftProbe plane;
  double x = 0, y = 0;  // [N]
  double phase = 0;     // of both [rad]
};

struct HarmonicLoad {
  std::vector<HarmonicForce> forces;
  double ground_x = 0, ground_y = 0;  // [m]
  bool any() const { return !forces.empty() || ground_x != 0 || ground_y != 0; }
};

struct HarmonicSweep {
  double speed = 0;               // of the shaft [rad/s]
  std::vector<double> frequency;  // [rad/s]
  std::vector<ProbeOrbit> probes;
};

/// @throws InputError when the supports leave a motion free at a frequency of the sweep.
HarmonicSweep SweepHarmonic(const BeamRotor& beam, double speed, const HarmonicLoad& load,
                            const std::vector<ShaftProbe>& probes,
                            const std::vector<double>& frequencies);

}  // namespace ambrig
