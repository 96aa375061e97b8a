#include "control/position/filtered_pid.h"

namespace ambrig {

FilteredPid::FilteredPid(std::vector<FilteredPidAxis> axes, double Ts)
    : axes_(std::move(axes)), states_(axes_.size()), Ts_(Ts) {}

void FilteredPid::Step(const std::vector<double>& y, const std::vector<double>& r,
                       const std::vector<double>& excitation, double Omega,
                       std::vector<double>& f) {
  last_speed_ = Omega;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    const PidParameters p = axes_[k].pid.At(Omega);
    const auto filtered = [&filters = axes_[k].filters](double force) {
      for (Biquad& filter : filters) force = filter.Step(force);
      return force;
    };
    f[k] = PidStep(p, Ts_, PidFilter(p, Ts_), y[k], r[k], excitation[k], states_[k], filtered);
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
