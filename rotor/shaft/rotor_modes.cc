#include "rotor/shaft/rotor_modes.h"

#include <algorithm>

#include "core/math/constants.h"
#include "core/math/linear_equations.h"
#include "rotor/shaft/state_modes.h"

namespace ambrig {
namespace {

using Complex = std::complex<double>;
constexpr Complex kI{0, 1};

Eigen::MatrixXd Symmetric(const Eigen::MatrixXd& a) { return 0.5 * (a + a.transpose()); }

PlaneModes SolvePlane(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Symmetric(K), Symmetric(M));
  if (eigen.info() != Eigen::Success)
    throw InputError("the rotor's mass matrix is singular, allowed: a shaft with mass everywhere");
  return {eigen.eigenvalues().cwiseMax(0).cwiseSqrt(), eigen.eigenvectors()};
}

/// Largest displacement positive, so that signs do not depend on the solver.
void FixSigns(Eigen::MatrixXd& shape) {
  for (Eigen::Index k = 0; k < shape.cols(); ++k) {
    Eigen::Index at = 0;
    shape.col(k).cwiseAbs().maxCoeff(&at);
    if (shape(at, k) < 0) shape.col(k) *= -1;
  }
}

}  // namespace

Whirl WhirlMode::sense() const {
  if (std::abs(whirl) < 0.1) return Whirl::kMixed;
  return whirl > 0 ? Whirl::kForward : Whirl::kBackward;
}

PlaneModes FreeModes(const BeamRotor& rotor, int count) {
  const PlaneModes all = SolvePlane(rotor.K, rotor.M);
  const int rigid = 2 * std::max<int>(1, static_cast<int>(rotor.shafts.size()));
  const int available = std::min<int>(count, static_cast<int>(all.omega.size()) - rigid);
  PlaneModes out{all.omega.segment(rigid, available), all.shape.middleCols(rigid, available)};
  FixSigns(out.shape);
  return out;
}

PlaneModes HeldModes(const BeamRotor& rotor, const std::vector<int>& held, int count) {
  std::vector<int> kept;
  for (int i = 0; i < rotor.M.rows(); ++i)
    if (std::find(held.begin(), held.end(), i) == held.end()) kept.push_back(i);
  const PlaneModes part = SolvePlane(rotor.K(kept, kept), rotor.M(kept, kept));
  const int available = std::min<int>(count, static_cast<int>(kept.size()));
  PlaneModes out{part.omega.head(available), Eigen::MatrixXd::Zero(rotor.M.rows(), available)};
  out.shape(kept, Eigen::all) = part.shape.leftCols(available);
  FixSigns(out.shape);
  return out;
}

std::vector<WhirlMode> WhirlModes(const LinearRotor& rotor, double speed, int count) {
  std::vector<WhirlMode> modes = OscillatoryModes(SolveState(rotor, speed), count);
  for (WhirlMode& m : modes) m.whirl = WhirlIndex(rotor.xy, m.shape);
  return modes;
}

std::vector<WhirlMode> WhirlModes(const TruncatedRotor& rotor, const LinearRotor& full,
                                  double speed, int count) {
  std::vector<WhirlMode> modes = OscillatoryModes(SolveState(rotor.modal, speed), count);
  for (WhirlMode& m : modes) m.whirl = WhirlIndex(full.xy, rotor.basis * m.shape);
  return modes;
}

std::vector<CampbellRow> Campbell(const LinearRotor& rotor, const std::vector<double>& speeds,
                                  int count) {
  std::vector<CampbellRow> rows;
  for (double speed : speeds) rows.push_back({speed, WhirlModes(rotor, speed, count)});
  return rows;
}

std::vector<CriticalSpeed> CriticalSpeeds(const LinearRotor& rotor, int count) {
  const Eigen::MatrixXd K = Symmetric(rotor.K);
  Require((rotor.K - K).cwiseAbs().maxCoeff() <= 1e-9 * K.cwiseAbs().maxCoeff(),
          "a symmetric stiffness");
  const Eigen::LLT<Eigen::MatrixXd> llt(K);
  Require(llt.info() == Eigen::Success, "a positive definite stiffness (a supported rotor)");
  const Eigen::MatrixXcd L = Eigen::MatrixXd(llt.matrixL()).cast<Complex>();
  const Eigen::MatrixXcd synchronous = rotor.M.cast<Complex>() - kI * rotor.G.cast<Complex>();
  const Eigen::MatrixXcd left = L.triangularView<Eigen::Lower>().solve(synchronous);
  const Eigen::MatrixXcd H = L.triangularView<Eigen::Lower>().solve(left.adjoint());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> eigen(
      Eigen::MatrixXcd(0.5 * (H + H.adjoint())));
  std::vector<CriticalSpeed> out;
  for (Eigen::Index k = H.rows() - 1; k >= 0 && static_cast<int>(out.size()) < count; --k) {
    const double inverse_square = eigen.eigenvalues()(k);
    // Not positive: the polar inertia lifts that forward mode above the speed line for ever.
    if (inverse_square <= 1e-14 * eigen.eigenvalues()(H.rows() - 1)) break;
    CriticalSpeed c{1 / std::sqrt(inverse_square), 0,
                    L.adjoint().triangularView<Eigen::Upper>().solve(eigen.eigenvectors().col(k))};
    c.whirl = WhirlIndex(rotor.xy, c.shape);
    out.push_back(std::move(c));
  }
  return out;
}

std::vector<CriticalMapRow> CriticalSpeedMap(const BeamRotor& rotor,
                                             const std::vector<double>& stiffnesses, int count) {
  std::vector<CriticalMapRow> rows;
  BeamRotor copy = rotor;
  for (double k : stiffnesses) {
    for (SpringSupport& s : copy.supports) s = IsotropicSupport(s.z, k, 0);
    rows.push_back({k, CriticalSpeeds(Assemble(copy), count)});
  }
  return rows;
}

Eigen::VectorXcd UnbalanceResponse(const LinearRotor& rotor,
                                   const std::vector<Unbalance>& unbalances, double speed) {
  Eigen::VectorXcd f = Eigen::VectorXcd::Zero(rotor.M.rows());
  for (const Unbalance& u : unbalances) {
    const auto& [x, y] = rotor.xy[u.node];
    const Complex force = std::polar(u.magnitude * speed * speed, u.phase);
    f(x) += force;
    f(y) -= kI * force;
  }
  const Eigen::MatrixXcd dynamic = rotor.K.cast<Complex>() -
                                   speed * speed * rotor.M.cast<Complex>() +
                                   kI * speed * (rotor.D + speed * rotor.G).cast<Complex>();
  return SolveComplex(dynamic, f);
}

OrbitAxes AxesOfOrbit(Complex x, Complex y) {
  const double forward = std::abs(x + kI * y) / 2, backward = std::abs(x - kI * y) / 2;
  return {forward + backward, forward - backward};
}

TruncatedRotor Truncate(const LinearRotor& rotor, int count) {
  const PlaneModes modes = SolvePlane(rotor.K, rotor.M);
  const Eigen::MatrixXd B = modes.shape.leftCols(std::min<Eigen::Index>(count, rotor.M.rows()));
  const auto project = [&](const Eigen::MatrixXd& a) -> Eigen::MatrixXd {
    return B.transpose() * a * B;
  };
  LinearRotor modal;
  modal.M = project(rotor.M);
  modal.G = project(rotor.G);
  modal.D = project(rotor.D);
  modal.K = project(rotor.K);
  return {modal, B};
}

}  // namespace ambrig
