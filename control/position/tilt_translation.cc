#include "control/position/tilt_translation.h"

#include <algorithm>

#include "core/math/linear_equations.h"

namespace ambrig {

namespace {

PidParameters Unlimited(const CoordinateGains& g) {
  return {g.kp, g.kd, g.ki, g.derivative_time_constant, kInfinity};
}

Eigen::MatrixX2d Arms(const std::vector<double>& z) {
  Eigen::MatrixX2d arms(static_cast<Eigen::Index>(z.size()), 2);
  for (std::size_t k = 0; k < z.size(); ++k) arms.row(static_cast<Eigen::Index>(k)) << 1, z[k];
  return arms;
}

}  // namespace

TiltTranslation::TiltTranslation(const CoordinateGains& translation, const CoordinateGains& tilt,
                                 double gyroscopic_compensation,
                                 const TiltTranslationGeometry& geometry, std::vector<double> f_max,
                                 double Ts)
    : pid_{Unlimited(translation), Unlimited(tilt)},
      filter_{PidFilter(pid_[0], Ts), PidFilter(pid_[1], Ts)},
      gyro_(gyroscopic_compensation * geometry.inertia_polar),
      Ts_(Ts),
      f_max_(std::move(f_max)),
      held_(f_max_.size(), 0.0) {
  Require(geometry.sensor_z.size() >= 2 && f_max_.size() == 2 * geometry.sensor_z.size(),
          "two radial bearings or more");
  sensing_ = PseudoinverseOf(Arms(geometry.sensor_z));
  actuation_ = PseudoinverseOf(Arms(geometry.bearing_z).transpose());
}

Eigen::Vector2d TiltTranslation::Coordinates(const std::vector<double>& y, std::size_t side) const {
  Eigen::Vector2d c = Eigen::Vector2d::Zero();
  for (Eigen::Index k = 0; k < sensing_.cols(); ++k)
    c += sensing_.col(k) * y[2 * static_cast<std::size_t>(k) + side];
  return c;
}

void TiltTranslation::Step(const std::vector<double>& y, const std::vector<double>& r,
                           const std::vector<double>& excitation, double Omega,
                           std::vector<double>& f) {
  const auto before = state_;
  Eigen::Matrix2d wanted;  // column per plane
  for (std::size_t side = 0; side < 2; ++side) {
    const Eigen::Vector2d c = Coordinates(y, side), target = Coordinates(r, side);
    for (std::size_t q = 0; q < 2; ++q)
      wanted(static_cast<Eigen::Index>(q), static_cast<Eigen::Index>(side)) =
          PidStep(pid_[q], Ts_, filter_[q], c[static_cast<Eigen::Index>(q)],
                  target[static_cast<Eigen::Index>(q)], 0, state_[side][q]);
  }
  wanted(1, 0) += gyro_ * Omega * state_[1][1].derivative;
  wanted(1, 1) -= gyro_ * Omega * state_[0][1].derivative;
  for (std::size_t side = 0; side < 2; ++side) {
    const Eigen::VectorXd plane = actuation_ * wanted.col(static_cast<Eigen::Index>(side));
    bool clamped = false;
    for (Eigen::Index k = 0; k < plane.size(); ++k) {
      const std::size_t axis = 2 * static_cast<std::size_t>(k) + side;
      const double raw = plane[k] + held_[axis] + excitation[axis];
      f[axis] = std::clamp(raw, -f_max_[axis], f_max_[axis]);
      clamped = clamped || f[axis] != raw;
    }
    if (clamped)
      for (std::size_t q = 0; q < 2; ++q) state_[side][q].integral = before[side][q].integral;
  }
}

void TiltTranslation::Hold(const std::vector<double>& force, const std::vector<double>& y,
                           const std::vector<double>& r) {
  const Eigen::Matrix2Xd total = PseudoinverseOf(actuation_);
  for (std::size_t side = 0; side < 2; ++side) {
    Eigen::VectorXd plane(actuation_.rows());
    for (Eigen::Index k = 0; k < plane.size(); ++k)
      plane[k] = force[2 * static_cast<std::size_t>(k) + side];
    const Eigen::Vector2d wanted = total * plane, c = Coordinates(y, side),
                          target = Coordinates(r, side);
    const Eigen::VectorXd rest = plane - actuation_ * wanted;
    for (Eigen::Index k = 0; k < plane.size(); ++k)
      held_[2 * static_cast<std::size_t>(k) + side] = rest[k];
    for (std::size_t q = 0; q < 2; ++q) {
      const auto at = static_cast<Eigen::Index>(q);
      PidState& s = state_[side][q];
      s = PidState{};
      s.integral = wanted[at] - pid_[q].kp * (target[at] - c[at]);
      s.last = c[at];
      s.started = true;
    }
  }
}

StateSpace TiltTranslation::Linear(double Omega) const {
  // In coordinates (c_x, c_y, theta_x, theta_y): four PIDs, and the cross moments of the filtered
  // rates.
  StateSpace k = Append({PidLinear(pid_[0], Ts_), PidLinear(pid_[0], Ts_), PidLinear(pid_[1], Ts_),
                         PidLinear(pid_[1], Ts_)});
  const double a = filter_[1], b = (1 - a) / Ts_, g = gyro_ * Omega;
  // d_k = a d_(k-1) + b (theta - last): row of the other plane's tilt PID, states 6..8 and 9..11.
  const auto add = [&](Eigen::Index out, Eigen::Index in, double gain) {
    k.C(out, 3 * in) += gain * a;
    k.C(out, 3 * in + 1) -= gain * b;
    k.D(out, in) += gain * b;
  };
  add(2, 3, g);
  add(3, 2, -g);
  const Eigen::Index bearings = sensing_.cols();
  Eigen::MatrixXd in = Eigen::MatrixXd::Zero(4, 2 * bearings),
                  out = Eigen::MatrixXd::Zero(2 * bearings, 4);
  for (Eigen::Index j = 0; j < bearings; ++j)
    for (Eigen::Index side = 0; side < 2; ++side)
      for (Eigen::Index q = 0; q < 2; ++q) {
        in(2 * q + side, 2 * j + side) = sensing_(q, j);
        out(2 * j + side, 2 * q + side) = actuation_(j, q);
      }
  return Series(Series(StateSpace::Gain(in), k), StateSpace::Gain(out));
}

}  // namespace ambrig
