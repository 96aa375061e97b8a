#include "analysis/closed_loop.h"

#include <cmath>

#include "analysis/balance.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

std::size_t U(Index k) { return static_cast<std::size_t>(k); }

/// Set-points of the coils per force of an axis; zero where a set-point is at its limit.
MatrixXd SetPointsOf(const OperatingPoint& point, const LinearPlant& plant) {
  MatrixXd s = MatrixXd::Zero(static_cast<Index>(plant.coils.size()), plant.axes());
  for (Index j = 0; j < s.rows(); ++j) {
    const PlantCoil& coil = plant.coils[U(j)];
    const SampledBearing& b = point.sampled->bearings[coil.bearing];
    const CurrentMap& map = point.sampled->control[coil.bearing].map;
    if (!point.coils[coil.bearing][static_cast<std::size_t>(coil.lane)].commanded) continue;
    for (std::size_t side = 0; side < b.axes; ++side)
      s(j, static_cast<Index>(b.first_axis + side)) =
          map.W(coil.lane, 1 + static_cast<Index>(side)) / (map.k * map.c0);
  }
  return s;
}

}  // namespace

template <class Matrix>
struct ClosedLoop::Signals {
  Matrix reference, excitation, sensor_error;  // (axes x columns)
};

ClosedLoop::ClosedLoop(const OperatingPoint& point, double speed)
    : ClosedLoop(point, LinearisePlant(point, speed)) {}

ClosedLoop::ClosedLoop(const OperatingPoint& point, LinearPlant plant)
    : plant_(std::move(plant)),
      period_(MakePeriodMap(point, plant_)),
      set_points_(SetPointsOf(point, plant_)),
      M_(point.rig().periods_per_control()) {
  const AmplifierParameters& a = point.rig().amplifier;
  Ts_ = M_ * period_.T;
  controller_ = LineariseController(point.rig(), Ts_, plant_.speed);
  kp_ = a.kp;
  ki_T_ = a.ki * period_.T;
  const CurrentRegulator regulator(a);
  duty_per_volt_ = regulator.DutyFromVoltage(1) - regulator.DutyFromVoltage(0);
  late_ = static_cast<int>(std::ceil(point.plant().loop_delay / period_.T - 1e-6));
  const Index coils = static_cast<Index>(plant_.coils.size());
  const Index history = 1 + (late_ + M_ - 1) / M_;  // commands f_(k-1), f_(k-2), ... still needed
  at_integral_ = plant_.n();
  at_feedback_ = at_integral_ + coils;
  at_controller_ = at_feedback_ + coils;
  at_force_ = at_controller_ + controller_.A.rows();
  const Index N = at_force_ + history * axes(), inputs = 3 * axes();
  MatrixXd x = MatrixXd::Identity(N, N + inputs);
  Signals<MatrixXd> u;
  for (MatrixXd* s : {&u.reference, &u.excitation, &u.sensor_error}) s->setZero(axes(), N + inputs);
  u.reference.middleCols(N, axes()).setIdentity();
  u.excitation.middleCols(N + axes(), axes()).setIdentity();
  u.sensor_error.rightCols(axes()).setIdentity();
  Tick(x, u, [](int, auto&, auto&) {});
  Phi = x.leftCols(N);
  Gamma = x.rightCols(inputs);
  FillOutputs();
  Balance();
}

void ClosedLoop::Balance() {
  scale_ = BalancingSizes(Phi);
  const Eigen::VectorXd inverse = scale_.cwiseInverse();
  Phi = (inverse.asDiagonal() * Phi * scale_.asDiagonal()).eval();
  Gamma = (inverse.asDiagonal() * Gamma).eval();
  C = (C * scale_.asDiagonal()).eval();
}

template <class Matrix, class Disturb>
void ClosedLoop::Tick(Matrix& x, const Signals<Matrix>& u, Disturb&& disturb) const {
  using Scalar = typename Matrix::Scalar;
  const Index n = plant_.n(), coils = static_cast<Index>(plant_.coils.size()), a = axes();
  const auto as = [](const MatrixXd& m) -> decltype(auto) { return m.template cast<Scalar>(); };
  const Matrix y = as(plant_.reading) * x.topRows(n) + u.sensor_error;
  const Matrix xc = x.middleRows(at_controller_, controller_.A.rows());
  const Matrix f = as(controller_.C) * xc + as(controller_.D_y) * y +
                   as(controller_.D_r) * u.reference + u.excitation;
  Matrix plant = x.topRows(n), integral = x.middleRows(at_integral_, coils),
         feedback = x.middleRows(at_feedback_, coils);
  for (int j = 0; j < M_; ++j) {
    const Index age = j >= late_ ? 0 : (late_ - j + M_ - 1) / M_;
    const Matrix e = as(set_points_) * x.middleRows(at_force_ + age * a, a) - feedback;
    integral += ki_T_ * e;
    const Matrix duty = duty_per_volt_ * (kp_ * e + integral);
    feedback = as(period_.feedback_of_state) * plant + as(period_.feedback_of_duty) * duty;
    plant = (as(period_.state) * plant + as(period_.duty) * duty).eval();
    disturb(j, plant, feedback);
  }
  const Matrix older = x.middleRows(at_force_, x.rows() - at_force_ - a);
  x.topRows(n) = plant;
  x.middleRows(at_integral_, coils) = integral;
  x.middleRows(at_feedback_, coils) = feedback;
  x.middleRows(at_controller_, xc.rows()) =
      as(controller_.A) * xc + as(controller_.B_y) * y + as(controller_.B_r) * u.reference;
  x.middleRows(at_force_, a) = f;
  x.bottomRows(older.rows()) = older;
}

void ClosedLoop::FillOutputs() {
  const Index n = plant_.n(), a = axes(), coils = static_cast<Index>(plant_.coils.size());
  C.setZero(4 * a + coils, Phi.rows());
  D.setZero(C.rows(), 3 * a);
  C.block(0, 0, a, n) = plant_.reading;
  D.block(0, SensorError(0), a, a).setIdentity();
  C.block(a, 0, a, n) = controller_.D_y * plant_.reading;
  C.block(a, at_controller_, a, controller_.C.cols()) = controller_.C;
  D.block(a, Reference(0), a, a) = controller_.D_r;
  D.block(a, Excitation(0), a, a).setIdentity();
  D.block(a, SensorError(0), a, a) = controller_.D_y;
  C.block(2 * a, 0, a, n) = plant_.position;
  C.block(3 * a, 0, a, n) = plant_.force;
  C.block(4 * a, 0, coils, n) = plant_.current;
}

VectorXcd ClosedLoop::Disturbance(const HarmonicInput& in) const {
  const Complex iw(0, in.omega);
  const Index n = plant_.n();
  // Steady part p e^{iωt} of the plant alone; the rest of x follows the free equations.
  const MatrixXcd dynamics = iw * MatrixXcd::Identity(n, n) - plant_.A.cast<Complex>();
  const VectorXcd p = dynamics.partialPivLu().solve(plant_.pushed.cast<Complex>() * in.pushed);
  const VectorXcd end = std::exp(iw * period_.T) * p - period_.state.cast<Complex>() * p;
  Complex mean = 0;
  for (int k = 0; k < period_.samples; ++k)
    mean += std::exp(iw * (k * period_.T / period_.samples));
  const VectorXcd sampled =
      plant_.current.cast<Complex>() * p * (mean / static_cast<double>(period_.samples)) -
      period_.feedback_of_state.cast<Complex>() * p;
  MatrixXcd x = MatrixXcd::Zero(Phi.rows(), 1);
  Signals<MatrixXcd> none;
  for (MatrixXcd* s : {&none.reference, &none.excitation, &none.sensor_error})
    s->setZero(axes(), 1);
  Tick(x, none, [&](int j, MatrixXcd& plant, MatrixXcd& feedback) {
    const Complex phase = std::exp(iw * (j * period_.T));
    plant += phase * end;
    feedback += phase * sampled;
  });
  return scale_.cwiseInverse().asDiagonal() * x.col(0);
}

VectorXcd ClosedLoop::Harmonic(const HarmonicInput& in) const {
  MatrixXcd shifted = -Phi.cast<Complex>();
  shifted.diagonal().array() += std::polar(1.0, in.omega * Ts_);
  return C.cast<Complex>() * shifted.partialPivLu().solve(Disturbance(in));
}

}  // namespace ambrig
