#include "fdd/measurement/reading_jump.h"

#include <cmath>

#include "fdd/measurement/sample_places.h"

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
constexpr double kSurelyInside = 0.999;
constexpr int kOn = 0, kOff = 1;  // phases; then the intervals 1 and 2 of a period
constexpr int kKnownSteps = kOff + kAfterEdge;

template <class V>
struct Range {
  V low, high, expected;
  /// Departure from the middle that is surely inside, whatever the rounding.
  [[gnu::always_inline]] V Reach() const { return (high - expected) * kSurelyInside; }
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
  [[gnu::always_inline]] void Keep(ReadingJump::PhaseStep* out) const {
    Store(out->mean.v, sum / Max(count, 1.0));
    Store(out->count.v, count);
  }
  /// Of one interval: known although it is alone.
  [[gnu::always_inline]] void KeepOne(ReadingJump::PhaseStep* out) const {
    Store(out->mean.v, sum);
    Store(out->count.v, count * (kFewestIntervals + 1));
  }
};

template <class V>
[[gnu::always_inline]] inline void KeepAll(const Steps<V>* seen, ReadingJump::State* state) {
  for (int q = 0; q <= kOff; ++q) seen[q].Keep(&state->known[q]);
  for (int q = kOff + 1; q < kKnownSteps; ++q) seen[q].KeepOne(&state->known[q]);
}

/// One period's readings and what they are compared with.
struct StepsInput {
  const Lane* adc;
  int samples;
  const Lane *coils, *duty;  // coils: 1, 0 in lanes without one
  double samples_of_period;  // [-], of the whole switching period
  const Lane* per_volt;      // largest step over the bus voltage [A/V]
  double volts, noise;       // of the bus, of a step [A]
  bool conducts;             // surely, every sample of every coil
};

/// What the steps of a period are compared with; the state before it.
template <class V>
struct StepLimits {
  const ReadingJump::PhaseStep* known;
  V most, last_on;  // [A], sample that an on phase ends at
  V fall, rise;     // largest steps beside edges so far [A]
  double noise;
  Range<V> anywhere, on, off;

  [[gnu::always_inline]] StepLimits(const StepsInput& in, const ReadingJump::State& state)
      : known(state.known),
        most(LoadAs<V>(in.per_volt->v) * in.volts + V(in.noise)),
        last_on(LoadAs<V>(in.duty->v) * in.samples_of_period),
        fall(LoadAs<V>(state.fall.v) * kEdgeForgets),
        rise(LoadAs<V>(state.rise.v) * kEdgeForgets),
        noise(in.noise) {
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

/// Whether every sample of every coil is above kConducts, the last one of the period before, too.
template <class V>
[[gnu::always_inline]] inline bool AllConduct(const StepsInput& in,
                                              const ReadingJump::State& state) {
  const V one = 1.0, coil = LoadAs<V>(in.coils->v);
  V least = LoadAs<V>(state.last.v);
  if (!in.conducts)
    for (int k = 0; k < in.samples; ++k) least = Min(LoadAs<V>(in.adc[k].v), least);
  return Largest((kConducts - least) * coil - (one - coil)) < 0;
}

/// The intervals from kAfterEdge on that belong to either phase.
template <class V>
[[gnu::always_inline]] inline void CountIntervals(const StepsInput& in, const V& last_on,
                                                  const V& last_at_edge, Steps<V>* seen) {
  const V end = static_cast<double>(in.samples), first = Min(end, kAfterEdge);
  seen[kOn].count = Max(SamplesBefore(last_on, end), first) - first;
  seen[kOff].count = end - Max(SamplesUpTo(last_at_edge, end), first);
}

/// The period as nearly all are: every coil conducts throughout, and no step is impossible.
/// Returns false where that is not so; nothing is kept then.
template <class V>
[[gnu::always_inline]] inline bool KeepExpected(const StepsInput& in, ReadingJump::State* state) {
  if (!AllConduct<V>(in, *state)) return false;
  const StepLimits<V> limits(in, *state);
  const V zero = 0.0, one = 1.0;
  V before = LoadAs<V>(state->last.v);
  V fall = limits.fall, rise = limits.rise, place = zero;
  // The largest step, and the largest departures from what is expected of a phase.
  V largest = zero, off_by_on = zero, off_by_off = zero, inside = one;
  Steps<V> seen[kKnownSteps];
  const auto next = [&](int k) __attribute__((always_inline)) {
    const V now = LoadAs<V>(in.adc[k].v), step = now - before;
    before = now;
    largest = Max(Abs(step), largest);
    return step;
  };
  const auto depart = [&](const V& step, const Range<V>& range) __attribute__((always_inline)) {
    return Abs(step - range.expected);
  };
  // Written out for the intervals that begin a period: sums that are chosen by k would
  // live in memory.
  const auto begin = [&](int k, const Range<V>& rising, Steps<V>& on_steps)
      __attribute__((always_inline)) {
    place += one;
    const V step = next(k);
    const auto on = Below(place, limits.last_on);
    inside = Min(inside, Only(on, rising.Reach() - depart(step, rising)));
    fall = Min(fall, Only(~on, step));
    rise = Max(rise, Only(~on, step));
    on_steps.Add(on, step);
  };
  static_assert(kAfterEdge == 3);
  off_by_off = depart(next(0), limits.off);
  if (in.samples > 1) begin(1, limits.Rising(1), seen[kOff + 1]);
  if (in.samples > 2) begin(2, limits.Rising(2), seen[kOff + 2]);
  const V last_at_edge = limits.last_on + kAfterEdge;
  for (int k = kAfterEdge; k < in.samples; ++k) {
    place += one;
    const V step = next(k);
    const auto on = Below(place, limits.last_on), off = Below(last_at_edge, place);
    off_by_on = Max(off_by_on, Only(on, depart(step, limits.on)));
    off_by_off = Max(off_by_off, Only(off, depart(step, limits.off)));
    const V at_edge = Only(~(on | off), step);
    fall = Min(fall, at_edge);
    rise = Max(rise, at_edge);
    seen[kOn].sum += Only(on, step);
    seen[kOff].sum += Only(off, step);
  }
  CountIntervals(in, limits.last_on, last_at_edge, seen);
  inside = Min(inside, Min(limits.on.Reach() - off_by_on, limits.off.Reach() - off_by_off));
  inside = Min(inside, Min(fall - limits.anywhere.low, limits.anywhere.high - rise));
  if (Largest(-inside) > 0) return false;
  KeepAll(seen, state);
  Store(state->last.v, before);
  Store(state->fall.v, fall);
  Store(state->rise.v, rise);
  Store(state->largest.v, largest);
  return true;
}

/// The steps of any period, one after the other.
template <class V>
[[gnu::always_inline]] inline void SumOfSteps(const StepsInput& in, ReadingJump::State* state,
                                              Lane* jumps) {
  const StepLimits<V> limits(in, *state);
  const V zero = 0.0, one = 1.0;
  V before = LoadAs<V>(state->last.v), sum = zero, largest = zero;
  V fall = limits.fall, rise = limits.rise;
  Steps<V> seen[kKnownSteps];
  const auto take = [&](int k, const Range<V>& rising, Steps<V>& on_steps)
      __attribute__((always_inline)) {
    const V now = LoadAs<V>(in.adc[k].v), step = now - before, place = static_cast<double>(k);
    largest = Max(Abs(step), largest);
    const auto on_now = Below(k == 0 ? one : place, k == 0 ? zero : limits.last_on);
    // A current that ends in an off phase does not go on as it fell.
    const auto conducts = Below(kConducts, Min(before, now));
    const auto off_now = k == 0 ? conducts : conducts & Below(limits.last_on + kAfterEdge, place);
    const Range<V>&off = limits.off, &anywhere = limits.anywhere;
    const V low = Choose(on_now, rising.low, Choose(off_now, off.low, anywhere.low)),
            high = Choose(on_now, rising.high, Choose(off_now, off.high, anywhere.high));
    const auto impossible = Below(high, step) | Below(step, low);
    sum += Only(impossible, step - Choose(on_now, rising.expected, Only(off_now, off.expected)));
    const V at_edge = Only(~(on_now | off_now), step);
    fall = Min(fall, at_edge);
    rise = Max(rise, at_edge);
    on_steps.Add(on_now & ~impossible, step);
    if (k > 0) seen[kOff].Add(off_now & ~impossible, step);
    before = now;
  };
  static_assert(kAfterEdge == 3);
  take(0, limits.on, seen[kOn]);
  if (in.samples > 1) take(1, limits.Rising(1), seen[kOff + 1]);
  if (in.samples > 2) take(2, limits.Rising(2), seen[kOff + 2]);
  for (int k = kAfterEdge; k < in.samples; ++k) take(k, limits.on, seen[kOn]);
  KeepAll(seen, state);
  Store(state->last.v, before);
  Store(state->fall.v, fall);
  Store(state->rise.v, rise);
  Store(state->largest.v, largest);
  Store(jumps->v, Select(Abs(sum) > kLeastJump, sum, zero));
}

template <class V>
[[gnu::always_inline]] inline void AddSteps(const StepsInput& in, ReadingJump::State* state,
                                            Lane* jumps) {
  if (!KeepExpected<V>(in, state)) SumOfSteps<V>(in, state, jumps);
}

AMBRIG_WHOLE void StepsOfWholeLanes(const StepsInput& in, ReadingJump::State* state, Lane* jumps) {
  AddSteps<WholeLaneVector>(in, state, jumps);
}
AMBRIG_WIDE void StepsOfHalfLanes(const StepsInput& in, ReadingJump::State* state, Lane* jumps) {
  AddSteps<LaneVector>(in, state, jumps);
}

}  // namespace

ReadingJump::ReadingJump(const LinkageModel& nominal, const SamplingSettings& sampling,
                         double noise)
    : sampling_(sampling), noise_(noise) {
  for (int j = 0; j < nominal.coils; ++j) coils_[j] = 1;
  for (int j = 0; j < kLanes; ++j)
    per_volt_[j] = j < nominal.coils && nominal.leakage[j] > 0 ? sampling.step / nominal.leakage[j]
                                                               : kInfinity;
}

Lane ReadingJump::Period(const MeasuredPeriod& in, bool conducts) {
  if (!started_) state_.last = in.adc[0];
  started_ = true;
  Lane jumps;
  const double per_period = 1 / (sampling_.amplifier->switching_frequency * sampling_.step);
  (whole_lanes ? StepsOfWholeLanes : StepsOfHalfLanes)(
      {in.adc, sampling_.samples, &coils_, in.duty, per_period, &per_volt_, std::abs(in.bus),
       kNoiseOfStep * noise_, conducts},
      &state_, &jumps);
  // Other bridges have more edges than the one of the duty.
  if (sampling_.amplifier->modulation != Modulation::kBiState)
    for (PhaseStep& p : state_.known) p.count = Lane{};
  return jumps;
}

}  // namespace ambrig
