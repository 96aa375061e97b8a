#pragma once
/// Rigs whose coils are all alike and whose edges and samples are on time: what closed forms are
/// written for.
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

inline RigParameters WithExactCoils(RigParameters rig) {
  AmplifierParameters& a = rig.amplifier;
  a.adc_jitter = a.edge_jitter = a.edge_spread = a.current_gain_spread = 0;
  return rig;
}

}  // namespace ambrig
