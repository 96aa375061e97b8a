#include "analysis/linear/loop_plant.h"

#include <cmath>

#include "core/math/linear_equations.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

/// Set-points of the currents per force of each axis, in the order of the plant's axes.
MatrixXd SetPointsOf(const LinearPlant& plant) {
  MatrixXd out = MatrixXd::Zero(static_cast<Index>(plant.coils.size()), plant.axes());
  for (Index j = 0; j < out.rows(); ++j) {
    const PlantCoil& c = plant.coils[static_cast<std::size_t>(j)];
    out.row(j).segment(c.axis, c.command.size()) = c.command.transpose();
  }
  return out;
}

}  // namespace

LoopPlant::LoopPlant(const OperatingPoint& point, LinearPlant plant)
    : plant_(std::move(plant)),
      period_(MakePeriodMap(point, plant_)),
      set_points_(SetPointsOf(plant_)),
      M_(point.rig().periods_per_control()) {
  const AmplifierParameters& a = point.nominal().amplifier;
  Ts_ = M_ * period_.T;
  kp_ = a.kp;
  ki_T_ = a.ki * period_.T;
  fed_back_ = a.voltage_mode ? 0 : 1;
  const CurrentRegulator regulator(a);
  duty_per_volt_ = regulator.DutyFromVoltage(1) - regulator.DutyFromVoltage(0);
  late_ = static_cast<int>(std::ceil(point.plant().loop_delay / period_.T - 1e-6));
  const Index history = 1 + (late_ + M_ - 1) / M_;  // commands f_(k-1), f_(k-2), ... still needed
  const Index N = force() + history * axes(), m = plant_.m();
  MatrixXd x = MatrixXd::Identity(N, N + axes() + m);
  MatrixXd f = MatrixXd::Zero(axes(), x.cols());
  x.rightCols(axes() + m).setZero();
  f.middleCols(N, axes()).setIdentity();
  Tick(x, f, [&](int, MatrixXd& after, MatrixXd& mean) {
    after.rightCols(m) += period_.push;
    mean.rightCols(m) += period_.feedback_of_push;
  });
  A = x.leftCols(N);
  B = x.middleCols(N, axes());
  E = x.rightCols(m);
}

MatrixXd LoopPlant::Rows(const MatrixXd& of_plant) const {
  MatrixXd out = MatrixXd::Zero(of_plant.rows(), states());
  out.leftCols(plant_.n()) = of_plant;
  return out;
}

template <class Matrix, class Disturb>
void LoopPlant::Tick(Matrix& x, const Matrix& forces, Disturb&& disturb) const {
  using Scalar = typename Matrix::Scalar;
  const Index n = plant_.n(), coils = static_cast<Index>(plant_.coils.size()), a = axes();
  const auto as = [](const MatrixXd& m) -> decltype(auto) { return m.template cast<Scalar>(); };
  Matrix plant = x.topRows(n), integrals = x.middleRows(integral(), coils),
         mean = x.middleRows(feedback(), coils);
  for (int j = 0; j < M_; ++j) {
    const Index age = j >= late_ ? 0 : (late_ - j + M_ - 1) / M_;
    const Matrix e = as(set_points_) * x.middleRows(force() + age * a, a) - fed_back_ * mean;
    integrals += ki_T_ * e;
    const Matrix duty = duty_per_volt_ * (kp_ * e + integrals);
    mean = as(period_.feedback_of_state) * plant + as(period_.feedback_of_duty) * duty;
    plant = (as(period_.state) * plant + as(period_.duty) * duty).eval();
    disturb(j, plant, mean);
  }
  const Matrix older = x.middleRows(force(), x.rows() - force() - a);
  x.topRows(n) = plant;
  x.middleRows(integral(), coils) = integrals;
  x.middleRows(feedback(), coils) = mean;
  x.middleRows(force(), a) = forces;
  x.bottomRows(older.rows()) = older;
}

VectorXcd LoopPlant::Disturbance(const HarmonicInput& in) const {
  const Complex iw(0, in.omega);
  const Index n = plant_.n();
  // Steady part p e^{iωt} of the plant alone; the rest of x follows the free equations.
  const MatrixXcd dynamics = iw * MatrixXcd::Identity(n, n) - plant_.A.cast<Complex>();
  const VectorXcd p = SolveComplex(dynamics, plant_.pushed.cast<Complex>() * in.pushed);
  const VectorXcd end = std::exp(iw * period_.T) * p - period_.state.cast<Complex>() * p;
  Complex samples = 0;
  for (int k = 0; k < period_.samples; ++k)
    samples += std::exp(iw * (k * period_.T / period_.samples));
  const VectorXcd sampled =
      plant_.measured.cast<Complex>() * p * (samples / static_cast<double>(period_.samples)) -
      period_.feedback_of_state.cast<Complex>() * p;
  MatrixXcd x = MatrixXcd::Zero(states(), 1);
  Tick(x, MatrixXcd(MatrixXcd::Zero(axes(), 1)), [&](int j, MatrixXcd& plant, MatrixXcd& mean) {
    const Complex phase = std::exp(iw * (j * period_.T));
    plant += phase * end;
    mean += phase * sampled;
  });
  return x.col(0);
}

}  // namespace ambrig
