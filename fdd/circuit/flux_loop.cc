#include "fdd/circuit/flux_loop.h"

#include "fdd/circuit/phase_sums.h"

namespace ambrig {

namespace {

constexpr int kSkippedAtStart = 2;                             // samples of a period
constexpr double kKnee7 = 1 / 729.0, kKnee15 = 1 / 4782969.0;  // 3^-6, 3^-14 [A^-6], [A^-14]

/// Iron terms' value less tangent times psi, and the tangent, at the last psi.
template <class V>
struct Tangent {
  V rest, slope;
  [[gnu::always_inline]] Tangent(const V& psi, double sb, double sa) {
    const V p2 = psi * psi, p6 = p2 * p2 * p2, p14 = p6 * p6 * p2;
    const V seventh = p6 * (sb * kKnee7), fifteenth = p14 * (sa * kKnee15);
    slope = seventh * 7.0 + fifteenth * 15.0;
    rest = (seventh + fifteenth) * psi - slope * psi;
  }
};

/// The circuit's state from sample to sample of a period. Every sample waits for the one before, so
/// as little as possible stands between them. With z_m = e_m - b_m psi and the last flux psi_1
///
///   (rho + sum b_m) psi = s i - u - sum z_m,   z_m <- a_m z_m - b_m (1 - a_m) psi_1,
///
/// and a_m z_m is known one sample earlier. So are p = 1/(rho + sum b_m) where no knee
/// bends, which grows evenly, and with it all sums over the poles but one. There
///
///   psi = free - p U/sum p,   free = driven + q psi_1,   q = p sum b_m (1 - a_m),   U = sum free,
///
/// and as psi_1 = free_1 - p_1 U_1/sum p_1, the sum of the fluxes need not wait for U_1:
///
///   U = sum (driven + q free_1) - U_1 sum q p_1/sum p_1.
template <class V, Coupling kCoupling, int kRelaxing, bool kKnee>
struct CircuitState {
  static constexpr bool kAhead = kCoupling == Coupling::kFloatingRotor && kRelaxing > 0 && !kKnee;
  const FluxLoopInput& c;
  const FluxFilter::Step& step;
  const V ampere_turns;
  V psi, held[kRelaxations], base;  // held: a_m z_m, base: their sum
  V rho, rho_change, p, p_change;
  double p_sum, p_sum_change;
  // kAhead: of the last sample free, U and 1/sum p; sum p p_1, its change, the change's change
  V free;
  CommonOf<V> U = CommonSum(V(0.0));
  double per_last = 0, square, square_change, square_bend;

  [[gnu::always_inline]] CircuitState(const FluxLoopInput& in, const V& sense,
                                      const FluxFilter::State& state)
      : c(in),
        step(*in.constants),
        ampere_turns(sense * LoadAs<V>(in.turns->v)),
        psi(LoadAs<V>(state.psi.v)),
        base(0.0),
        free(psi) {
    for (int m = 0; m < kRelaxing; ++m) held[m] = LoadAs<V>(state.held[m].v);
    base = Held();
    const double per_sample = 1.0 / c.samples;
    const V start = LoadAs<V>(step.rho.v) + step.total, change = LoadAs<V>(step.rho_change.v);
    rho = start;
    rho_change = change * per_sample;
    p = 1 / start;
    p_change = (1 / (start + change) - p) * per_sample;
    p_sum = Sum(p);
    p_sum_change = Sum(p_change);
    const double across = Sum(p * p_change);
    square_bend = 2 * Sum(p_change * p_change);
    square_change = 2 * across;
    square = Sum(p * p) - across;
  }

  [[gnu::always_inline]] V Held() const {
    if constexpr (kRelaxing == 0) return 0.0;
    if constexpr (kRelaxing == 2) return held[0] + held[1];
    return held[0] + held[1] + (held[2] + held[3]);
  }

  /// MMF of the windings less what the relaxations hold whatever the last flux was.
  [[gnu::always_inline]] V Source(const V& current) const {
    const V winding = ampere_turns * current;
    if constexpr (kCoupling == Coupling::kSides) return winding + Partner(winding) - base;
    return winding - base;
  }

  /// d psi/d i within the next sample.
  [[gnu::always_inline]] V Share() const {
    V per = p;
    if constexpr (kKnee) per = 1 / (rho + Tangent<V>(psi, c.knee7, c.knee15).slope);
    if constexpr (kCoupling == Coupling::kFloatingRotor) return per - per * per * (1 / Sum(per));
    return per;
  }

  /// psi at the next sample, with `current` [A].
  [[gnu::always_inline]] V Solve(const V& current) {
    if constexpr (kKnee) {
      const Tangent<V> iron(psi, c.knee7, c.knee15);
      const V per = 1 / (rho + iron.slope),
              driven = (Source(current) + psi * step.of_last - iron.rest) * per;
      if constexpr (kCoupling != Coupling::kFloatingRotor) return driven;
      return driven - per * (1 / Sum(per)) * CommonSum(driven);
    }
    const V driven = Source(current) * p;
    if constexpr (kAhead) {
      const V q = p * step.of_last;
      U = CommonSum(driven + free * q) - U * (square * step.of_last * per_last);
      free = driven + psi * q;
      per_last = 1 / p_sum;
      return free - p * per_last * U;
    }
    if constexpr (kCoupling == Coupling::kFloatingRotor)
      return driven - p * (1 / p_sum) * CommonSum(driven);
    if constexpr (kRelaxing > 0) return driven + psi * (p * step.of_last);
    return driven;
  }

  [[gnu::always_inline]] V Next(const V& current) {
    const V now = Solve(current);
    for (int m = 0; m < kRelaxing; ++m) held[m] = held[m] * step.decay[m] - psi * step.gain[m];
    base = Held();
    psi = now;
    rho += rho_change;
    p += p_change;
    p_sum += p_sum_change;
    square += square_change;
    square_change += square_bend;
    return now;
  }

  [[gnu::always_inline]] void Keep(FluxFilter::State* state) const {
    Store(state->psi.v, psi);
    for (int m = 0; m < kRelaxing; ++m) Store(state->held[m].v, held[m]);
  }
};

/// kConducting: every current of the period is surely above zero. Then the off phase is
/// all samples but those of the on phase and the one after it, and how many count is known
/// from the edge.
template <class V, Coupling kCoupling, int kRelaxing, bool kKnee, bool kConducting>
[[gnu::always_inline]] inline void Run(const FluxLoopInput& in, const FluxFilter::State& before,
                                       FluxFilter::State* state, FluxPeriod* out) {
  const V sense = LoadAs<V>(in.sense->v), far = 1e30, one = 1.0, zero = 0.0;
  // Samples k with k h <= edge are on.
  const V last_on = LoadAs<V>(in.edge->v) * (1 / in.step) + 1e-9;
  CircuitState<V, kCoupling, kRelaxing, kKnee> circuit(in, sense, before);
  Store(out->own.v, circuit.Share());
  const int skipped = in.samples < kSkippedAtStart ? in.samples : kSkippedAtStart;
  V highest = zero, lowest = zero, least_on = far, place = zero;
  PhaseSums<V> on_sums, off_sums;
  PlaceSums<V> off_counts;
  auto on_before = Below(-one, last_on);
  const auto take = [&](int k, bool counts) __attribute__((always_inline)) {
    const V current = LoadAs<V>(in.adc[k].v), now = circuit.Next(current);
    highest = Max(now, highest);
    lowest = Min(now, lowest);
    const auto on = Below(place, last_on);
    if constexpr (!kConducting) least_on = Min(Choose(on, current, far), least_on);
    if (counts) {
      auto off = ~on_before;
      if constexpr (!kConducting) {
        off = off & Below(kSurelyConducts, current);  // else the diodes may block
        off_counts.Add(off);
      }
      on_sums.Add(on, now, current);
      off_sums.Add(off, now, current);
    }
    on_before = on;
    place += one;
  };
  for (int k = 0; k < skipped; ++k) take(k, false);
  for (int k = skipped; k < in.samples; ++k) take(k, true);
  circuit.Keep(state);
  Store(out->flux.v, circuit.psi);
  Store(out->largest_flux.v, Max(highest, -lowest));
  if constexpr (!kConducting) Store(out->least_on.v, least_on);
  const V end = static_cast<double>(in.samples), skip = static_cast<double>(skipped),
          on_end = SamplesBefore(last_on, end);
  Places<V> off_places;
  if constexpr (kConducting)
    off_places = Places<V>::Between(Min(Max(on_end + one, skip), end), end);
  else
    off_places = off_counts.Until(end);
  Finish<V>(on_sums, Places<V>::Between(skip, Max(on_end, skip)), sense, in.samples, in.step,
            &out->phase[0]);
  Finish<V>(off_sums, off_places, sense, in.samples, in.step, &out->phase[1]);
}

template <class V, Coupling kCoupling, int kRelaxing, bool kKnee>
[[gnu::always_inline]] inline void RunOver(const FluxLoopInput& in, const FluxFilter::State& before,
                                           FluxFilter::State* state, FluxPeriod* out) {
  const V far = 1e30;
  // Two of each, which wait for each other half as long.
  V most = -far, least = far, most_of_others = most, least_of_others = least;
  int k = 0;
  for (; k + 1 < in.samples; k += 2) {
    const V one = LoadAs<V>(in.adc[k].v), other = LoadAs<V>(in.adc[k + 1].v);
    most = Max(one, most);
    least = Min(one, least);
    most_of_others = Max(other, most_of_others);
    least_of_others = Min(other, least_of_others);
  }
  if (k < in.samples) {
    const V last = LoadAs<V>(in.adc[k].v);
    most = Max(last, most);
    least = Min(last, least);
  }
  most = Max(most_of_others, most);
  least = Min(least_of_others, least);
  Store(out->largest.v, most);
  Store(out->least_on.v, least);
  const V is_coil = Abs(LoadAs<V>(in.sense->v));
  out->conducts = Largest((kSurelyConducts - least) * is_coil - (1.0 - is_coil)) < 0;
  if (out->conducts)
    Run<V, kCoupling, kRelaxing, kKnee, true>(in, before, state, out);
  else
    Run<V, kCoupling, kRelaxing, kKnee, false>(in, before, state, out);
}

template <class V, Coupling kCoupling>
[[gnu::always_inline]] inline void Pick(const FluxLoopInput& in, const FluxFilter::State& before,
                                        FluxFilter::State* state, FluxPeriod* out) {
  if (in.knee7 != 0 || in.knee15 != 0)
    RunOver<V, kCoupling, kRelaxations, true>(in, before, state, out);
  else if (in.relaxing > 2)
    RunOver<V, kCoupling, kRelaxations, false>(in, before, state, out);
  else if (in.relaxing > 0)
    RunOver<V, kCoupling, 2, false>(in, before, state, out);
  else
    RunOver<V, kCoupling, 0, false>(in, before, state, out);
}

#define AMBRIG_FLUX_LOOP(name, attribute, vector, coupling)                     \
  attribute void name(const FluxLoopInput& in, const FluxFilter::State& before, \
                      FluxFilter::State* state, FluxPeriod* out) {              \
    Pick<vector, Coupling::coupling>(in, before, state, out);                   \
  }
AMBRIG_FLUX_LOOP(FluxRadialWhole, AMBRIG_WHOLE, WholeLaneVector, kFloatingRotor)
AMBRIG_FLUX_LOOP(FluxRadialHalves, AMBRIG_WIDE, LaneVector, kFloatingRotor)
AMBRIG_FLUX_LOOP(FluxSidesWhole, AMBRIG_WHOLE, WholeLaneVector, kSides)
AMBRIG_FLUX_LOOP(FluxSidesHalves, AMBRIG_WIDE, LaneVector, kSides)
AMBRIG_FLUX_LOOP(FluxSeparateHalves, AMBRIG_WIDE, LaneVector, kNone)
#undef AMBRIG_FLUX_LOOP

}  // namespace

void RunFluxLoop(Coupling coupling, const FluxLoopInput& in, const FluxFilter::State& before,
                 FluxFilter::State* state, FluxPeriod* out) {
  const auto run = coupling == Coupling::kFloatingRotor
                       ? (whole_lanes ? FluxRadialWhole : FluxRadialHalves)
                   : coupling == Coupling::kSides ? (whole_lanes ? FluxSidesWhole : FluxSidesHalves)
                                                  : FluxSeparateHalves;
  run(in, before, state, out);
}

}  // namespace ambrig
