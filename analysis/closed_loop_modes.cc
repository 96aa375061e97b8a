#include "analysis/closed_loop_modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "core/math/linear_equations.h"
#include "rig/parameters/bearing_kind.h"
#include "rotor/motion/linearise.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;

void SetWhirl(const std::vector<Eigen::MatrixXd>& rows, ClosedLoopMode& mode) {
  const Eigen::VectorXcd& q = mode.q;
  double forward = 0, backward = 0;
  for (const Eigen::MatrixXd& r : rows) {
    const Eigen::Vector2cd d = r.cast<Complex>() * q;
    forward += std::norm(d(0) + Complex(0, 1) * d(1));
    backward += std::norm(d(0) - Complex(0, 1) * d(1));
  }
  mode.lateral = forward + backward > 1e-9 * q.squaredNorm();  // beyond rounding
  mode.whirl = mode.lateral ? (forward - backward) / (forward + backward) : 0;
}

}  // namespace

Whirl ClosedLoopMode::sense() const {
  if (std::abs(whirl) < 0.1) return Whirl::kMixed;
  return whirl > 0 ? Whirl::kForward : Whirl::kBackward;
}

Eigen::MatrixXd ShaftRows(const OperatingPoint& point, const LinearPlant& plant, double z) {
  const RotorModel& rotor = point.plant().rotor;
  return PlaneRows(rotor, rotor.MakePlane(z))(Eigen::all, plant.coordinate);
}

std::vector<double> ShaftStations(const OperatingPoint& point) {
  double low = 0, high = 0;
  for (const BearingParameters& b : point.rig().bearings) {
    if (!b.kind->two_axes) continue;
    low = std::min({low, b.z, b.sensor.z});
    high = std::max({high, b.z, b.sensor.z});
  }
  for (const BendingMode& mode : point.plant().rotor.modes())
    for (const ShapePoint& p : mode.shape) {
      low = std::min(low, p.z);
      high = std::max(high, p.z);
    }
  std::vector<double> z;
  constexpr int kCount = 33;
  for (int k = 0; k < kCount && high > low; ++k)
    z.push_back(std::lerp(low, high, k / (kCount - 1.0)));
  return z;
}

ClosedLoopModes FindModes(const OperatingPoint& point, const ClosedLoop& loop, double highest) {
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(loop.Phi);
  Require(eigen.info() == Eigen::Success, "converged eigenvalues of the closed loop");
  const MatrixXcd right = eigen.eigenvectors();
  const Eigen::PartialPivLU<MatrixXcd> transposed(MatrixXcd(right.transpose()));
  const Index m = loop.plant().m();
  std::vector<Eigen::MatrixXd> rows;
  for (double z : ShaftStations(point)) rows.push_back(ShaftRows(point, loop.plant(), z));
  ClosedLoopModes out;
  out.speed = loop.speed();
  out.spectral_radius = eigen.eigenvalues().cwiseAbs().maxCoeff();
  const double limit = highest > 0 ? highest : 0.5 / loop.Ts();
  for (Index k = 0; k < loop.states(); ++k) {
    const Complex z = eigen.eigenvalues()(k);
    if (std::abs(z) < 1e-8 || z.imag() <= 1e-9) continue;
    ClosedLoopMode mode;
    mode.s = std::log(z) / loop.Ts();
    mode.frequency = mode.s.imag() / (2 * kPi);
    if (mode.frequency > limit) continue;
    mode.zeta = -mode.s.real() / std::abs(mode.s);
    mode.log_decrement = -2 * kPi * mode.s.real() / mode.s.imag();
    const Eigen::VectorXcd left = transposed.solve(Eigen::VectorXcd::Unit(loop.states(), k));
    const Eigen::ArrayXd part = (left.array() * right.col(k).array()).abs();
    const double rotor = part.head(2 * m).sum(), all = part.sum();
    mode.rotor_share = std::isfinite(all) && all > 0 ? rotor / all : 0;
    mode.q = loop.scale().head(m).asDiagonal() * right.col(k).head(m);
    SetWhirl(rows, mode);
    out.modes.push_back(std::move(mode));
  }
  std::sort(out.modes.begin(), out.modes.end(),
            [](const auto& a, const auto& b) { return a.s.imag() < b.s.imag(); });
  return out;
}

}  // namespace ambrig
