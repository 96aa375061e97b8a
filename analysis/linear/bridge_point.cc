#include "analysis/linear/bridge_point.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

BridgePoint BridgeAt(const AmplifierParameters& p, const BridgeImperfection& imperfection,
                     double bus, double duty) {
  const double T = 1 / p.switching_frequency;
  const CoilVoltage v = PowerBridge(p).Pattern(duty, imperfection);
  const auto level = [&](int piece) { return v.gain[piece] * bus + v.drop[piece]; };
  BridgePoint out;
  out.volts = (v.t1 * level(0) + (v.t2 - v.t1) * level(1) + (T - v.t2) * level(2)) / T;
  out.edge = v.t2;
  out.whole = p.modulation == Modulation::kIdeal;
  // Tri-state: |2d - 1| of the period is driven, on above one half, off below.
  const double rate = p.modulation == Modulation::kTriState ? (duty >= 0.5 ? 2 : -2) : 1;
  out.impulse = out.whole ? bus : (level(1) - level(2)) * T * rate;
  return out;
}

double DutyForVoltage(const AmplifierParameters& p, const BridgeImperfection& imperfection,
                      double bus, double volts, double guess) {
  constexpr int kRounds = 8;  // the mean is a piecewise linear function of the duty
  const bool ideal = p.modulation == Modulation::kIdeal;
  const double T = 1 / p.switching_frequency, least = ideal ? -1 : 0;
  double duty = std::clamp(guess, least, 1.0);
  for (int round = 0; round < kRounds; ++round) {
    const BridgePoint at = BridgeAt(p, imperfection, bus, duty);
    const double slope = ideal ? at.impulse : at.impulse / T;
    const double next = std::clamp(duty + (volts - at.volts) / slope, least, 1.0);
    if (next == duty || !std::isfinite(next)) break;
    duty = next;
  }
  return duty;
}

}  // namespace ambrig
