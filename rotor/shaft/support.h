#pragma once
/// What holds a shaft: springs, dampers and added masses between a plane of the shaft,
/// or a housing, and the ground, another housing or a plane of another shaft (a bearing between
/// coaxial shafts, a coupling). With the relative displacement d = (x, y) of its two sides and z
/// along the axis, the force on the carried side is
///   -(k d + c d' + m d'')                  k, c, m of (2 x 2), and kzz, czz, mzz along the axis
/// and the moments -(kr t + cr t') with the rotations t = (alpha, beta) about x and y and the twist
/// about z; a housing and the ground do not turn. Constant, or a table over the shaft's speed:
/// linear between its rows or a cubic spline through them (not-a-knot), the end rows beyond.
/// Housings are rigid bodies that move in x, y (and z). Units SI, speeds rad/s.
#include <cmath>
#include <string>
#include <vector>

#include "core/base/parameters.h"

namespace ambrig {

struct SupportCoefficients {
  double kxx = 0, kxy = 0, kyx = 0, kyy = 0;  // [N/m]
  double cxx = 0, cxy = 0, cyx = 0, cyy = 0;  // [N s/m]
  double mxx = 0, mxy = 0, myx = 0, myy = 0;  // [kg]
  double kzz = 0, czz = 0, mzz = 0;           // along the axis
  double krx = 0, kry = 0, krz = 0;           // about x, y and the axis [N m/rad]
  double crx = 0, cry = 0, crz = 0;           // [N m s/rad]
};

inline constexpr Field<SupportCoefficients> kSupportCoefficients[] = {
    {"kxx", &SupportCoefficients::kxx, "N/m", -1e21, 1e21, "stiffness"},
    {"kxy", &SupportCoefficients::kxy, "N/m", -1e21, 1e21, "stiffness, x force per y displacement"},
    {"kyx", &SupportCoefficients::kyx, "N/m", -1e21, 1e21, "stiffness, y force per x displacement"},
    {"kyy", &SupportCoefficients::kyy, "N/m", -1e21, 1e21, "stiffness"},
    {"cxx", &SupportCoefficients::cxx, "N s/m", -1e12, 1e12, "damping"},
    {"cxy", &SupportCoefficients::cxy, "N s/m", -1e12, 1e12, "damping, x force per y velocity"},
    {"cyx", &SupportCoefficients::cyx, "N s/m", -1e12, 1e12, "damping, y force per x velocity"},
    {"cyy", &SupportCoefficients::cyy, "N s/m", -1e12, 1e12, "damping"},
    {"mxx", &SupportCoefficients::mxx, "kg", -1e9, 1e9, "added mass"},
    {"mxy", &SupportCoefficients::mxy, "kg", -1e9, 1e9, "added mass, x force per y acceleration"},
    {"myx", &SupportCoefficients::myx, "kg", -1e9, 1e9, "added mass, y force per x acceleration"},
    {"myy", &SupportCoefficients::myy, "kg", -1e9, 1e9, "added mass"},
    {"kzz", &SupportCoefficients::kzz, "N/m", -1e21, 1e21, "stiffness along the axis"},
    {"czz", &SupportCoefficients::czz, "N s/m", -1e12, 1e12, "damping along the axis"},
    {"mzz", &SupportCoefficients::mzz, "kg", -1e9, 1e9, "added mass along the axis"},
    {"krx", &SupportCoefficients::krx, "N m/rad", -1e15, 1e15, "stiffness about x"},
    {"kry", &SupportCoefficients::kry, "N m/rad", -1e15, 1e15, "stiffness about y"},
    {"krz", &SupportCoefficients::krz, "N m/rad", -1e15, 1e15, "torsional stiffness"},
    {"crx", &SupportCoefficients::crx, "N m s/rad", -1e12, 1e12, "damping about x"},
    {"cry", &SupportCoefficients::cry, "N m s/rad", -1e12, 1e12, "damping about y"},
    {"crz", &SupportCoefficients::crz, "N m s/rad", -1e12, 1e12, "torsional damping"},
};

struct SpringSupport : SupportCoefficients {
  double z = kRequired;  // plane on the shaft axis [m]; nan when it carries a housing
  std::string name;
  std::string carries;                     // a housing instead of the shaft
  std::string on;                          // the housing that it stands on, "" for the ground
  double to_z = kRequired;                 // instead: a plane of a shaft that it stands on [m]
  std::string shaft, to;                   // the shafts of both planes, by name, of several
  std::vector<double> speed;               // [rad/s], rising; empty: constant
  std::vector<SupportCoefficients> table;  // a row per speed
  bool cubic = false;                      // spline between the rows

  bool on_shaft() const { return carries.empty(); }
  bool between_shafts() const { return std::isfinite(to_z); }
  bool varies() const { return !speed.empty(); }
  bool has_mass() const;
  SupportCoefficients At(double speed) const;
};

/// A rigid body of the foundation.
struct Housing {
  std::string name;
  double mass_x = kRequired, mass_y = kRequired, mass_z = kRequired;  // [kg]
};

/// Mass without inertia of its own on the shaft.
struct PointMass {
  double z = kRequired;                       // [m]
  double mass_x = 0, mass_y = 0, mass_z = 0;  // [kg]
  double radial() const { return 0.5 * (mass_x + mass_y); }
  std::string name, shaft{};
};

SpringSupport IsotropicSupport(double z, double k, double c);

/// The value at x of the curve through (at, y), rising `at`, held beyond its ends.
double OnTable(const std::vector<double>& at, const std::vector<double>& y, double x, bool cubic);

}  // namespace ambrig
