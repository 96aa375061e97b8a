#include "fdd/detectors/slope_statistic.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

double Outside(const SlopeRange& range, double k) {
  return std::max({0.0, range.low - k, k - range.high});
}
}  // namespace

double InPhaseInductance(const LinkageModel& m, int j, const Lane& P) {
  const double windings = m.coupling == Coupling::kSides ? 2 : 1;
  return windings * m.n[j] * m.n[j] * P[j] + m.leakage[j];
}

SlopeStatistic::SlopeStatistic(const CoilDetectorSetup& setup, Thresholds thresholds, double cycle)
    : model_(setup.model),
      s_(setup.settings),
      thresholds_(thresholds),
      resistance_(setup),
      cycle_(cycle) {
  const double centre[2] = {0, 0};
  model_.Permeance(centre, centre, &centred_);
  converter_.attenuation = converter_.sampling_resistance = 1;
  converter_.bits = 0;
  converter_.reference = s_.current_quantum;  // one code
  converter_.period = s_.sampling.step;
  codes_.resize(static_cast<std::size_t>(s_.sampling.samples));
}

SlopeCircuit SlopeStatistic::CircuitOf(int j, const MeasuredPeriod& in,
                                       const MovingPermeance& P) const {
  const AmplifierParameters& a = *s_.sampling.amplifier;
  const double T = s_.sampling.step * s_.sampling.samples;
  SlopeCircuit c{a.bus_voltage,        a.switch_drop,
                 a.diode_drop,         InPhaseInductance(model_, j, centred_.middle),
                 model_.resistance[j], T};
  if (thresholds_ == Thresholds::kFixed || !in.comparable) return c;
  c.bus = in.bus;
  c.inductance = InPhaseInductance(model_, j, P.middle);
  // di/dt = (v - i (R + dL/dt))/L
  c.resistance = resistance_.Value(j) +
                 (InPhaseInductance(model_, j, P.end) - InPhaseInductance(model_, j, P.start)) / T;
  return c;
}

double SlopeStatistic::EvaluateStatistic(int j, const MeasuredPeriod& in,
                                         const MovingPermeance& P) {
  for (int k = 0; k < s_.sampling.samples; ++k)
    codes_[static_cast<std::size_t>(k)] = converter_.Code(in.adc[k][j]);
  const MeanSlopes slopes = MeanSlopesOf(converter_, codes_);
  const SlopeCircuit c = CircuitOf(j, in, P);
  const double i0 = in.adc[0][j], on = (*in.duty)[j] * s_.sampling.samples;
  double most = 0;
  if (on >= kFewestSamples) most = Outside(IncreasingRange(c, i0), slopes.increasing);
  if (s_.sampling.samples - on >= kFewestSamples)
    most = std::max(most, Outside(DecreasingRange(c, i0), slopes.decreasing));
  return most / kSlopeErrorBudget;
}

Lane SlopeStatistic::Period(const MeasuredPeriod& in) {
  const bool online = thresholds_ == Thresholds::kOnline;
  const double T = s_.sampling.step * s_.sampling.samples;
  since_ += T;
  const bool due = since_ >= cycle_ * (1 - 1e-9);
  if (due) since_ = 0;
  MovingPermeance P;
  if (online) {
    const double from[2] = {in.x0, in.y0}, to[2] = {in.x1, in.y1};
    model_.Permeance(from, to, &P);
  }
  for (int j = 0; j < model_.coils; ++j)
    if (due) held_[j] = EvaluateStatistic(j, in, P);
  if (online) resistance_.Add(in);
  return held_;
}

namespace {

constexpr double kPaperCycle = 1.75e-3;  // [s]

template <SlopeStatistic::Thresholds thresholds>
std::unique_ptr<CoilDetector> EveryPeriod(const CoilDetectorSetup& s) {
  return std::make_unique<SlopeStatistic>(s, thresholds);
}

}  // namespace

CoilDetectorKind Paper() {
  return {"paper",
          "700 A/s",
          "slopes against fixed theoretical limits, once in 1.75 ms",
          1,
          8.06,
          [](const CoilDetectorSetup& s) -> std::unique_ptr<CoilDetector> {
            return std::make_unique<SlopeStatistic>(s, SlopeStatistic::Thresholds::kFixed,
                                                    kPaperCycle);
          }};
}
CoilDetectorKind PaperEveryPeriod() {
  return {"paper-every-period",
          "700 A/s",
          "the same in every switching period",
          1,
          8.66,
          EveryPeriod<SlopeStatistic::Thresholds::kFixed>};
}
CoilDetectorKind PaperOnline() {
  return {"paper-online",
          "700 A/s",
          "the same, limits from measured bus, resistance and gap",
          1,
          4.53,
          EveryPeriod<SlopeStatistic::Thresholds::kOnline>};
}

}  // namespace ambrig
