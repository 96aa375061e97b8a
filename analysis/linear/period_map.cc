#include "analysis/linear/period_map.h"

#include <unsupported/Eigen/MatrixFunctions>

namespace ambrig {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The edge that a coil's duty moves.
struct Edge {
  double at = 0;       // [s] in the period
  double impulse = 0;  // [V s] of linkage per unit of duty
  bool whole = false;  // no edge: [V] per unit of duty over the whole period
};

Edge EdgeOf(const AmplifierParameters& p, double bus, double duty) {
  const double T = 1 / p.switching_frequency;
  const CoilVoltage v = IdealBridgeVoltage(p, duty);
  if (p.modulation == Modulation::kIdeal) return {0, bus, true};
  const double step = (v.gain[1] - v.gain[2]) * bus + v.drop[1] - v.drop[2];
  // Tri-state: |2d - 1| of the period is driven, on above one half, off below.
  const double rate = p.modulation == Modulation::kTriState ? (duty >= 0.5 ? 2 : -2) : 1;
  return {v.t2, step * T * rate, false};
}

/// What moves the plant over one ADC sample of length h.
struct SampleStep {
  double h = 0;       // [s]
  MatrixXd state;     // e^{Ah}
  MatrixXd constant;  // integral of e^{As} over the sample: constant rates of x
};

SampleStep StepOf(const MatrixXd& A, double h) {
  const Index n = A.rows();
  MatrixXd augmented = MatrixXd::Zero(2 * n, 2 * n);
  augmented.topLeftCorner(n, n) = A * h;
  augmented.topRightCorner(n, n) = h * MatrixXd::Identity(n, n);
  const MatrixXd flow = augmented.exp();
  return {h, flow.topLeftCorner(n, n), flow.topRightCorner(n, n)};
}

/// x(T) and the mean of `current` over the samples, with constant rates `rates` (n x columns) and
/// an impulse `kick` at `kicks_at` [s] (negative: none).
void OverPeriod(const LinearPlant& plant, const SampleStep& step, int samples,
                const MatrixXd& rates, double kicks_at, const VectorXd& kick, MatrixXd& x,
                MatrixXd& feedback) {
  const MatrixXd held = step.constant * rates;
  for (int k = 0; k < samples; ++k) {
    const double begin = k * step.h;
    feedback += plant.current * x / samples;
    x = (step.state * x + held).eval();
    if (kicks_at >= begin && kicks_at < begin + step.h)
      x += (plant.A * (begin + step.h - kicks_at)).exp() * kick;
  }
}

}  // namespace

PeriodMap MakePeriodMap(const OperatingPoint& point, const LinearPlant& plant) {
  const AmplifierParameters& amplifier = point.rig().amplifier;
  PeriodMap map;
  map.T = 1 / amplifier.switching_frequency;
  map.samples = point.rig().samples_per_period();
  const Index n = plant.n(), coils = static_cast<Index>(plant.coils.size()), m = plant.m();
  const SampleStep step = StepOf(plant.A, map.T / map.samples);
  map.state.setIdentity(n, n);
  map.feedback_of_state.setZero(coils, n);
  OverPeriod(plant, step, map.samples, MatrixXd::Zero(n, n), -1, {}, map.state,
             map.feedback_of_state);
  map.push.setZero(n, m);
  map.feedback_of_push.setZero(coils, m);
  OverPeriod(plant, step, map.samples, plant.pushed, -1, {}, map.push, map.feedback_of_push);
  map.duty.setZero(n, coils);
  map.feedback_of_duty.setZero(coils, coils);
  for (Index j = 0; j < coils; ++j) {
    const PlantCoil& coil = plant.coils[static_cast<std::size_t>(j)];
    for (const CoilShare& share : coil.shares) {
      const CoilPoint& at = point.coils[coil.bearing][static_cast<std::size_t>(share.lane)];
      const Edge edge = EdgeOf(amplifier, point.plant().bus.voltage, at.duty);
      const VectorXd volts = edge.impulse * share.share * VectorXd::Unit(n, 2 * m + j);
      MatrixXd x = MatrixXd::Zero(n, 1), feedback = MatrixXd::Zero(coils, 1);
      OverPeriod(plant, step, map.samples, edge.whole ? volts : VectorXd::Zero(n),
                 edge.whole ? -1 : edge.at, volts, x, feedback);
      map.duty.col(j) += x;
      map.feedback_of_duty.col(j) += feedback;
    }
  }
  return map;
}

}  // namespace ambrig
