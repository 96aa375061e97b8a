#pragma once
/// The plant on which the syntheses are tested.
#include <cmath>

#include "control/linear/sampled_plant.h"

namespace ambrig::testing {

/// A mass of 2 kg on a negative spring, force held over Ts: x'' = k x + f/m, one step of latency.
/// The states are scaled by 1e-5 m, 1e-2 m/s and 10 N.
inline SampledPlant UnstableMass() {
  SampledPlant p;
  p.Ts = 1e-4;
  const double w = 300, m = 2, ch = std::cosh(w * p.Ts), sh = std::sinh(w * p.Ts);
  p.A.resize(3, 3);
  p.A << ch, 1e3 * sh / w, 1e6 * (ch - 1) / (w * w * m), w * sh / 1e3, ch, 1e3 * sh / (w * m), 0, 0,
      0;
  p.B.resize(3, 1);
  p.B << 0, 0, 0.1;
  p.E.resize(3, 1);
  p.E << 1e5 * (ch - 1) / (w * w * m), 1e2 * sh / (w * m), 0;
  p.C.resize(1, 3);
  p.C << 1e-5, 0, 0;
  return p;
}

}  // namespace ambrig::testing
