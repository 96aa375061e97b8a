#pragma once
/// What holds a shaft: springs, dampers and added masses between a plane of the shaft, or a housing,
/// and the ground or another housing. With the relative displacement d = (x, y) of its two sides and
/// z along the axis, the force on the carried side is
///   -(k d + c d' + m d'')                  k, c, m of (2 x 2), and kzz, czz, mzz along the axis
/// constant, or a table over the shaft's speed: linear between its rows or a cubic spline through
/// them (not-a-knot), the end rows beyond. Housings are rigid bodies that move in x, y (and z).
/// Units SI, speeds rad/s.
#include <string>
#include <vector>

#include "core/base/parameters.h"

namespace ambrig {

struct SupportCoefficients {
  double kxx = 0, kxy = 0, kyx = 0, kyy = 0;  // [N/m]
  double cxx = 0, cxy = 0, cyx = 0, cyy = 0;  // [N s/m]
  double mxx = 0, mxy = 0, myx = 0, myy = 0;  // [kg]
  double kzz = 0, czz = 0, mzz = 0;           // along the axis
};

inline constexpr Field<SupportCoefficients> kSupportCoefficients[] = {
    {"kxx", &SupportCoefficients::kxx, "N/m", -1e15, 1e15, "stiffness"},
    {"kxy", &SupportCoefficients::kxy, "N/m", -1e15, 1e15, "stiffness, x force per y displacement"},
    {"kyx", &SupportCoefficients::kyx, "N/m", -1e15, 1e15, "stiffness, y force per x displacement"},
    {"kyy", &SupportCoefficients::kyy, "N/m", -1e15, 1e15, "stiffness"},
    {"cxx", &SupportCoefficients::cxx, "N s/m", -1e12, 1e12, "damping"},
    {"cxy", &SupportCoefficients::cxy, "N s/m", -1e12, 1e12, "damping, x force per y velocity"},
    {"cyx", &SupportCoefficients::cyx, "N s/m", -1e12, 1e12, "damping, y force per x velocity"},
    {"cyy", &SupportCoefficients::cyy, "N s/m", -1e12, 1e12, "damping"},
    {"mxx", &SupportCoefficients::mxx, "kg", -1e9, 1e9, "added mass"},
    {"mxy", &SupportCoefficients::mxy, "kg", -1e9, 1e9, "added mass, x force per y acceleration"},
    {"myx", &SupportCoefficients::myx, "kg", -1e9, 1e9, "added mass, y force per x acceleration"},
    {"myy", &SupportCoefficients::myy, "kg", -1e9, 1e9, "added mass"},
    {"kzz", &SupportCoefficients::kzz, "N/m", -1e15, 1e15, "stiffness along the axis"},
    {"czz", &SupportCoefficients::czz, "N s/m", -1e12, 1e12, "damping along the axis"},
    {"mzz", &SupportCoefficients::mzz, "kg", -1e9, 1e9, "added mass along the axis"},
};

struct SpringSupport : SupportCoefficients {
  double z = kRequired;  // plane on the shaft axis [m]; nan when it carries a housing
  std::string name;
  std::string carries;                     // a housing instead of the shaft
  std::string on;                          // the housing that it stands on, "" for the ground
  std::vector<double> speed;               // [rad/s], rising; empty: constant
  std::vector<SupportCoefficients> table;  // a row per speed
  bool cubic = false;                      // spline between the rows

  bool on_shaft() const { return carries.empty(); }
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
  std::string name;
};

SpringSupport IsotropicSupport(double z, double k, double c);

/// The value at x of the curve through (at, y), rising `at`, held beyond its ends.
double OnTable(const std::vector<double>& at, const std::vector<double>& y, double x, bool cubic);

}  // namespace ambrig
