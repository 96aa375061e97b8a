#include "fdd/detectors/resistance_estimate.h"

#include <algorithm>

namespace ambrig {

namespace {
constexpr double kForgetIn = 0.1;      // [s]
constexpr double kLeastCurrent = 0.3;  // [A] that tells a resistance
}  // namespace

ResistanceEstimate::ResistanceEstimate(const CoilDetectorSetup& setup)
    : sampling_(setup.settings.sampling),
      coils_(setup.model.coils),
      nominal_(setup.model.resistance),
      forget_(sampling_.samples * sampling_.step / kForgetIn) {}

void ResistanceEstimate::Add(const MeasuredPeriod& in) {
  const double T = sampling_.step * sampling_.samples;
  for (int j = 0; j < coils_; ++j) {
    double current = 0;
    for (int k = 0; k < sampling_.samples; ++k) current += in.adc[k][j] / sampling_.samples;
    if (current < kLeastCurrent) continue;
    const BridgeVoltage v = VoltageOf(*sampling_.amplifier, (*in.duty)[j], in.bus);
    const double voltage = (v.edge * v.on + (T - v.edge) * v.off) / T;
    top_[j] += voltage * current - forget_ * top_[j];
    bottom_[j] += current * current - forget_ * bottom_[j];
  }
}

double ResistanceEstimate::Value(int j) const {
  const double found = (top_[j] + kPrior * nominal_[j]) / (bottom_[j] + kPrior);
  return std::clamp(found, 0.5 * nominal_[j], 2 * nominal_[j]);
}

}  // namespace ambrig
