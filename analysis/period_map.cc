#include "analysis/period_map.h"

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

}  // namespace

PeriodMap MakePeriodMap(const OperatingPoint& point, const LinearPlant& plant) {
  const AmplifierParameters& amplifier = point.rig().amplifier;
  PeriodMap map;
  map.T = 1 / amplifier.switching_frequency;
  map.samples = point.rig().samples_per_period();
  const Index n = plant.n(), coils = static_cast<Index>(plant.coils.size()), first = 2 * plant.m();
  const double h = map.T / map.samples;
  const MatrixXd step = (plant.A * h).exp();
  map.duty.setZero(n, coils);
  map.feedback_of_state.setZero(coils, n);
  map.feedback_of_duty.setZero(coils, coils);
  map.state.setIdentity(n, n);
  for (int k = 0; k < map.samples; ++k) {
    map.feedback_of_state += plant.current * map.state / map.samples;
    map.state = step * map.state;
  }
  for (Index j = 0; j < coils; ++j) {
    const PlantCoil& coil = plant.coils[static_cast<std::size_t>(j)];
    const CoilPoint& at = point.coils[coil.bearing][static_cast<std::size_t>(coil.lane)];
    const Edge edge = EdgeOf(amplifier, point.plant().bus.voltage, at.duty);
    VectorXd x = VectorXd::Zero(n);
    MatrixXd rate = MatrixXd::Zero(n + 1, n + 1);  // a constant input as one more state
    rate.topLeftCorner(n, n) = plant.A;
    if (edge.whole) rate(first + j, n) = edge.impulse;
    const MatrixXd held = edge.whole ? MatrixXd((rate * h).exp()) : MatrixXd();
    for (int k = 0; k < map.samples; ++k) {
      const double begin = k * h;
      map.feedback_of_duty.col(j) += plant.current * x / map.samples;
      if (edge.whole) {
        x = held.topLeftCorner(n, n) * x + held.topRightCorner(n, 1);
        continue;
      }
      x = step * x;
      if (edge.at >= begin && edge.at < begin + h)
        x += ((plant.A * (begin + h - edge.at)).exp()).col(first + j) * edge.impulse;
    }
    map.duty.col(j) = x;
  }
  return map;
}

}  // namespace ambrig
