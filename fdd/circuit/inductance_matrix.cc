#include "fdd/circuit/inductance_matrix.h"

#include <algorithm>

namespace ambrig {

LinkageMatrix InductanceOf(const LinkageModel& m, const Lane& P) {
  LinkageMatrix L = LinkageMatrix::Identity();
  double total = 0;
  for (int j = 0; j < m.coils; ++j) total += P[j];
  for (int j = 0; j < m.coils; ++j)
    for (int k = 0; k < m.coils; ++k) {
      double value = 0;
      if (m.coupling == Coupling::kFloatingRotor)
        value = m.n[j] * P[j] * m.n[k] * ((j == k ? 1 : 0) - P[k] / total);
      else if (j == k || (m.coupling == Coupling::kSides && (j ^ 1) == k))
        value = m.n[j] * m.n[k] * P[j];
      L(j, k) = value + (j == k ? m.leakage[j] : 0);
    }
  return L;
}

MovingInverse::MovingInverse(const LinkageModel& m, const MeasuredPeriod& in)
    : L0(InductanceOf(m, m.Permeance(in.x0, in.y0))),
      start(L0.inverse()),
      change(InductanceOf(m, m.Permeance(in.x1, in.y1)).inverse() - start) {}

double DrivenLinkage(const SamplingSettings& s, const MeasuredPeriod& in, int j, int k) {
  const BridgeVoltage v = VoltageOf(*s.amplifier, (*in.duty)[j], in.bus);
  const double on = std::clamp(v.edge - k * s.step, 0.0, s.step);
  return on * v.on + (s.step - on) * v.off;
}

}  // namespace ambrig
