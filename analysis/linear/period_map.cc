#include "analysis/linear/period_map.h"

#include <unsupported/Eigen/MatrixFunctions>

#include <cmath>

#include "analysis/linear/bridge_point.h"
#include "core/base/index.h"

namespace ambrig {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What moves the plant over one ADC sample.
struct SampleStep {
  double h = 0;     // [s]
  double norm = 0;  // of A, the largest sum of a column [1/s]
  MatrixXd state;   // e^{Ah}
  MatrixXd held;    // integral of e^{As} over the sample, of given constant rates (n x columns)
};

SampleStep StepOf(const MatrixXd& A, const MatrixXd& rates, double h) {
  const Index n = A.rows(), r = rates.cols();
  MatrixXd augmented = MatrixXd::Zero(n + r, n + r);
  augmented.topLeftCorner(n, n) = A * h;
  augmented.topRightCorner(n, r) = rates * h;
  const MatrixXd flow = augmented.exp();
  const double norm = A.cwiseAbs().colwise().sum().maxCoeff();
  return {h, norm, flow.topLeftCorner(n, n), flow.topRightCorner(n, r)};
}

/// e^{At} x by Taylor's series over parts of t in which |A| t is about 1.
VectorXd Flow(const MatrixXd& A, double norm, double t, VectorXd x) {
  constexpr int kTerms = 24;
  const int parts = std::max(1, static_cast<int>(std::ceil(norm * t)));
  const double dt = t / parts;
  for (int part = 0; part < parts; ++part) {
    VectorXd term = x;
    for (int k = 1; k <= kTerms; ++k) {
      term = (A * term * (dt / k)).eval();
      x += term;
      if (term.lpNorm<Eigen::Infinity>() <= 1e-17 * x.lpNorm<Eigen::Infinity>()) break;
    }
  }
  return x;
}

/// A to a whole power, at least 1.
MatrixXd Power(MatrixXd A, int n) {
  MatrixXd out;
  for (; n > 0; n /= 2) {
    if (n % 2 == 1) out = out.size() == 0 ? A : (out * A).eval();
    if (n > 1) A = (A * A).eval();
  }
  return out;
}

/// Mean over the samples of what the current sensors read of x(0) (c x n).
MatrixXd MeanOfState(const LinearPlant& plant, const SampleStep& step, int samples) {
  MatrixXd rows = plant.measured / samples, out = rows;
  for (int k = 1; k < samples; ++k) {
    rows = (rows * step.state).eval();
    out += rows;
  }
  return out;
}

/// x(T) and the mean of what the current sensors read over the samples, with what constant rates
/// add to a sample.
void OverPeriod(const LinearPlant& plant, const SampleStep& step, int samples, const MatrixXd& held,
                MatrixXd& x, MatrixXd& feedback) {
  for (int k = 0; k < samples; ++k) {
    feedback += plant.measured * x / samples;
    x = (step.state * x + held).eval();
  }
}

/// The same of an impulse `kick` at `at` [s] from rest.
void AfterKick(const LinearPlant& plant, const SampleStep& step, int samples, double at,
               const VectorXd& kick, MatrixXd& x, MatrixXd& feedback) {
  for (int k = 0; k < samples; ++k) {
    const double end = (k + 1) * step.h;
    feedback += plant.measured * x / samples;
    if (at >= end) continue;
    if (at >= k * step.h)
      x = Flow(plant.A, step.norm, end - at, kick);
    else
      x = (step.state * x).eval();
  }
}

}  // namespace

PeriodMap MakePeriodMap(const OperatingPoint& point, const LinearPlant& plant) {
  const AmplifierParameters& amplifier = point.rig().amplifier;
  PeriodMap map;
  map.T = 1 / amplifier.switching_frequency;
  map.samples = point.rig().samples_per_period();
  const Index n = plant.n(), coils = static_cast<Index>(plant.coils.size()), m = plant.m();
  const bool ideal = amplifier.modulation == Modulation::kIdeal;
  MatrixXd rates = MatrixXd::Zero(n, m + (ideal ? coils : 0));
  rates.leftCols(m) = plant.pushed;
  if (ideal) rates.block(2 * m, m, coils, coils).setIdentity();
  const SampleStep step = StepOf(plant.A, rates, map.T / map.samples);
  map.state = Power(step.state, map.samples);
  map.feedback_of_state = MeanOfState(plant, step, map.samples);
  map.push.setZero(n, m);
  map.feedback_of_push.setZero(coils, m);
  OverPeriod(plant, step, map.samples, step.held.leftCols(m), map.push, map.feedback_of_push);
  map.duty.setZero(n, coils);
  map.feedback_of_duty.setZero(coils, coils);
  for (Index j = 0; j < coils; ++j) {
    const PlantCoil& coil = plant.coils[static_cast<std::size_t>(j)];
    for (const CoilShare& share : coil.shares) {
      const std::size_t lane = AsSize(share.lane);
      const BridgePoint bridge =
          BridgeAt(amplifier, point.plant().bearings[coil.bearing].bridge[lane],
                   point.plant().bus.voltage, point.coils[coil.bearing][lane].duty);
      const double size = bridge.impulse * share.share;
      MatrixXd x = MatrixXd::Zero(n, 1), feedback = MatrixXd::Zero(coils, 1);
      if (bridge.whole)
        OverPeriod(plant, step, map.samples, size * step.held.col(m + j), x, feedback);
      else
        AfterKick(plant, step, map.samples, bridge.edge, size * VectorXd::Unit(n, 2 * m + j), x,
                  feedback);
      map.duty.col(j) += x;
      map.feedback_of_duty.col(j) += feedback;
    }
  }
  return map;
}

}  // namespace ambrig
