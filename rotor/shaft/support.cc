#include "rotor/shaft/support.h"

#include <Eigen/Dense>
#include <algorithm>

#include "core/math/linear_equations.h"

namespace ambrig {

namespace {

/// Second derivatives at the knots of the spline whose third derivative does not jump at the second
/// and the last but one; with three knots this is the parabola through them.
Eigen::VectorXd Bends(const std::vector<double>& at, const std::vector<double>& y) {
  const Eigen::Index n = static_cast<Eigen::Index>(at.size());
  Eigen::VectorXd h(n - 1), slope(n - 1);
  for (Eigen::Index k = 0; k + 1 < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    h(k) = at[i + 1] - at[i];
    slope(k) = (y[i + 1] - y[i]) / h(k);
  }
  if (n == 3) return Eigen::VectorXd::Constant(3, 2 * (slope(1) - slope(0)) / (h(0) + h(1)));
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  A.row(0).head(3) << h(1), -(h(0) + h(1)), h(0);
  A.row(n - 1).tail(3) << h(n - 2), -(h(n - 3) + h(n - 2)), h(n - 3);
  for (Eigen::Index k = 1; k + 1 < n; ++k) {
    A.row(k).segment(k - 1, 3) << h(k - 1), 2 * (h(k - 1) + h(k)), h(k);
    b(k) = 6 * (slope(k) - slope(k - 1));
  }
  return SolveLinear(A, b);
}

}  // namespace

double OnTable(const std::vector<double>& at, const std::vector<double>& y, double x, bool cubic) {
  if (at.size() == 1 || x <= at.front()) return y.front();
  if (x >= at.back()) return y.back();
  const std::size_t i =
      static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), x) - at.begin()) - 1;
  const double h = at[i + 1] - at[i], t = (x - at[i]) / h;
  const double line = y[i] + t * (y[i + 1] - y[i]);
  if (!cubic || at.size() < 3) return line;
  const Eigen::VectorXd bend = Bends(at, y);
  const auto k = static_cast<Eigen::Index>(i);
  const double s = 1 - t;
  return line + h * h / 6 * ((s * s * s - s) * bend(k) + (t * t * t - t) * bend(k + 1));
}

bool SpringSupport::has_mass() const {
  const auto some = [](const SupportCoefficients& c) {
    return c.mxx != 0 || c.mxy != 0 || c.myx != 0 || c.myy != 0;
  };
  return varies() ? std::any_of(table.begin(), table.end(), some) : some(*this);
}

SupportCoefficients SpringSupport::At(double at_speed) const {
  if (!varies()) return *this;
  SupportCoefficients out;
  std::vector<double> y(table.size());
  for (const Field<SupportCoefficients>& f : kSupportCoefficients) {
    for (std::size_t k = 0; k < table.size(); ++k) y[k] = table[k].*f.at;
    out.*f.at = OnTable(speed, y, at_speed, cubic);
  }
  return out;
}

SpringSupport IsotropicSupport(double z, double k, double c) {
  SpringSupport s;
  s.z = z;
  s.kxx = s.kyy = k;
  s.cxx = s.cyy = c;
  return s;
}

}  // namespace ambrig
