#include "control/linear/state_space.h"

#include <cmath>

#include "core/base/errors.h"
#include "core/math/linear_equations.h"

namespace ambrig {

StateSpace StateSpace::Gain(const Eigen::MatrixXd& D) {
  return {Eigen::MatrixXd(0, 0), Eigen::MatrixXd(0, D.cols()), Eigen::MatrixXd(D.rows(), 0), D};
}

Eigen::MatrixXcd StateSpace::Response(std::complex<double> z) const {
  if (states() == 0) return D.cast<std::complex<double>>();
  Eigen::MatrixXcd pencil = -A.cast<std::complex<double>>();
  pencil.diagonal().array() += z;
  return C * SolveComplexColumns(pencil, B.cast<std::complex<double>>()) +
         D.cast<std::complex<double>>();
}

StateSpace Series(const StateSpace& first, const StateSpace& second) {
  const Eigen::Index n = first.states(), m = second.states();
  StateSpace s;
  s.A.setZero(n + m, n + m);
  s.A.topLeftCorner(n, n) = first.A;
  s.A.bottomLeftCorner(m, n) = second.B * first.C;
  s.A.bottomRightCorner(m, m) = second.A;
  s.B.resize(n + m, first.inputs());
  s.B << first.B, second.B * first.D;
  s.C.resize(second.outputs(), n + m);
  s.C << second.D * first.C, second.C;
  s.D = second.D * first.D;
  return s;
}

StateSpace Append(const std::vector<StateSpace>& parts) {
  Eigen::Index n = 0, m = 0, p = 0;
  for (const StateSpace& k : parts) {
    n += k.states();
    m += k.inputs();
    p += k.outputs();
  }
  StateSpace s{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, m),
               Eigen::MatrixXd::Zero(p, n), Eigen::MatrixXd::Zero(p, m)};
  n = m = p = 0;
  for (const StateSpace& k : parts) {
    s.A.block(n, n, k.states(), k.states()) = k.A;
    s.B.block(n, m, k.states(), k.inputs()) = k.B;
    s.C.block(p, n, k.outputs(), k.states()) = k.C;
    s.D.block(p, m, k.outputs(), k.inputs()) = k.D;
    n += k.states();
    m += k.inputs();
    p += k.outputs();
  }
  return s;
}

Eigen::MatrixXd LoopMatrix(const StateSpace& P, const StateSpace& K) {
  const Eigen::Index n = P.states(), m = K.states();
  // y = C x + D u, u = Ck xk + Dk y: solved for u.
  const Eigen::MatrixXd E =
      InverseOf(Eigen::MatrixXd::Identity(P.inputs(), P.inputs()) - K.D * P.D);
  Eigen::MatrixXd u(P.inputs(), n + m), y(P.outputs(), n + m);
  u << E * K.D * P.C, E * K.C;
  y << P.C, Eigen::MatrixXd::Zero(P.outputs(), m);
  y += P.D * u;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + m, n + m);
  A.topLeftCorner(n, n) = P.A;
  A.bottomRightCorner(m, m) = K.A;
  A.topRows(n) += P.B * u;
  A.bottomRows(m) += K.B * y;
  return A;
}

double SpectralRadius(const Eigen::MatrixXd& A) {
  return A.rows() == 0 ? 0 : A.eigenvalues().cwiseAbs().maxCoeff();
}

StateSpace Bilinear(const StateSpace& s, double Ts, double prewarp) {
  const double c = prewarp > 0 ? prewarp / std::tan(prewarp * Ts / 2) : 2 / Ts;
  const Eigen::Index n = s.states();
  if (n == 0) return s;
  // x' = A x + B u with s = c (z-1)/(z+1); the state is w = (c I - A) x - B u.
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(n, n);
  const Eigen::MatrixXd inverse = InverseOf(c * I - s.A);
  StateSpace d;
  d.A = (c * I + s.A) * inverse;
  d.B = (d.A + I) * s.B;
  d.C = s.C * inverse;
  d.D = s.D + d.C * s.B;
  return d;
}

StateSpace FromTransferFunction(const std::vector<double>& numerator,
                                const std::vector<double>& denominator) {
  std::size_t first = 0;
  while (first < denominator.size() && denominator[first] == 0) ++first;
  Require(first < denominator.size() && !numerator.empty(),
          "a transfer function with a denominator");
  const std::vector<double> den(denominator.begin() + static_cast<std::ptrdiff_t>(first),
                                denominator.end());
  std::size_t lead = 0;
  while (lead + 1 < numerator.size() && numerator[lead] == 0) ++lead;
  std::vector<double> num(numerator.begin() + static_cast<std::ptrdiff_t>(lead), numerator.end());
  Require(num.size() <= den.size(), "a proper transfer function");
  num.insert(num.begin(), den.size() - num.size(), 0.0);
  const auto n = static_cast<Eigen::Index>(den.size()) - 1;
  StateSpace s;
  s.A.setZero(n, n);
  s.B.setZero(n, 1);
  s.C.setZero(1, n);
  s.D = Eigen::MatrixXd::Constant(1, 1, num[0] / den[0]);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k) + 1;
    s.A(0, k) = -den[at] / den[0];
    s.C(0, k) = (num[at] - num[0] * den[at] / den[0]) / den[0];
    if (k > 0) s.A(k, k - 1) = 1;
  }
  if (n > 0) s.B(0, 0) = 1;
  return s;
}

}  // namespace ambrig
