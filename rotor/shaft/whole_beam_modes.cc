#include "rotor/shaft/whole_beam_modes.h"

#include <algorithm>

#include "rotor/shaft/dynamic_matrix.h"
#include "rotor/shaft/state_modes.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;

/// Columns of `a` made orthonormal by M, without those that depend on others.
MatrixXd Independent(const MatrixXd& a, const MatrixXd& M) {
  if (a.cols() == 0) return a;
  MatrixXd scaled = a;
  for (Index k = 0; k < a.cols(); ++k) {
    const double norm = std::sqrt(a.col(k).dot(M * a.col(k)));
    if (norm > 0) scaled.col(k) /= norm;
  }
  const Eigen::SelfAdjointEigenSolver<MatrixXd> gram(MatrixXd(scaled.transpose() * M * scaled));
  std::vector<Index> kept;
  for (Index k = 0; k < a.cols(); ++k)
    if (gram.eigenvalues()(k) > 1e-9) kept.push_back(k);
  MatrixXd out(a.rows(), static_cast<Index>(kept.size()));
  for (std::size_t k = 0; k < kept.size(); ++k)
    out.col(static_cast<Index>(k)) =
        scaled * gram.eigenvectors().col(kept[k]) / std::sqrt(gram.eigenvalues()(kept[k]));
  return out;
}

/// One eigenpair of the whole beam next to (s, q); false when the iteration does not end there.
/// Two poles that are one (a defective pair: a cross-coupling one way at rest) halve the error at
/// each step; the step is then taken twice.
bool Refine(DynamicMatrix& matrix, Complex& s, Eigen::VectorXcd& q) {
  const Complex start = s;
  Complex before = 0;
  double size_before = 0;
  q.normalize();
  const Eigen::VectorXcd w = q;
  for (int k = 0; k < 12; ++k) {
    if (!matrix.Factorise(s)) return k > 0;  // s is the eigenvalue to the last digit
    const Eigen::VectorXcd u = matrix.Solve(matrix.Slope(s, q));
    const Complex step = w.dot(q) / w.dot(u);
    if (!std::isfinite(step.real()) || !std::isfinite(step.imag())) return k > 0;
    const bool halves = std::abs(step / before - 0.5) < 0.05;
    before = step;
    s -= halves ? 2.0 * step : step;
    q = u / w.dot(u);
    if (std::abs(s - start) > 0.2 * std::abs(start)) return false;
    // The next step would be its square; from two of them what it would be at most.
    const double size = std::abs(step);
    if (size < 1e-9 * std::abs(s)) break;
    if (k > 0 && !halves && size * size < 1e-12 * std::abs(s) * size_before) break;
    size_before = size;
    if (k == 11 && std::abs(step) > 1e-9 * std::abs(s)) return false;
  }
  q.normalize();
  return true;
}

/// Eigenvalues of a dense solver, whose error is that of the largest.
void Sharpen(const LinearRotor& rotor, double speed, std::vector<WhirlMode>& modes) {
  DynamicMatrix matrix(rotor, speed);
  for (WhirlMode& m : modes) {
    Complex s = m.s;
    Eigen::VectorXcd q = m.shape;
    Refine(matrix, s, q);
    if (!(std::abs(s - m.s) < 1e-4 * std::abs(m.s)) || !q.allFinite()) continue;
    const double whirl = m.whirl;
    m = MakeWhirlMode(s, m.shape);
    m.whirl = whirl;
  }
}

/// Shapes of a rotor with supports so stiff that they are rigid: the eigenvalues
///   1/(w² + shift) of M against K + shift M,
/// whose largest ones the stiffest support does not blur. False where that sum is not positive.
bool ShapesBesideRigid(const MatrixXd& K, const MatrixXd& M, double shift, Index kept,
                       const MatrixXd& forces, MatrixXd& out) {
  const MatrixXd shifted = K + shift * M;
  const Eigen::LLT<MatrixXd> llt(shifted);
  if (llt.info() != Eigen::Success) return false;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(M, shifted);
  if (eigen.info() != Eigen::Success) return false;
  // Of a rigid support's own motion 1/(w² + shift) is rounding, and so would be its shape: a mesh
  // of few nodes has no more.
  const Eigen::VectorXd& inverse = eigen.eigenvalues();
  while (kept > 1 && inverse(M.rows() - kept) < 1e-13 * inverse(M.rows() - 1)) --kept;
  MatrixXd low = eigen.eigenvectors().rightCols(kept).rowwise().reverse();
  for (Index k = 0; k < kept; ++k) low.col(k) /= std::sqrt(low.col(k).dot(M * low.col(k)));
  const MatrixXd whole = llt.solve(forces);
  MatrixXd residual = whole;
  for (int twice = 0; twice < 2; ++twice) residual -= low * (low.transpose() * (M * residual));
  for (Index k = 0; k < residual.cols(); ++k)  // of a rigid support nothing is left but rounding
    if (residual.col(k).norm() < 1e-6 * whole.col(k).norm()) residual.col(k).setZero();
  const MatrixXd extra = Independent(residual, M);
  out.resize(M.rows(), kept + extra.cols());
  out << low, extra;
  return true;
}

bool SameMode(const WhirlMode& a, const WhirlMode& b) {
  return std::abs(a.s - b.s) < 1e-8 * std::abs(a.s) &&
         std::norm(a.shape.dot(b.shape)) > 0.999 * a.shape.squaredNorm() * b.shape.squaredNorm();
}

}  // namespace

bool IsRigidMotion(const LinearRotor& rotor, const Eigen::VectorXcd& q) {
  // K q is a sum of large parts, of which rounding alone is left
  return (rotor.K * q).norm() < 1e-13 * (rotor.K.cwiseAbs() * q.cwiseAbs()).norm();
}

LinearRotor Projected(const LinearRotor& r, const MatrixXd& B) {
  const auto part = [&](const MatrixXd& a) -> MatrixXd {
    const Eigen::SparseMatrix<double> sparse = a.sparseView(1, 0);
    const MatrixXd right = sparse * B;
    return B.transpose() * right;
  };
  LinearRotor out;
  out.M = part(r.M);
  out.G = part(r.G);
  out.D = part(r.D);
  out.K = part(r.K);
  return out;
}

MatrixXd ShapesOf(const LinearRotor& rotor, int count, const MatrixXd& forces) {
  const MatrixXd M = 0.5 * (rotor.M + rotor.M.transpose()),
                 K = 0.5 * (rotor.K + rotor.K.transpose());
  const Index n = M.rows(), kept = std::min<Index>(count, n);
  if (Eigen::LLT<MatrixXd>(M).info() != Eigen::Success)
    throw InputError(
        "the rotor's mass matrix is not positive definite, allowed: added masses of supports that "
        "leave every mass positive, lumped masses with rotary inertia");
  if (const double rate = UsualRate(rotor); StiffestRate(rotor) > kRigidRate * rate) {
    MatrixXd out;
    if (ShapesBesideRigid(K, M, rate * rate, kept, forces, out)) return out;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(K, M);
  Require(eigen.info() == Eigen::Success, "converged undamped modes");
  const MatrixXd phi = eigen.eigenvectors().rightCols(n - kept);
  const MatrixXd residual =
      phi * eigen.eigenvalues().tail(n - kept).asDiagonal().inverse() * (phi.transpose() * forces);
  const MatrixXd extra = Independent(residual, M);
  MatrixXd out(n, kept + extra.cols());
  out << eigen.eigenvectors().leftCols(kept), extra;
  return out;
}

MatrixXd SupportColumns(const BeamRotor& beam) {
  const Index dofs = 2 * beam.M.rows() + 2 * static_cast<Index>(beam.housings.size());
  std::vector<int> at;
  for (const SpringSupport& s : beam.supports) {
    if (s.on_shaft()) at.push_back(4 * NodeAt(beam, s.z));
    if (s.between_shafts()) at.push_back(4 * NodeAt(beam, s.to_z));
    for (const std::string& name : {s.carries, s.on})
      if (!name.empty()) at.push_back(HousingDof(beam, name));
  }
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  MatrixXd out = MatrixXd::Zero(dofs, 2 * static_cast<Index>(at.size()));
  for (std::size_t k = 0; k < at.size(); ++k)
    for (int side : {0, 1}) out(at[k] + side, 2 * static_cast<Index>(k) + side) = 1;
  return out;
}

bool ContinueModes(const LinearRotor& rotor, double speed, std::vector<WhirlMode>& modes) {
  DynamicMatrix matrix(rotor, speed);
  std::vector<WhirlMode> found;
  for (const WhirlMode& m : modes) {
    Complex s = m.s;
    Eigen::VectorXcd q = m.shape;
    if (!Refine(matrix, s, q) || !(s.imag() > 0)) return false;
    found.push_back(MakeWhirlMode(s, std::move(q)));
    found.back().whirl = WhirlIndex(rotor.xy, found.back().shape);
    for (std::size_t k = 0; k + 1 < found.size(); ++k)
      if (SameMode(found[k], found.back())) return false;
  }
  modes = std::move(found);
  return true;
}

WholeBeamModes FindWhirlModes(const LinearRotor& rotor, const MatrixXd& shapes, double speed,
                              int count) {
  const LinearRotor reduced = Projected(rotor, shapes);
  const StateModes state = SolveState(reduced, speed);
  WholeBeamModes out;
  out.real = RealPoles(state.s);
  out.oscillatory = OscillatoryModes(state, count + 8);
  for (WhirlMode& m : out.oscillatory) m.shape = shapes * m.shape;
  std::erase_if(out.oscillatory, [&](const WhirlMode& m) { return IsRigidMotion(rotor, m.shape); });
  if (static_cast<int>(out.oscillatory.size()) > count) out.oscillatory.resize(count);
  if (!ContinueModes(rotor, speed, out.oscillatory)) {
    out.oscillatory = WhirlModes(rotor, speed, count);
    Sharpen(rotor, speed, out.oscillatory);
  }
  std::sort(out.oscillatory.begin(), out.oscillatory.end(),
            [](const auto& a, const auto& b) { return a.omega_d < b.omega_d; });
  return out;
}

std::vector<CriticalSpeed> FindCriticalSpeeds(const LinearRotor& rotor, const MatrixXd& shapes,
                                              int count) {
  LinearRotor symmetric = rotor;
  symmetric.K = 0.5 * (rotor.K + rotor.K.transpose());
  symmetric.M = 0.5 * (rotor.M + rotor.M.transpose());
  LinearRotor reduced = Projected(symmetric, shapes);
  reduced.K = 0.5 * (reduced.K + MatrixXd(reduced.K.transpose()));
  if (Eigen::LLT<MatrixXd>(reduced.K).info() != Eigen::Success) return {};
  std::vector<CriticalSpeed> out = CriticalSpeeds(reduced, count);
  // A motion that is free has a stiffness of rounding, which may be positive.
  if (std::any_of(out.begin(), out.end(), [&](const CriticalSpeed& c) {
        return IsRigidMotion(symmetric, shapes * c.shape);
      }))
    return {};
  // With D = 0, s = i Omega of s² (M - i G) + K.
  const Eigen::MatrixXcd none = Eigen::MatrixXcd::Zero(rotor.M.rows(), rotor.M.rows());
  DynamicMatrix matrix(symmetric.M.cast<Complex>() - Complex(0, 1) * rotor.G.cast<Complex>(), none,
                       symmetric.K.cast<Complex>());
  for (CriticalSpeed& c : out) {
    c.shape = shapes * c.shape;
    Complex s(0, c.speed);
    Eigen::VectorXcd q = c.shape;
    if (Refine(matrix, s, q)) {
      c.speed = s.imag();
      c.shape = std::move(q);
    }
    c.whirl = WhirlIndex(rotor.xy, c.shape);
  }
  return out;
}

}  // namespace ambrig
