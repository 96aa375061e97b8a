#pragma once
/// One bending mode of the free shaft, mass normalised, the same in both planes:
///
///   eta_x'' + 2 zeta w eta_x' + w² eta_x + Omega (Σ_l J_kl eta_yl' - J_k0 alpha') = Σ gain(z) fx
///   eta_y'' + 2 zeta w eta_y' + w² eta_y - Omega (Σ_l J_kl eta_xl' + J_k0 beta')  = Σ gain(z) fy
///
/// and the tilt feels  alpha: + Omega J_k0 eta_x',  beta: + Omega J_k0 eta_y'  on its left side.
/// The shaft centre at z moves by gain(z) eta. The gyroscopic forces do no work.
/// Source: rotor/shaft/reduction.h.
#include <utility>
#include <vector>

#include "rotor/linear/force_term.h"

namespace ambrig {

/// Gain of a mode at z, and how it bends towards the next point, u = 0..1 between the two:
///   gain = g0 + (g1 - g0) u + u (1 - u) (bend + twist u)      any cubic; straight when both are 0
struct ShapePoint {
  double z = 0;                // from the centre of mass [m]
  double gain = 0;             // [kg^-1/2]
  double bend = 0, twist = 0;  // [kg^-1/2]
};

struct BendingMode {
  double omega = 0;                      // [rad/s]
  double damping = 0;                    // zeta [-]
  double gyroscopic = 0;                 // J_kk [-]
  std::vector<ShapePoint> shape;         // along z
  double gyroscopic_tilt = 0;            // J_k0, with the rotor's tilt [kg^1/2 m]
  std::vector<double> gyroscopic_other;  // J_kl with the modes l before this one; fewer: 0
  /// Displacement of the shaft centre at z; straight on beyond the ends. [kg^-1/2]
  double Gain(double z) const;
};

struct ReducedRotor;

/// The modes of a reduced beam as the engines run them, z from the centre of mass. Exact for shafts
/// of cylindrical elements, whose shapes are cubics between the nodes; cones to 1e-6 of the shape.
std::vector<BendingMode> BendingModes(const ReducedRotor& rotor);

/// Several modes on one rotor: where their coordinates are, what they push, how fast they are.
class ModalShaft {
 public:
  /// Inertias about the centre of mass, of the tilt that the modes couple to [kg m2].
  ModalShaft(double inertia_transverse, double inertia_polar);
  /// `dof`: place of eta_x among the rotor's coordinates; eta_y follows it.
  void Add(const BendingMode& mode, int dof);
  const std::vector<BendingMode>& modes() const { return modes_; }
  int dof(std::size_t k) const { return dof_[k]; }
  bool empty() const { return modes_.empty(); }

  /// Elastic, damping and gyroscopic forces on the modes and on the tilt, added to Q.
  void AddForces(const MotionState& s, DofVector& Q) const;
  /// Coordinates of the plane at z.
  void AddTo(PlaneMap& plane) const;
  /// A bound of the fastest rate among the modes at this speed [1/s], gyroscopic stiffening in it.
  double Rate(double Omega) const { return omega_ + spread_ * (Omega < 0 ? -Omega : Omega); }
  double Energy(const MotionState& s) const;  // elastic and kinetic [J]

 private:
  std::vector<BendingMode> modes_;
  std::vector<int> dof_;
  double root_inertia_;            // √It, scales the tilt like a mode [kg^1/2 m]
  std::vector<double> row_;        // sums |J| of the tilt and of each mode, mass normalised
  double omega_ = 0, spread_ = 0;  // largest w [rad/s] and row sum [-]
};

}  // namespace ambrig
