#include "fdd/circuit/slope_excess.h"

#include "actuators/magnetics/whole_lane_vector.h"

namespace ambrig {

namespace {

constexpr double kVoltageError = 0.3;  // [V]

template <class V>
[[gnu::always_inline]] inline void Compute(const FluxFilter& filter, const CoilEquations& coils,
                                           const ExcessSettings& s, const FluxPeriod& period,
                                           const Lane& share, SlopeExcess* out) {
  const V zero = 0.0, left = LoadAs<V>(share.v), mutual = LoadAs<V>(filter.inductances().v),
          main = left * LoadAs<V>(coils.gain.v) * mutual,
          leakage = left * left * LoadAs<V>(coils.leakage.v),
          resistance = left * LoadAs<V>(coils.resistance.v), offset = LoadAs<V>(coils.offset.v);
  const V noise = (main * left * LoadAs<V>(period.own.v) + leakage) * s.current_noise;
  const auto starts_at_zero = LoadAs<V>(period.least_on.v) < kConducts;
  V judged = Select(left > zero, 1, zero);
  judged = Select(LoadAs<V>(period.largest.v) < s.adc_limit, judged, zero);
  Store(out->gross.v, Select(starts_at_zero, judged, zero));
  for (int q = 0; q < 2; ++q) {
    const FluxPhase& p = period.phase[q];
    const V voltage = LoadAs<V>(p.voltage.v), mean = LoadAs<V>(p.mean.v);
    const V drive = voltage + offset - resistance * mean;
    const V e = main * LoadAs<V>(p.flux.v) + leakage * LoadAs<V>(p.current.v) - drive;
    V weight =
        judged / (noise * noise * LoadAs<V>(p.scale.v) + kVoltageError * kVoltageError) * drive;
    weight = Select(LoadAs<V>(p.samples.v) > zero, weight, zero);
    Store(out->top[q].v, weight * e);
    Store(out->bottom[q].v, weight * drive);
  }
}
AMBRIG_WHOLE void ExcessOfWholeLanes(const FluxFilter& filter, const CoilEquations& coils,
                                     const ExcessSettings& s, const FluxPeriod& period,
                                     const Lane& share, SlopeExcess* out) {
  Compute<WholeLaneVector>(filter, coils, s, period, share, out);
}
AMBRIG_WIDE void ExcessOfHalfLanes(const FluxFilter& filter, const CoilEquations& coils,
                                   const ExcessSettings& s, const FluxPeriod& period,
                                   const Lane& share, SlopeExcess* out) {
  Compute<LaneVector>(filter, coils, s, period, share, out);
}

}  // namespace

void ComputeSlopeExcess(const FluxFilter& filter, const CoilEquations& coils,
                        const ExcessSettings& settings, const FluxPeriod& period, const Lane& share,
                        SlopeExcess* out) {
  (whole_lanes ? ExcessOfWholeLanes : ExcessOfHalfLanes)(filter, coils, settings, period, share,
                                                         out);
}

}  // namespace ambrig
