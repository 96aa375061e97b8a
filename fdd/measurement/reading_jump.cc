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

struct Range {
  LaneVector low, high, expected;
};

AMBRIG_INLINE Range RangeOf(const ReadingJump::PhaseStep& p, const LaneVector& most, double noise) {
  const LaneVector zero, mean = Load(p.mean.v),
                         tolerance = Max(Abs(mean) * kOfStep + noise, kNeighbours);
  const auto known = Load(p.count.v) > kFewestIntervals;
  return {Select(known, mean - tolerance, -most), Select(known, mean + tolerance, most),
          Select(known, mean, zero)};
}

/// Sums over the settled intervals of a phase, or one interval at the start of a period.
struct Steps {
  LaneVector sum, count;
  [[gnu::always_inline]] void Add(const LaneVector& step, const LaneVector& counts) {
    sum += step * counts;
    count += counts;
  }
  [[gnu::always_inline]] void Keep(ReadingJump::PhaseStep* out, double weight) const {
    Store(out->mean.v, sum / Max(count, LaneVector(1.0)));
    Store(out->count.v, count * weight);
  }
};

AMBRIG_WIDE void SumOfSteps(const Lane* adc, int samples, const Lane& edge, const Lane& limit,
                            double noise, ReadingJump::State* state, Lane* jumps) {
  ReadingJump::PhaseStep* known = state->known;
  const LaneVector zero, one = 1.0, most = Load(limit.v), last_on = Load(edge.v);
  LaneVector before = Load(state->last.v), sum = zero;
  LaneVector fall = Load(state->fall.v) * kEdgeForgets, rise = Load(state->rise.v) * kEdgeForgets;
  const Range anywhere{Min(-most, fall * kOfEdge - noise), Max(most, rise * kOfEdge + noise), zero},
      on = RangeOf(known[kOn], most, noise), off = RangeOf(known[kOff], most, noise);
  Steps seen[kKnownSteps];
  for (int k = 0; k < samples; ++k) {
    const LaneVector now = Load(adc[k].v), step = now - before, place = static_cast<double>(k);
    const bool starts = k > 0 && k < kAfterEdge;
    // A current that ends in an off phase does not go on as it fell.
    const LaneVector conducts = Select(Min(before, now) > kConducts, one, zero);
    const LaneVector is_on = k == 0 ? zero : Select(place < last_on, one, zero),
                     is_off =
                         k == 0 ? conducts : Select(place > last_on + kAfterEdge, conducts, zero);
    const auto in_on = is_on > zero, in_off = is_off > zero;
    // On phases begin with the period: what it began with the last time is known, too.
    const Range rising = starts ? RangeOf(known[kOff + k], most, noise) : on;
    const LaneVector low = Select(in_on, rising.low, Select(in_off, off.low, anywhere.low)),
                     high = Select(in_on, rising.high, Select(in_off, off.high, anywhere.high)),
                     expected = Select(in_on, rising.expected, Select(in_off, off.expected, zero));
    const LaneVector beyond =
        Select(step > high, step - expected, Select(step < low, step - expected, zero));
    const LaneVector regular = Select(Abs(beyond) > zero, zero, one);
    sum = sum + beyond;
    const LaneVector at_edge = Select(in_on, zero, Select(in_off, zero, step));
    fall = Min(fall, at_edge);
    rise = Max(rise, at_edge);
    seen[starts ? kOff + k : kOn].Add(step, is_on * regular);
    if (k > 0) seen[kOff].Add(step, is_off * regular);
    before = now;
  }
  for (int q = 0; q < kKnownSteps; ++q)
    seen[q].Keep(&known[q], q > kOff ? kFewestIntervals + 1 : 1);
  Store(state->last.v, before);
  Store(state->fall.v, fall);
  Store(state->rise.v, rise);
  Store(jumps->v, Select(Abs(sum) > kLeastJump, sum, zero));
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
  SumOfSteps(in.adc, sampling_.samples, edge, limit, noise, &state_, &jumps);
  // Other bridges have more edges than the one of the duty.
  if (sampling_.amplifier->modulation != Modulation::kBiState)
    for (PhaseStep& p : state_.known) p.count = Lane{};
  return jumps;
}

}  // namespace ambrig
