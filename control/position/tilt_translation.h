#pragma once
/// Centralised control of a rigid body: one PID for its translation and one for its tilt in either
/// radial plane, instead of one per sensor.
///
///   reading  y_k = c + z_k theta at the sensors -> centre c [m], tilt theta [rad], least squares
///   force    F = PID(c) [N], M = PID(theta) [N m]
///   axes     sum f_k = F, sum z_k f_k = M, least norm (exact for two planes)
///   gyro     M_x += g Omega Ip theta_y',  M_y -= g Omega Ip theta_x'
///
/// g = 1 cancels the gyroscopic moment of the rotor.
///
/// theta_x = beta in the x-z plane, theta_y = -alpha in the y-z plane; z from the centre of mass.
/// The rates are those of the PIDs' derivative filters. Forces are clamped to ±f_max per axis;
/// while one is, the plane's integrals stop. Source: Schweitzer, Maslen (eds.), Magnetic Bearings,
/// 2009, chapter 8; equations of docs/theory/base_model.md section 1.
#include <array>

#include "control/position/pid.h"

namespace ambrig {

/// PID of a coordinate, without limit of its own.
struct CoordinateGains {
  double kp = kRequired, kd = kRequired, ki = kRequired;
  double derivative_time_constant = kRequired;
};

inline constexpr Field<CoordinateGains> kTranslationFields[] = {
    {"kp", &CoordinateGains::kp, "N/m", -1e12, 1e12, "on the centre of mass"},
    {"kd", &CoordinateGains::kd, "N s/m", -1e9, 1e9, "derivative gain"},
    {"ki", &CoordinateGains::ki, "N/(m s)", -1e15, 1e15, "integral gain"},
    {"derivative_time_constant", &CoordinateGains::derivative_time_constant, "s", 0, 10, "tau_d"},
};
inline constexpr Field<CoordinateGains> kTiltFields[] = {
    {"kp", &CoordinateGains::kp, "N m/rad", -1e12, 1e12, "on the tilt"},
    {"kd", &CoordinateGains::kd, "N m s/rad", -1e9, 1e9, "derivative gain"},
    {"ki", &CoordinateGains::ki, "N m/(rad s)", -1e15, 1e15, "integral gain"},
    {"derivative_time_constant", &CoordinateGains::derivative_time_constant, "s", 0, 10, "tau_d"},
};

struct TiltTranslationGeometry {
  std::vector<double> sensor_z, bearing_z;  // one per bearing, from the centre of mass [m]
  double inertia_polar = 0;                 // nominal [kg m2]
};

class TiltTranslation : public PositionController {
 public:
  /// Axes in the order bearing 1 x, y, bearing 2 x, y, ...; f_max [N] per axis.
  TiltTranslation(const CoordinateGains& translation, const CoordinateGains& tilt,
                  double gyroscopic_compensation, const TiltTranslationGeometry& geometry,
                  std::vector<double> f_max, double Ts);
  void Step(const std::vector<double>& y, const std::vector<double>& r,
            const std::vector<double>& excitation, double Omega, std::vector<double>& f) override;
  void Hold(const std::vector<double>& force, const std::vector<double>& y,
            const std::vector<double>& r) override;
  StateSpace Linear(double Omega) const override;
  void WriteC(CCode& code) const override;
  std::unique_ptr<PositionController> Clone() const override {
    return std::make_unique<TiltTranslation>(*this);
  }

 private:
  Eigen::Vector2d Coordinates(const std::vector<double>& y, std::size_t side) const;

  Eigen::Matrix2Xd sensing_;          // (c, theta) from the readings of a plane
  Eigen::MatrixX2d actuation_;        // forces of a plane from (F, M)
  std::array<PidParameters, 2> pid_;  // translation, tilt
  std::array<double, 2> filter_{};
  double gyro_, Ts_;
  std::vector<double> f_max_;
  std::array<std::array<PidState, 2>, 2> state_{};  // [plane x, y][translation, tilt]
  std::vector<double> held_;                        // forces outside the span of F and M [N]
};

}  // namespace ambrig
