#include "fdd/measurement/reading_jump.h"

#include <cmath>

#include "actuators/magnetics/whole_lane_vector.h"

namespace ambrig {

namespace {

constexpr double kNoiseOfStep = 11;  // 8 sd of the difference of two samples

AMBRIG_WIDE void SumOfSteps(const Lane* adc, int samples, const Lane& limit, Lane* last,
                            Lane* jumps) {
  const LaneVector zero, most = Load(limit.v);
  LaneVector before = Load(last->v), sum = zero;
  for (int k = 0; k < samples; ++k) {
    const LaneVector now = Load(adc[k].v), step = now - before;
    sum = sum + Select(Abs(step) > most, step, zero);
    before = now;
  }
  Store(last->v, before);
  Store(jumps->v, Select(Abs(sum) > most, sum, zero));
}

}  // namespace

ReadingJump::ReadingJump(const LinkageModel& nominal, const SamplingSettings& sampling,
                         double noise)
    : sampling_(sampling), noise_(noise) {
  for (int j = 0; j < kLanes; ++j)
    per_volt_[j] = j < nominal.coils && nominal.leakage[j] > 0 ? sampling.step / nominal.leakage[j]
                                                               : kInfinity;
}

Lane ReadingJump::Period(const MeasuredPeriod& in) {
  if (!started_) last_ = in.adc[0];
  started_ = true;
  Lane limit, jumps;
  for (int j = 0; j < kLanes; ++j)
    limit[j] = per_volt_[j] * std::abs(in.bus) + kNoiseOfStep * noise_;
  SumOfSteps(in.adc, sampling_.samples, limit, &last_, &jumps);
  return jumps;
}

}  // namespace ambrig
