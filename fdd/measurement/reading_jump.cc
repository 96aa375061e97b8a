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

/// What the steps of a period are compared with; the state before it.
template <class V>
struct StepLimits {
  const ReadingJump::PhaseStep* known;
  V most, last_on;  // [A], sample that an on phase ends at
  V fall, rise;     // largest steps beside edges so far [A]
  double noise;
  Range<V> anywhere, on, off;

  [[gnu::always_inline]] StepLimits(const ReadingJump::State& state, const Lane& limit,
                                    const Lane& edge, double noise_of_step)
      : known(state.known),
        most(LoadAs<V>(limit.v)),
        last_on(LoadAs<V>(edge.v)),
        fall(LoadAs<V>(state.fall.v) * kEdgeForgets),
        rise(LoadAs<V>(state.rise.v) * kEdgeForgets),
        noise(noise_of_step) {
    anywhere = {Min(-most, fall * kOfEdge - noise), Max(most, rise * kOfEdge + noise), 0.0};
    on = RangeOf(known[kOn], most, noise);
    off = RangeOf(known[kOff], most, noise);
  }
  /// Of the on phase at interval k < kAfterEdge: it begins with the period, and what it began with
  /// the last time is known, too.
  [[gnu::always_inline]] Range<V> Rising(int k) const {
    return RangeOf(known[kOff + k], most, noise);
  }
};

/// The steps of one period. kAsExpected: none is taken for impossible; returns false where one is, and
/// nothing is kept then.
template <class V, bool kAsExpected>
[[gnu::always_inline]] inline bool SumOfSteps(const Lane* adc, int samples, const Lane& edge,
                                              const Lane& limit, double noise,
                                              ReadingJump::State* state, Lane* jumps) {
  const StepLimits<V> limits(*state, limit, edge, noise);
  const V zero = 0.0, one = 1.0;
  V before = LoadAs<V>(state->last.v), sum = zero, inside = one;
  V fall = limits.fall, rise = limits.rise;
  Steps<V> seen[kKnownSteps];
  // Written out for the intervals that begin a period: sums that are chosen by k would live in memory.
  const auto take = [&](int k, const Range<V>& rising, Steps<V>& on_steps)
      __attribute__((always_inline)) {
    const V now = LoadAs<V>(adc[k].v), step = now - before, place = static_cast<double>(k);
    const auto on_now = Below(k == 0 ? one : place, k == 0 ? zero : limits.last_on);
    // A current that ends in an off phase does not go on as it fell.
    const auto conducts = Below(kConducts, Min(before, now));
    const auto off_now = k == 0 ? conducts : conducts & Below(limits.last_on + kAfterEdge, place);
    const Range<V>&off = limits.off, &anywhere = limits.anywhere;
    const V low = Choose(on_now, rising.low, Choose(off_now, off.low, anywhere.low)),
            high = Choose(on_now, rising.high, Choose(off_now, off.high, anywhere.high));
    auto in_on = on_now, in_off = off_now;
    if constexpr (kAsExpected) {
      inside = Min(inside, Min(high - step, step - low));
    } else {
      const auto impossible = Below(high, step) | Below(step, low);
      const V expected = Choose(on_now, rising.expected, Only(off_now, off.expected));
      sum += Only(impossible, step - expected);
      in_on = in_on & ~impossible;
      in_off = in_off & ~impossible;
    }
    const V at_edge = Only(~(on_now | off_now), step);
    fall = Min(fall, at_edge);
    rise = Max(rise, at_edge);
    on_steps.Add(in_on, step);
    if (k > 0) seen[kOff].Add(in_off, step);
    before = now;
  };
  static_assert(kAfterEdge == 3);
  take(0, limits.on, seen[kOn]);
  if (samples > 1) take(1, limits.Rising(1), seen[kOff + 1]);
  if (samples > 2) take(2, limits.Rising(2), seen[kOff + 2]);
  for (int k = kAfterEdge; k < samples; ++k) take(k, limits.on, seen[kOn]);
  if (kAsExpected && Largest(-inside) > 0) return false;
  for (int q = 0; q < kKnownSteps; ++q)
    seen[q].Keep(&state->known[q], q > kOff ? kFewestIntervals + 1 : 1);
  Store(state->last.v, before);
  Store(state->fall.v, fall);
  Store(state->rise.v, rise);
  Store(jumps->v, Select(Abs(sum) > kLeastJump, sum, zero));
  return true;
}

template <class V>
[[gnu::always_inline]] inline void AddSteps(const Lane* adc, int samples, const Lane& edge,
                                            const Lane& limit, double noise,
                                            ReadingJump::State* state, Lane* jumps) {
  if (!SumOfSteps<V, true>(adc, samples, edge, limit, noise, state, jumps))
    SumOfSteps<V, false>(adc, samples, edge, limit, noise, state, jumps);
}

AMBRIG_WHOLE void StepsOfWholeLanes(const Lane* adc, int samples, const Lane& edge,
                                    const Lane& limit, double noise, ReadingJump::State* state,
                                    Lane* jumps) {
  AddSteps<WholeLaneVector>(adc, samples, edge, limit, noise, state, jumps);
}
AMBRIG_WIDE void StepsOfHalfLanes(const Lane* adc, int samples, const Lane& edge, const Lane& limit,
                                  double noise, ReadingJump::State* state, Lane* jumps) {
  AddSteps<LaneVector>(adc, samples, edge, limit, noise, state, jumps);
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
