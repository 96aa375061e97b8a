#include "fdd/measurement/reading_jump.h"

#include <cmath>

#include "actuators/magnetics/whole_lane_vector.h"

namespace ambrig {

namespace {

constexpr double kNoiseOfStep = 11;     // 8 sd of the difference of two samples
constexpr int kAfterEdge = 3;           // intervals that dead time and errors of an edge may reach
constexpr double kOfStep = 0.5;         // of the last period's step: it is no straight line
constexpr double kNeighbours = 0.15;    // [A] what their edges change from period to period
constexpr double kLeastJump = 0.2;      // [A]
constexpr double kOfEdge = 1.25;        // of the largest step beside an edge so far
constexpr double kEdgeForgets = 0.999;  // a period
constexpr double kFewestIntervals = 1.5;  // intervals of a phase
constexpr int kOn = 0, kOff = 1;          // phases; then the intervals 1 and 2 of a period
constexpr int kKnownSteps = kOff + kAfterEdge;

template <class V>
struct Range {
  V low, high, expected;
};

template <class V>
[[gnu::always_inline]] inline Range<V> RangeOf(const ReadingJump::PhaseStep& p, const V& most,
                                               double noise) {
  const V zero = 0.0, mean = LoadAs<V>(p.mean.v),
          tolerance = Max(Abs(mean) * kOfStep + noise, kNeighbours);
  const auto known = LoadAs<V>(p.count.v) > kFewestIntervals;
  return {Select(known, mean - tolerance, -most), Select(known, mean + tolerance, most),
          Select(known, mean, zero)};
}

/// Sums over the settled intervals of a phase, or one interval at the start of a period.
template <class V>
struct Steps {
  V sum = 0.0, count = 0.0;
  template <class Mask>
  [[gnu::always_inline]] void Add(const Mask& counts, const V& step) {
    sum += Only(counts, step);
    count += Only(counts, 1.0);
  }
  [[gnu::always_inline]] void Keep(ReadingJump::PhaseStep* out, double weight) const {
    Store(out->mean.v, sum / Max(count, 1.0));
    Store(out->count.v, count * weight);
  }
};

template <class V>
[[gnu::always_inline]] inline void SumOfSteps(const Lane* adc, int samples, const Lane& edge,
                                              const Lane& limit, double noise,
                                              ReadingJump::State* state, Lane* jumps) {
  ReadingJump::PhaseStep* known = state->known;
  const V zero = 0.0, one = 1.0, most = LoadAs<V>(limit.v), last_on = LoadAs<V>(edge.v);
  V before = LoadAs<V>(state->last.v), sum = zero;
  V fall = LoadAs<V>(state->fall.v) * kEdgeForgets, rise = LoadAs<V>(state->rise.v) * kEdgeForgets;
  const Range<V> anywhere{Min(-most, fall * kOfEdge - noise), Max(most, rise * kOfEdge + noise),
                          zero},
      on = RangeOf(known[kOn], most, noise), off = RangeOf(known[kOff], most, noise);
  Steps<V> seen[kKnownSteps];
  for (int k = 0; k < samples; ++k) {
    const V now = LoadAs<V>(adc[k].v), step = now - before, place = static_cast<double>(k);
    const bool starts = k > 0 && k < kAfterEdge;
    const auto on_now = Below(k == 0 ? one : place, k == 0 ? zero : last_on);
    // A current that ends in an off phase does not go on as it fell.
    const auto conducts = Below(kConducts, Min(before, now));
    const auto off_now = k == 0 ? conducts : conducts & Below(last_on + kAfterEdge, place);
    // On phases begin with the period: what it began with the last time is known, too.
    const Range<V> rising = starts ? RangeOf(known[kOff + k], most, noise) : on;
    const V low = Choose(on_now, rising.low, Choose(off_now, off.low, anywhere.low)),
            high = Choose(on_now, rising.high, Choose(off_now, off.high, anywhere.high)),
            expected = Choose(on_now, rising.expected, Only(off_now, off.expected));
    const auto impossible = Below(high, step) | Below(step, low);
    sum += Only(impossible, step - expected);
    const V at_edge = Only(~(on_now | off_now), step);
    fall = Min(fall, at_edge);
    rise = Max(rise, at_edge);
    seen[starts ? kOff + k : kOn].Add(on_now & ~impossible, step);
    if (k > 0) seen[kOff].Add(off_now & ~impossible, step);
    before = now;
  }
  for (int q = 0; q < kKnownSteps; ++q)
    seen[q].Keep(&known[q], q > kOff ? kFewestIntervals + 1 : 1);
  Store(state->last.v, before);
  Store(state->fall.v, fall);
  Store(state->rise.v, rise);
  Store(jumps->v, Select(Abs(sum) > kLeastJump, sum, zero));
}

AMBRIG_WHOLE void StepsOfWholeLanes(const Lane* adc, int samples, const Lane& edge,
                                    const Lane& limit, double noise, ReadingJump::State* state,
                                    Lane* jumps) {
  SumOfSteps<WholeLaneVector>(adc, samples, edge, limit, noise, state, jumps);
}
AMBRIG_WIDE void StepsOfHalfLanes(const Lane* adc, int samples, const Lane& edge, const Lane& limit,
                                  double noise, ReadingJump::State* state, Lane* jumps) {
  SumOfSteps<LaneVector>(adc, samples, edge, limit, noise, state, jumps);
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
  if (!started_) state_.last = in.adc[0];
  started_ = true;
  Lane limit, edge, jumps;
  const double noise = kNoiseOfStep * noise_;
  const double per_period = 1 / (sampling_.amplifier->switching_frequency * sampling_.step);
  for (int j = 0; j < kLanes; ++j) {
    limit[j] = per_volt_[j] * std::abs(in.bus) + noise;
    edge[j] = (*in.duty)[j] * per_period;
  }
  (whole_lanes ? StepsOfWholeLanes : StepsOfHalfLanes)(in.adc, sampling_.samples, edge, limit,
                                                       noise, &state_, &jumps);
  // Other bridges have more edges than the one of the duty.
  if (sampling_.amplifier->modulation != Modulation::kBiState)
    for (PhaseStep& p : state_.known) p.count = Lane{};
  return jumps;
}

}  // namespace ambrig
