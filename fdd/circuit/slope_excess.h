#pragma once
/// By how much the flux linkage of a coil moves more than its voltage accounts for, relative:
///
///   e = gain M0 slope(s psi) + L slope(i) - d [V],   d = v + v0 - R mean(i) [V]
///   c = sum w e d / sum w d^2,   1/w = variance of e by ADC noise + (0.3 V)^2
///
/// over phases and periods. Errors that do not change sign with the voltage (R, drops, motion,
/// offsets) cancel between the phases. Healthy 0, no current -1, a share s of the turns bypassed
/// 1/(1 - s)^2 - 1 (its mutual part less), whatever the iron does, as every linkage scales with the
/// turns.
#include "fdd/circuit/flux_circuit.h"

namespace ambrig {

/// A coil's own equation: v + offset = gain M0 slope(s psi) + leakage slope(i) + resistance i.
struct CoilEquations {
  Lane gain, leakage, resistance;  // [-], [H], [ohm]
  Lane offset;                     // [V] that the bridge adds to the voltage of its duty
};

/// Sums of one period, both phases.
struct SlopeExcess {
  Lane top[2], bottom[2];  // w e d, w d^2; zero where a phase cannot be judged [-]
  Lane gross;              // 1: the on phase starts near zero current, only large c are believed
};

struct ExcessSettings {
  double current_noise = 0.004;  // [A rms] per sample, quantisation included
  double adc_limit = 10;         // [A] larger readings are clipped
};

/// `share`: turns that every coil has left [-]; 0: the coil is not judged.
void ComputeSlopeExcess(const FluxFilter& filter, const CoilEquations& coils,
                        const ExcessSettings& settings, const FluxPeriod& period, const Lane& share,
                        SlopeExcess* out);

}  // namespace ambrig
