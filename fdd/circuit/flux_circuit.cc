#include "fdd/circuit/flux_circuit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "actuators/magnetics/whole_lane_vector.h"
#include "fdd/circuit/flux_loop.h"

namespace ambrig {

namespace {

/// Lanes without a coil take next to no flux.
template <class V>
[[gnu::always_inline]] inline V PathReluctance(const LinkageModel& m, const FluxCircuit& circuit,
                                               const Lane& per_nominal, double x, double y) {
  const V zero = 0.0, offset = LoadAs<V>(m.gap_offset.v);
  const auto coil = Below(zero, offset);
  const V g = Max(offset - LoadAs<V>(m.direction_x.v) * (x - circuit.dx) -
                      LoadAs<V>(m.direction_y.v) * (y - circuit.dy),
                  offset * kLeastGap);
  V value = m.reluctance.Value(g) * LoadAs<V>(per_nominal.v) + circuit.path;
  if (circuit.fringing != 0)
    value = value / Max((g / Choose(coil, offset, 1) - 1) * circuit.fringing + 1, 0.1);
  return Choose(coil, value, 1e12);
}

template <class V>
[[gnu::always_inline]] inline void FollowMotion(const LinkageModel& m, const FluxCircuit& circuit,
                                                const Lane& per_nominal, const MeasuredPeriod& in,
                                                FluxFilter::Step* step) {
  const V start = PathReluctance<V>(m, circuit, per_nominal, in.x0, in.y0),
          end = PathReluctance<V>(m, circuit, per_nominal, in.x1, in.y1);
  Store(step->rho.v, start);
  Store(step->rho_change.v, end - start);
}
AMBRIG_WHOLE void FollowMotionWhole(const LinkageModel& m, const FluxCircuit& circuit,
                                    const Lane& per_nominal, const MeasuredPeriod& in,
                                    FluxFilter::Step* step) {
  FollowMotion<WholeLaneVector>(m, circuit, per_nominal, in, step);
}
AMBRIG_WIDE void FollowMotionHalves(const LinkageModel& m, const FluxCircuit& circuit,
                                    const Lane& per_nominal, const MeasuredPeriod& in,
                                    FluxFilter::Step* step) {
  FollowMotion<LaneVector>(m, circuit, per_nominal, in, step);
}

}  // namespace

FluxFilter::FluxFilter(const LinkageModel& nominal, const SamplingSettings& sampling,
                       const FluxCircuit& circuit)
    : model_(nominal), sampling_(sampling), circuit_(circuit), round_(circuit.run_out.none()) {
  const double h = sampling_.step;
  for (int m = 0; m < kRelaxations; ++m) {
    const double residue = circuit_.relaxation[static_cast<std::size_t>(m)];
    if (residue == 0) continue;
    const double x = 2 * std::numbers::pi * kRelaxationPoles[m] * h;
    const double b = residue * -std::expm1(-x) / x;
    const double a = std::exp(-x);
    step_.decay[relaxing_] = a;
    step_.gain[relaxing_] = a * b * (1 - a);
    step_.total += b;
    step_.of_last += b * (1 - a);
    ++relaxing_;
  }
  for (int j = 0; j < kLanes; ++j) {
    if (j >= model_.coils) continue;
    turns_[j] = 1;
    sense_[j] = model_.n[j] < 0 ? -1 : 1;
    per_nominal_[j] = 1 / model_.reluctance.Value(model_.gap_offset[j]);
    inductance_[j] = model_.n[j] * model_.n[j] * per_nominal_[j];
  }
}

void FluxFilter::Begin(const MeasuredPeriod& in, FluxPeriod* out) {
  started_ = true;
  // At rest: run the first sample alone, without relaxations, twice for the tangent.
  state_[now_] = State{};
  MeasuredPeriod still = in;
  still.x1 = in.x0;
  still.y1 = in.y0;
  still.angle1 = in.angle0;
  const Step kept = step_;
  for (int m = 0; m < kRelaxations; ++m) step_.decay[m] = step_.gain[m] = 0;
  step_.total = step_.of_last = 0;
  std::array<Lane, 64> first;
  for (int k = 0; k < sampling_.samples; ++k) first[static_cast<std::size_t>(k)] = in.adc[0];
  still.adc = first.data();
  Period(still, out);
  step_ = kept;
  State& rest = state_[now_];
  rest.psi = out->flux;
  for (int m = 0; m < relaxing_; ++m)
    for (int j = 0; j < kLanes; ++j)
      rest.held[m][j] = step_.gain[m] / (step_.decay[m] - 1) * out->flux[j];
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

void FluxFilter::Follow(const MeasuredPeriod& in) {
  (whole_lanes ? FollowMotionWhole : FollowMotionHalves)(model_, circuit_, per_nominal_, in,
                                                         &step_);
}

void FluxFilter::Period(const MeasuredPeriod& in, FluxPeriod* out) {
  if (!started_) Begin(in, out);
  if (round_) {
    Follow(in);
  } else {
    MeasuredPeriod corrected = in;
    circuit_.run_out.TakeOff(&corrected);
    Follow(corrected);
  }
  Lane edge;
  SetBridge(in, &edge, out);
  now_ = 1 - now_;
  RunFluxLoop(model_.coupling,
              {&sense_, &turns_, &edge, circuit_.knee7, circuit_.knee15, sampling_.step,
               sampling_.samples, relaxing_, &step_, in.adc},
              state_[1 - now_], &state_[now_], out);
}

}  // namespace ambrig
