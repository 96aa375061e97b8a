#pragma once
/// The samples of one period in the circuit of flux_circuit.h: fluxes one after the other, and the
/// sums that their slopes are made of. All coils at once, one lane each.
#include "fdd/circuit/flux_circuit.h"

namespace ambrig {

/// What the loop is told of a bearing and a period beside its samples.
struct FluxLoopInput {
  const Lane *sense, *turns;  // of the windings; 0: no coil in this lane
  const Lane* edge;           // end of the on phase [s], -1: none
  double knee7, knee15, step;
  int samples, relaxing;  // relaxations that have a residue, the first ones of `constants`
  const FluxFilter::Step* constants;
  const Lane* adc;  // [A]
};

/// Goes on from `before` to `state`, and fills `out`, but for the voltages.
void RunFluxLoop(Coupling coupling, const FluxLoopInput& in, const FluxFilter::State& before,
                 FluxFilter::State* state, FluxPeriod* out);

}  // namespace ambrig
