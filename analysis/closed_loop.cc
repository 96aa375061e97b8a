#include "analysis/closed_loop.h"

#include "analysis/balance.h"
#include "core/math/linear_equations.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

}  // namespace

ClosedLoop::ClosedLoop(const OperatingPoint& point, double speed)
    : ClosedLoop(point, LinearisePlant(point, speed)) {}

ClosedLoop::ClosedLoop(const OperatingPoint& point, LinearPlant plant)
    : open_(point, std::move(plant)),
      controller_(LineariseController(point.nominal(), open_.Ts(), open_.plant().speed)) {
  Close();
  FillOutputs();
  Balance();
}

void ClosedLoop::Close() {
  const LinearController& k = controller_;
  const Index n = open_.states(), c = k.A.rows(), a = axes();
  const MatrixXd reading = open_.Rows(plant().reading);
  Phi.resize(n + c, n + c);
  Phi << open_.A + open_.B * k.D_y * reading, open_.B * k.C, k.B_y * reading, k.A;
  Gamma.resize(n + c, 3 * a);
  Gamma << open_.B * k.D_r, open_.B, open_.B * k.D_y, k.B_r, MatrixXd::Zero(c, a), k.B_y;
}

void ClosedLoop::Balance() {
  scale_ = BalancingSizes(Phi);
  const Eigen::VectorXd inverse = scale_.cwiseInverse();
  Phi = (inverse.asDiagonal() * Phi * scale_.asDiagonal()).eval();
  Gamma = (inverse.asDiagonal() * Gamma).eval();
  C = (C * scale_.asDiagonal()).eval();
}

void ClosedLoop::FillOutputs() {
  const LinearPlant& p = plant();
  const Index n = p.n(), a = axes(), coils = static_cast<Index>(p.coils.size());
  C.setZero(4 * a + coils, Phi.rows());
  D.setZero(C.rows(), 3 * a);
  C.block(0, 0, a, n) = p.reading;
  D.block(0, SensorError(0), a, a).setIdentity();
  C.block(a, 0, a, n) = controller_.D_y * p.reading;
  C.block(a, open_.states(), a, controller_.C.cols()) = controller_.C;
  D.block(a, Reference(0), a, a) = controller_.D_r;
  D.block(a, Excitation(0), a, a).setIdentity();
  D.block(a, SensorError(0), a, a) = controller_.D_y;
  C.block(2 * a, 0, a, n) = p.position;
  C.block(3 * a, 0, a, n) = p.force;
  C.block(4 * a, 0, coils, n) = p.current;
}

VectorXcd ClosedLoop::Disturbance(const HarmonicInput& in) const {
  VectorXcd x = VectorXcd::Zero(Phi.rows());
  x.head(open_.states()) = open_.Disturbance(in);
  return scale_.cwiseInverse().asDiagonal() * x;
}

VectorXcd ClosedLoop::Harmonic(const HarmonicInput& in) const {
  MatrixXcd shifted = -Phi.cast<Complex>();
  shifted.diagonal().array() += std::polar(1.0, in.omega * Ts());
  return C.cast<Complex>() * SolveComplex(shifted, Disturbance(in));
}

}  // namespace ambrig
