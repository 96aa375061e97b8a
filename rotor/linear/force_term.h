#pragma once
/// Seam of the rotor: forces that the base model does not have (unbalance, cross-coupling, ...).
#include <array>
#include <cstddef>

namespace ambrig {

inline constexpr int kMaxModes = 8;  // bending modes of one rotor
// Rigid 5, two per mode, a base 2, races on mounts 2 and 1 each.
inline constexpr int kMaxDof = 5 + 2 * kMaxModes + 11;
inline constexpr std::size_t kMaxPlane = 4 + 2 * kMaxModes;  // coordinates that a plane sees
using DofVector = std::array<double, kMaxDof>;

/// State of the rotor and of everything that moves with it. The first five coordinates are those of
/// base_model.md section 1: x, y, z [m], alpha about x, beta about y [rad]; then bending modes, the
/// stator's base, races on mounts.
struct MotionState {
  double t = 0;                 // [s]
  double theta = 0, Omega = 0;  // spin angle [rad] and speed [rad/s]
  double Omega_dot = 0;         // [rad/s2]
  DofVector q{}, v{};           // coordinates and rates
};

/// A point of a plane across the axis. [m], or [m/s] of a velocity
struct PlanePoint {
  double x = 0, y = 0;
};

/// How a plane at axial position z sees the coordinates: x_plane = Σ wx_d q_d, y_plane = Σ wy_d
/// q_d.
struct PlaneMap {
  double z = 0;  // [m]
  int count = 0;
  bool of_rigid_rotor = true;  // nothing but x + z beta, y - z alpha: so far as was added
  std::array<int, kMaxPlane> dof{};
  std::array<double, kMaxPlane> wx{}, wy{};
  void Add(int d, double x, double y) {
    dof[static_cast<std::size_t>(count)] = d;
    wx[static_cast<std::size_t>(count)] = x;
    wy[static_cast<std::size_t>(count)] = y;
    of_rigid_rotor = of_rigid_rotor && IsRigid(count, d, x, y);
    ++count;
  }
  double X(const DofVector& q) const { return Follows() ? q[0] + z * q[4] : Dot(wx, q); }
  double Y(const DofVector& q) const { return Follows() ? q[1] - z * q[3] : Dot(wy, q); }
  PlanePoint Point(const DofVector& q) const { return {X(q), Y(q)}; }
  /// Generalised forces of a radial force (fx, fy) at this plane.
  void AddForce(double fx, double fy, DofVector& Q) const {
    if (Follows()) {
      Q[0] += fx;
      Q[1] += fy;
      Q[4] += z * fx;
      Q[3] -= z * fy;
      return;
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
      Q[U(k)] += wx[k] * fx + wy[k] * fy;
  }

 private:
  bool Follows() const { return of_rigid_rotor && count == 4; }
  /// Whether entry k of a radial plane of a rigid rotor is this one.
  bool IsRigid(int k, int d, double x, double y) const {
    constexpr int order[4] = {0, 1, 4, 3};
    const double rx[4] = {1, 0, z, 0}, ry[4] = {0, 1, 0, -z};
    return k < 4 && d == order[k] && x == rx[k] && y == ry[k];
  }
  double Dot(const std::array<double, kMaxPlane>& w, const DofVector& q) const {
    double s = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) s += w[k] * q[U(k)];
    return s;
  }
  std::size_t U(std::size_t k) const { return static_cast<std::size_t>(dof[k]); }
};

/// Sums that a force term adds to.
struct RotorForces {
  RotorForces() : RotorForces(DofVector{}) {}
  explicit RotorForces(const DofVector& generalised) : Q(generalised) {}

  DofVector Q;        // generalised forces on q
  double torque = 0;  // about the spin axis [N m]
  // what the stator pushes on the rotor (its reaction moves a base) [N]
  double stator_x = 0, stator_y = 0;
  // acceleration of the frame [m/s2]; the rotor sees its negative
  double base_ax = 0, base_ay = 0;
};

class ForceTerm {
 public:
  virtual ~ForceTerm() = default;
  virtual void Add(const MotionState& state, RotorForces& forces) const = 0;
};

}  // namespace ambrig
