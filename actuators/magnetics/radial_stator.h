#pragma once
/// Magnetic circuit of a heteropolar radial bearing: eight poles, one coil each, all gaps meeting
/// at the rotor. Linear iron; iron laws are effects (actuators/magnetics/flux_law.h is their seam).
///
///   g_j   = g0 - x cos γ_j - y sin γ_j                    gap               [m]
///   P_j   = mu0 A / g_j                                   permeance         [H]
///   phi_j = P_j (N s_j i_j - U_r),  Σ phi_j = 0           flux              [Wb]
///   L(r)  = N² S (P - P 1 1ᵀ P / 1ᵀP1) S + L_l I          inductance        [H]
///   f     = Σ phi_j² (cos γ_j, sin γ_j) / (2 mu0 A)       force on the rotor [N]
///
/// r = (x, y) is the shaft centre at the bearing plane, stator axes [m]; i the coil currents [A].
/// Source: docs/theory/stator.md; docs/theory/base_model.md section 2.
#include <Eigen/Dense>
#include <string>

#include "core/base/parameters.h"
#include "core/math/constants.h"

namespace ambrig {

inline constexpr int kPoles = 8;
using CoilVector = Eigen::Matrix<double, kPoles, 1>;
using CoilMatrix = Eigen::Matrix<double, kPoles, kPoles>;

/// Geometry and winding of one radial bearing.
struct RadialStatorParameters {
  double turns = kRequired;
  double pole_area = kRequired;
  double gap = kRequired;
  double leakage_inductance = kRequired;
  double resistance = kRequired;
  double first_pole_angle_deg = 22.5;
  std::string winding = "NSNSNSNS";
};

inline constexpr Field<RadialStatorParameters> kRadialStatorFields[] = {
    {"turns", &RadialStatorParameters::turns, "-", 1, 1e4, "N, per coil"},
    {"pole_area", &RadialStatorParameters::pole_area, "m2", 1e-8, 1.0, "A"},
    {"gap", &RadialStatorParameters::gap, "m", 1e-6, 1e-1, "g0, rotor centred"},
    {"leakage_inductance", &RadialStatorParameters::leakage_inductance, "H", 1e-9, 1.0,
     "L_l, never zero: it keeps L(r) invertible"},
    {"resistance", &RadialStatorParameters::resistance, "ohm", 1e-6, 1e4, "R, per coil"},
    {"first_pole_angle_deg", &RadialStatorParameters::first_pole_angle_deg, "deg", -360, 360,
     "angle of pole 1 from the x axis"},
};

class RadialStator {
 public:
  explicit RadialStator(const RadialStatorParameters& parameters);

  CoilVector Gap(const Eigen::Vector2d& r) const;                              // [m]
  CoilVector Flux(const Eigen::Vector2d& r, const CoilVector& i) const;        // [Wb]
  CoilMatrix Inductance(const Eigen::Vector2d& r) const;                       // [H], symmetric
  Eigen::Vector2d Force(const Eigen::Vector2d& r, const CoilVector& i) const;  // [N]
  /// Currents of given linkages by the diagonal-plus-rank-one inverse, O(8). [Wb] -> [A]
  CoilVector Currents(const Eigen::Vector2d& r, const CoilVector& lambda) const;

  /// k of f = k c0 v: 4 mu0 N² A / g0² for eight poles. [N/A²]
  double ForceConstant() const;
  const CoilVector& cosine() const { return cos_; }  // of the pole angles γ_j
  const CoilVector& sine() const { return sin_; }
  const CoilVector& sense() const { return s_; }  // winding, +1 or -1
  const RadialStatorParameters& parameters() const { return p_; }

 private:
  CoilVector Permeance(const Eigen::Vector2d& r) const;

  RadialStatorParameters p_;
  CoilVector cos_, sin_, s_;
};

}  // namespace ambrig
