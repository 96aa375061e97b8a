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
/// physics.md section 1: x, y, z [m], alpha about x, beta about y [rad]; then bending modes, the
/// stator's base, races on mounts.
struct MotionState {
  double t = 0;                    // [s]
  double theta = 0, Omega = 0;     // spin angle [rad] and speed [rad/s]
  double Omega_dot = 0;            // [rad/s2]
  DofVector q{}, v{};              // coordinates and rates
};

/// How a plane at axial position z sees the coordinates: x_plane = Σ wx_d q_d, y_plane = Σ wy_d q_d.
struct PlaneMap {
  double z = 0;                    // [m]
  int count = 0;
  std::array<int, kMaxPlane> dof{};
  std::array<double, kMaxPlane> wx{}, wy{};
  void Add(int d, double x, double y) {
    dof[static_cast<std::size_t>(count)] = d;
    wx[static_cast<std::size_t>(count)] = x;
    wy[static_cast<std::size_t>(count)] = y;
    ++count;
  }
  double X(const DofVector& q) const { return Dot(wx, q); }
  double Y(const DofVector& q) const { return Dot(wy, q); }
  /// Generalised forces of a radial force (fx, fy) at this plane.
  void AddForce(double fx, double fy, DofVector& Q) const {
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
      Q[U(k)] += wx[k] * fx + wy[k] * fy;
  }

 private:
  double Dot(const std::array<double, kMaxPlane>& w, const DofVector& q) const {
    if (count == 4)  // a radial plane of a rigid rotor
      return w[0] * q[U(0)] + w[1] * q[U(1)] + w[2] * q[U(2)] + w[3] * q[U(3)];
    double s = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
      s += w[k] * q[U(k)];
    return s;
  }
  std::size_t U(std::size_t k) const { return static_cast<std::size_t>(dof[k]); }
};

/// Sums that a force term adds to.
struct RotorForces {
  DofVector Q{};        // generalised forces on q
  double torque = 0;    // about the spin axis [N m]
  double stator_x = 0, stator_y = 0;  // what the stator pushes on the rotor (its reaction moves a base) [N]
  double base_ax = 0, base_ay = 0;    // acceleration of the frame [m/s2]; the rotor sees its negative
};

class ForceTerm {
 public:
  virtual ~ForceTerm() = default;
  virtual void Add(const MotionState& state, RotorForces& forces) const = 0;
};

}  // namespace ambrig
