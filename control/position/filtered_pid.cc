#include "control/position/filtered_pid.h"

#include <algorithm>

namespace ambrig {

FilteredPid::FilteredPid(std::vector<FilteredPidAxis> axes, double Ts)
    : axes_(std::move(axes)), states_(axes_.size()), Ts_(Ts) {}

void FilteredPid::Step(const std::vector<double>& y, const std::vector<double>& r,
                       const std::vector<double>& excitation, double Omega,
                       std::vector<double>& f) {
  last_speed_ = Omega;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    const PidParameters p = axes_[k].pid.At(Omega);
    PidState& s = states_[k];
    const double a = PidFilter(p, Ts_), e = r[k] - y[k];
    if (!s.started) s.last = y[k];
    s.started = true;
    s.derivative = a * s.derivative + (1 - a) * (y[k] - s.last) / Ts_;
    s.last = y[k];
    double raw = p.kp * e - p.kd * s.derivative + s.integral;
    for (Biquad& filter : axes_[k].filters) raw = filter.Step(raw);
    raw += excitation[k];
    const bool pushes_out = (raw > p.f_max && e > 0) || (raw < -p.f_max && e < 0);
    if (!pushes_out) s.integral += p.ki * Ts_ * e;
    f[k] = std::clamp(raw, -p.f_max, p.f_max);
  }
}

void FilteredPid::Hold(const std::vector<double>& force, const std::vector<double>& y,
                       const std::vector<double>& r) {
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    states_[k] = PidState{};
    states_[k].integral = force[k] - axes_[k].pid.At(last_speed_).kp * (r[k] - y[k]);
    states_[k].last = y[k];
    states_[k].started = true;
    for (Biquad& filter : axes_[k].filters) filter.Hold(force[k]);
  }
}

StateSpace FilteredPid::Linear(double Omega) const {
  std::vector<StateSpace> parts;
  for (const FilteredPidAxis& axis : axes_) {
    StateSpace s = PidLinear(axis.pid.At(Omega), Ts_);
    for (const Biquad& filter : axis.filters) s = Series(s, filter.Linear());
    parts.push_back(s);
  }
  return Append(parts);
}

}  // namespace ambrig
