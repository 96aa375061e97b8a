#include "rotor/motion/bending_mode.h"

#include <algorithm>
#include <cmath>

#include "core/base/index.h"
#include "rotor/shaft/reduction.h"

namespace ambrig {

namespace {
constexpr std::size_t kAlpha = 3, kBeta = 4;
constexpr int kPiecesPerElement = 4;  // a cone's shape is no cubic; a quarter of it nearly is

double DisplacementAt(const ReducedRotor& r, std::size_t e, int mode, double s) {
  return ShapeAt(r.elements[e], r.theory, s)
      .w.dot(r.shape.block<4, 1>(2 * static_cast<Eigen::Index>(e), mode));
}

/// The cubic through the values at u = 0, 1/3, 2/3, 1.
ShapePoint CubicPiece(double z, const double (&g)[4]) {
  const double third = (g[1] - (2 * g[0] + g[3]) / 3) * 4.5;       // bend + twist/3
  const double two_thirds = (g[2] - (g[0] + 2 * g[3]) / 3) * 4.5;  // bend + 2 twist/3
  return {z, g[0], 2 * third - two_thirds, 3 * (two_thirds - third)};
}

std::vector<ShapePoint> ShapeOf(const ReducedRotor& r, int mode) {
  std::vector<ShapePoint> shape;
  for (std::size_t e = 0; e < r.elements.size(); ++e)
    for (int piece = 0; piece < kPiecesPerElement; ++piece) {
      const double h = r.elements[e].length / kPiecesPerElement;
      double g[4];
      for (int k = 0; k < 4; ++k) g[k] = DisplacementAt(r, e, mode, h * (piece + k / 3.0));
      shape.push_back(CubicPiece(r.node_z[e] + h * piece - r.z_com, g));
    }
  const std::size_t last = r.elements.size() - 1;
  shape.push_back(
      {r.node_z.back() - r.z_com, DisplacementAt(r, last, mode, r.elements[last].length)});
  return shape;
}
}  // namespace

double BendingMode::Gain(double z) const {
  if (shape.empty()) return 0;
  if (shape.size() == 1) return shape[0].gain;
  std::size_t k = 0;
  while (k + 2 < shape.size() && z > shape[k + 1].z) ++k;
  const ShapePoint &a = shape[k], &b = shape[k + 1];
  const double u = (z - a.z) / (b.z - a.z),
               straight = a.gain + (b.gain - a.gain) * (z - a.z) / (b.z - a.z);
  if (u < 0) return straight + u * a.bend;
  if (u > 1) return straight - (u - 1) * (a.bend + a.twist);
  return straight + u * (1 - u) * (a.bend + a.twist * u);
}

std::vector<BendingMode> BendingModes(const ReducedRotor& r) {
  std::vector<BendingMode> out;
  for (int k = 0; k < r.modes(); ++k) {
    BendingMode mode;
    mode.omega = r.omega[AsSize(k)];
    mode.damping = r.zeta[AsSize(k)];
    mode.gyroscopic = r.J(1 + k, 1 + k);
    mode.gyroscopic_tilt = r.J(1 + k, 0);
    for (int l = 0; l < k; ++l) mode.gyroscopic_other.push_back(r.J(1 + k, 1 + l));
    mode.shape = ShapeOf(r, k);
    out.push_back(std::move(mode));
  }
  return out;
}

ModalShaft::ModalShaft(double inertia_transverse, double inertia_polar)
    : root_inertia_(std::sqrt(inertia_transverse)), row_{inertia_polar / inertia_transverse} {}

void ModalShaft::Add(const BendingMode& mode, int dof) {
  modes_.push_back(mode);
  dof_.push_back(dof);
  // w² + J Omega w has roots below max w + |J| Omega; |J| by its largest row sum (Gershgorin).
  const double tilt = std::abs(mode.gyroscopic_tilt) / root_inertia_;
  row_[0] += tilt;
  row_.push_back(std::abs(mode.gyroscopic) + tilt);
  for (std::size_t l = 0; l < mode.gyroscopic_other.size(); ++l) {
    row_[1 + l] += std::abs(mode.gyroscopic_other[l]);
    row_.back() += std::abs(mode.gyroscopic_other[l]);
  }
  omega_ = std::max(omega_, mode.omega);
  spread_ = *std::max_element(row_.begin(), row_.end());
}

void ModalShaft::AddForces(const MotionState& s, DofVector& Q) const {
  for (std::size_t k = 0; k < modes_.size(); ++k) {
    const BendingMode& mode = modes_[k];
    const std::size_t d = AsSize(dof_[k]);
    const double c = 2 * mode.damping * mode.omega, w2 = mode.omega * mode.omega;
    const double gyro = mode.gyroscopic * s.Omega;
    Q[d] -= c * s.v[d] + w2 * s.q[d] + gyro * s.v[d + 1];
    Q[d + 1] -= c * s.v[d + 1] + w2 * s.q[d + 1] - gyro * s.v[d];
    const double tilt = mode.gyroscopic_tilt * s.Omega;
    if (tilt != 0) {
      Q[d] += tilt * s.v[kAlpha];
      Q[d + 1] += tilt * s.v[kBeta];
      Q[kAlpha] -= tilt * s.v[d];
      Q[kBeta] -= tilt * s.v[d + 1];
    }
    for (std::size_t l = 0; l < mode.gyroscopic_other.size(); ++l) {
      const std::size_t o = AsSize(dof_[l]);
      const double g = mode.gyroscopic_other[l] * s.Omega;
      Q[d] -= g * s.v[o + 1];
      Q[d + 1] += g * s.v[o];
      Q[o] -= g * s.v[d + 1];
      Q[o + 1] += g * s.v[d];
    }
  }
}

void ModalShaft::AddTo(PlaneMap& plane) const {
  for (std::size_t k = 0; k < modes_.size(); ++k) {
    const double gain = modes_[k].Gain(plane.z);
    plane.Add(dof_[k], gain, 0);
    plane.Add(dof_[k] + 1, 0, gain);
  }
}

double ModalShaft::Energy(const MotionState& s) const {
  double e = 0;
  for (std::size_t k = 0; k < modes_.size(); ++k)
    for (std::size_t d = AsSize(dof_[k]); d < AsSize(dof_[k]) + 2; ++d)
      e += 0.5 * s.v[d] * s.v[d] + 0.5 * modes_[k].omega * modes_[k].omega * s.q[d] * s.q[d];
  return e;
}

}  // namespace ambrig
