#include "control/position/pid.h"

#include <cmath>

namespace ambrig {

double PidFilter(const PidParameters& p, double Ts) {
  return p.derivative_time_constant > 0 ? std::exp(-Ts / p.derivative_time_constant) : 0;
}

StateSpace PidLinear(const PidParameters& p, double Ts) {
  const double a = PidFilter(p, Ts), b = (1 - a) / Ts;
  StateSpace s;
  s.A.resize(3, 3);
  s.A << a, -b, 0, 0, 0, 0, 0, 0, 1;
  s.B.resize(3, 1);
  s.B << b, 1, -p.ki * Ts;
  s.C.resize(1, 3);
  s.C << -p.kd * a, p.kd * b, 1;
  s.D = Eigen::MatrixXd::Constant(1, 1, -p.kp - p.kd * b);
  return s;
}

double PidStep(const PidParameters& p, double Ts, double a, double y, double r, double excitation,
               PidState& s) {
  return PidStep(p, Ts, a, y, r, excitation, s, [](double force) { return force; });
}

DecentralisedPid::DecentralisedPid(std::vector<PidParameters> axes, double Ts)
    : axes_(std::move(axes)), states_(axes_.size()), Ts_(Ts) {
  for (const PidParameters& p : axes_) filter_.push_back(PidFilter(p, Ts));
}

void DecentralisedPid::Step(const std::vector<double>& y, const std::vector<double>& r,
                            const std::vector<double>& excitation, double, std::vector<double>& f) {
  for (std::size_t k = 0; k < axes_.size(); ++k)
    f[k] = PidStep(axes_[k], Ts_, filter_[k], y[k], r[k], excitation[k], states_[k]);
}

void DecentralisedPid::Hold(const std::vector<double>& force, const std::vector<double>& y,
                            const std::vector<double>& r) {
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    states_[k] = PidState{};
    states_[k].integral = force[k] - axes_[k].kp * (r[k] - y[k]);
    states_[k].last = y[k];
    states_[k].started = true;
  }
}

StateSpace DecentralisedPid::Linear(double) const {
  std::vector<StateSpace> parts;
  for (const PidParameters& p : axes_) parts.push_back(PidLinear(p, Ts_));
  return Append(parts);
}

}  // namespace ambrig
