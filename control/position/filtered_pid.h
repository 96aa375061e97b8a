#pragma once
/// One PID per axis with filters behind it and gains that may follow the speed:
///
///   f = F_n(z) ... F_1(z) (kp e - kd d + integral) + excitation, clamped to ±f_max
///
/// with the PID of control/position/pid.h (its increment is dropped when this raw f is beyond the
/// limit on the side that e pushes to). Without filters and schedule it is that PID. Source:
/// docs/theory/base_model.md section 4.
#include "control/position/filter.h"
#include "control/position/gain_schedule.h"

namespace ambrig {

struct FilteredPidAxis {
  PidSchedule pid;
  std::vector<Biquad> filters;
};

class FilteredPid : public PositionController {
 public:
  FilteredPid(std::vector<FilteredPidAxis> axes, double Ts);
  void Step(const std::vector<double>& y, const std::vector<double>& r,
            const std::vector<double>& excitation, double Omega, std::vector<double>& f) override;
  void Hold(const std::vector<double>& force, const std::vector<double>& y,
            const std::vector<double>& r) override;
  StateSpace Linear(double Omega) const override;
  void WriteC(CCode& code) const override;
  std::unique_ptr<PositionController> Clone() const override {
    return std::make_unique<FilteredPid>(*this);
  }

 private:
  std::vector<FilteredPidAxis> axes_;
  std::vector<PidState> states_;
  double Ts_;
  double last_speed_ = 0;  // of Step: what Hold reckons with [rad/s]
};

}  // namespace ambrig
