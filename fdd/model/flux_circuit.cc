#include "fdd/model/flux_circuit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fdd/model/phase_sums.h"

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

struct Constants {
  const Lane *sense, *turns, *edge;
  double knee7, knee15, step;
  int samples;
};

/// The circuit's state from sample to sample of a period. Every sample waits for the one before, so
/// as little as possible stands between them. With D = sum a_m e_m before the last sample, G = sum a_m b_m
/// and psi_1, psi_2 the last two fluxes, what the relaxations hold is
///
///   kept = (D - G psi_2) + (G - total) psi_1,
///
/// whose bracket is known one sample earlier. So are the conductances 1/rho where no knee bends, and
/// with them all of the rotor's potential but its part of psi_1.
template <class V, Coupling kCoupling, bool kRelaxes, bool kKnee>
struct CircuitState {
  const Constants& c;
  const FluxFilter::Step& step;
  const V ampere_turns;
  V psi, held[kRelaxations], base, share;  // share: d psi/d i within the first sample
  V rho, rho_change, inverse, inverse_change;

  [[gnu::always_inline]] CircuitState(const Constants& constants, const FluxFilter::Step& of,
                                      const V& sense, const FluxFilter::State& state)
      : c(constants),
        step(of),
        ampere_turns(sense * LoadAs<V>(c.turns->v)),
        psi(LoadAs<V>(state.psi.v)),
        base(0.0),
        share(0.0) {
    for (int m = 0; kRelaxes && m < kRelaxations; ++m) held[m] = LoadAs<V>(state.held[m].v);
    if constexpr (kRelaxes) base = held[0] + held[1] + (held[2] + held[3]) - psi * step.total_gain;
    rho = LoadAs<V>(step.rho.v) + step.total;
    rho_change = LoadAs<V>(step.rho_change.v) * (1.0 / c.samples);
    const V rho_end = rho + rho_change * static_cast<double>(c.samples);
    inverse = 1 / rho;
    inverse_change = (1 / rho_end - inverse) * (1.0 / c.samples);
  }

  /// MMF of the windings less what the relaxations hold whatever the last flux was.
  [[gnu::always_inline]] V Source(const V& current) const {
    const V winding = ampere_turns * current;
    if constexpr (kCoupling == Coupling::kSides) return winding + Partner(winding) - base;
    return winding - base;
  }

  /// psi at sample k, with `current` [A].
  [[gnu::always_inline]] V Solve(int k, const V& current) {
    const double of_last = kRelaxes ? step.total - step.total_gain : 0;
    V source = Source(current), per = inverse;
    if constexpr (kKnee) {
      const Tangent<V> iron(psi, c.knee7, c.knee15);
      source = source + psi * of_last - iron.rest;
      per = 1 / (rho + iron.slope);
    }
    V flux = source * per;
    if constexpr (kCoupling == Coupling::kFloatingRotor) {
      const double over_total = 1 / Sum(per);
      if (k == 0) share = per - per * per * over_total;
      double sum = Sum(flux);
      if constexpr (kRelaxes && !kKnee) {
        const V part = psi * (per * of_last);
        sum += Sum(part);
        flux += part;
      }
      return flux - per * over_total * sum;
    }
    if (k == 0) share = per;
    if constexpr (kRelaxes && !kKnee) flux += psi * (per * of_last);
    return flux;
  }

  [[gnu::always_inline]] void Advance(const V& now) {
    if constexpr (kRelaxes) {
      const V change = now - psi;
      for (int m = 0; m < kRelaxations; ++m) held[m] = held[m] * step.decay[m];
      base = held[0] + held[1] + (held[2] + held[3]) - psi * step.total_gain;
      for (int m = 0; m < kRelaxations; ++m) held[m] += change * step.gain[m];
    }
    psi = now;
    rho += rho_change;
    inverse += inverse_change;
  }

  [[gnu::always_inline]] void Keep(FluxFilter::State* state) const {
    Store(state->psi.v, psi);
    for (int m = 0; kRelaxes && m < kRelaxations; ++m) Store(state->held[m].v, held[m]);
  }
};

template <class V, Coupling kCoupling, bool kRelaxes, bool kKnee>
[[gnu::always_inline]] inline void Run(const Constants& c, const FluxFilter::Step& step,
                                       const Lane* adc, FluxFilter::State* state, FluxPeriod* out) {
  const V sense = LoadAs<V>(c.sense->v), far = 1e30;
  // Samples k with k h <= edge are on.
  const V last_on = LoadAs<V>(c.edge->v) * (1 / c.step) + 1e-9;
  CircuitState<V, kCoupling, kRelaxes, kKnee> circuit(c, step, sense, *state);
  V largest = 0.0, most = -far, least_on = far, least_off = far;
  PhaseSums<V> on_sums, off_sums;
  for (int k = 0; k < c.samples; ++k) {
    const V current = LoadAs<V>(adc[k].v);
    const V now = circuit.Solve(k, current);
    circuit.Advance(now);
    largest = Max(largest, Max(now, -now));
    most = Max(most, current);
    const V place = static_cast<double>(k);
    const auto on = Below(place, last_on), off = Below(last_on + 1.0, place);
    least_on = Min(Choose(on, current, far), least_on);
    least_off = Min(Choose(on, far, current), least_off);
    if (k < kSkippedAtStart) continue;
    on_sums.Add(on, now, current);
    off_sums.Add(off & Below(kSurelyConducts, current), now, current);  // else the diodes may block
  }
  circuit.Keep(state);
  Store(out->flux.v, circuit.psi);
  Store(out->largest_flux.v, largest);
  Store(out->largest.v, most);
  Store(out->own.v, circuit.share);
  Store(out->phase[0].least.v, least_on);
  Store(out->phase[1].least.v, least_off);
  Finish<V>(on_sums, sense, c.samples, c.step, &out->phase[0]);
  Finish<V>(off_sums, sense, c.samples, c.step, &out->phase[1]);
}

template <class V, Coupling kCoupling>
[[gnu::always_inline]] inline void Pick(bool relaxes, bool knee, const Constants& c,
                                        const FluxFilter::Step& step, const Lane* adc,
                                        FluxFilter::State* state, FluxPeriod* out) {
  if (knee)
    Run<V, kCoupling, true, true>(c, step, adc, state, out);
  else if (relaxes)
    Run<V, kCoupling, true, false>(c, step, adc, state, out);
  else
    Run<V, kCoupling, false, false>(c, step, adc, state, out);
}

#define AMBRIG_FLUX_LOOP(name, attribute, vector, coupling)                                      \
  attribute void name(bool relaxes, bool knee, const Constants& c, const FluxFilter::Step& step, \
                      const Lane* adc, FluxFilter::State* state, FluxPeriod* out) {              \
    Pick<vector, Coupling::coupling>(relaxes, knee, c, step, adc, state, out);                   \
  }
AMBRIG_FLUX_LOOP(FluxRadialWhole, AMBRIG_WHOLE, WholeLaneVector, kFloatingRotor)
AMBRIG_FLUX_LOOP(FluxRadialHalves, AMBRIG_WIDE, LaneVector, kFloatingRotor)
AMBRIG_FLUX_LOOP(FluxSidesWhole, AMBRIG_WHOLE, WholeLaneVector, kSides)
AMBRIG_FLUX_LOOP(FluxSidesHalves, AMBRIG_WIDE, LaneVector, kSides)
AMBRIG_FLUX_LOOP(FluxSeparateHalves, AMBRIG_WIDE, LaneVector, kNone)
#undef AMBRIG_FLUX_LOOP

/// Lanes without a coil take next to no flux.
AMBRIG_WIDE void ComputeReluctances(const LinkageModel& m, const FluxCircuit& circuit,
                                    const Lane& per_nominal, double x, double y, Lane* rho) {
  const LaneVector zero, offset = Load(m.gap_offset.v);
  const auto coil = offset > zero;
  const LaneVector g =
      Max(offset - Load(m.direction_x.v) * x - Load(m.direction_y.v) * y, offset * kLeastGap);
  LaneVector value = m.reluctance.Value(g) * Load(per_nominal.v) + circuit.path;
  if (circuit.fringing != 0)
    value = value / Max((g / Select(coil, offset, 1) - 1) * circuit.fringing + 1, 0.1);
  Store(rho->v, Select(coil, value, 1e12));
}

}  // namespace

FluxFilter::FluxFilter(const LinkageModel& nominal, const SamplingSettings& sampling,
                       const FluxCircuit& circuit)
    : model_(nominal), sampling_(sampling), circuit_(circuit) {
  const double h = sampling_.step;
  for (int m = 0; m < kRelaxations; ++m) {
    const auto lane = static_cast<std::size_t>(m);
    const double x = 2 * std::numbers::pi * kRelaxationPoles[m] * h;
    const double b = circuit_.relaxation[lane] * -std::expm1(-x) / x;
    step_.decay[m] = std::exp(-x);
    step_.gain[m] = step_.decay[m] * b;
    step_.total += b;
    step_.total_gain += step_.gain[m];
    relaxing_ = relaxing_ || circuit_.relaxation[lane] != 0;
  }
  for (int j = 0; j < kLanes; ++j) {
    if (j >= model_.coils) continue;
    turns_[j] = 1;
    sense_[j] = model_.n[j] < 0 ? -1 : 1;
    per_nominal_[j] = 1 / model_.reluctance.Value(model_.gap_offset[j]);
    inductance_[j] = model_.n[j] * model_.n[j] * per_nominal_[j];
  }
}

Lane FluxFilter::Reluctance(double x, double y) const {
  Lane rho;
  ComputeReluctances(model_, circuit_, per_nominal_, x - circuit_.dx, y - circuit_.dy, &rho);
  return rho;
}

void FluxFilter::Begin(const MeasuredPeriod& in, FluxPeriod* out) {
  started_ = true;
  // At rest: run the first sample alone, without relaxations, twice for the tangent.
  state_ = State{};
  MeasuredPeriod still = in;
  still.x1 = in.x0;
  still.y1 = in.y0;
  const Step kept = step_;
  for (int m = 0; m < kRelaxations; ++m) step_.decay[m] = step_.gain[m] = 0;
  step_.total = step_.total_gain = 0;
  std::array<Lane, 64> first;
  for (int k = 0; k < sampling_.samples; ++k) first[static_cast<std::size_t>(k)] = in.adc[0];
  still.adc = first.data();
  Period(still, out);
  step_ = kept;
  state_.psi = out->flux;
  for (Lane& held : state_.held) held = Lane{};
}

void FluxFilter::SetBridge(const MeasuredPeriod& in, Lane* edge, FluxPeriod* out) const {
  const AmplifierParameters& a = *sampling_.amplifier;
  const bool only_edge_moves = a.modulation == Modulation::kBiState;
  BridgeVoltage v = VoltageOf(a, 0.5, in.bus);
  for (int j = 0; j < model_.coils; ++j) {
    if (only_edge_moves)
      v.edge = (*in.duty)[j] / a.switching_frequency;
    else
      v = VoltageOf(a, (*in.duty)[j], in.bus);
    (*edge)[j] = v.edge > 0 ? v.edge : -1;
    out->phase[0].voltage[j] = v.on;
    out->phase[1].voltage[j] = v.off;
  }
}

void FluxFilter::Period(const MeasuredPeriod& in, FluxPeriod* out) {
  if (!started_) Begin(in, out);
  step_.rho = Reluctance(in.x0, in.y0);
  const Lane end = Reluctance(in.x1, in.y1);
  for (int j = 0; j < kLanes; ++j) step_.rho_change[j] = end[j] - step_.rho[j];
  Lane edge;
  SetBridge(in, &edge, out);
  const Constants c{&sense_,        &turns_,          &edge, circuit_.knee7, circuit_.knee15,
                    sampling_.step, sampling_.samples};
  const bool knee = circuit_.knee7 != 0 || circuit_.knee15 != 0;
  const auto run = model_.coupling == Coupling::kFloatingRotor
                       ? (whole_lanes ? FluxRadialWhole : FluxRadialHalves)
                   : model_.coupling == Coupling::kSides
                       ? (whole_lanes ? FluxSidesWhole : FluxSidesHalves)
                       : FluxSeparateHalves;
  run(relaxing_ || knee, knee, c, step_, in.adc, &state_, out);
}

}  // namespace ambrig
