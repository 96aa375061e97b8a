#pragma once
/// One PID per axis, in force units, sampled.
///
///   e = r - y;  d_k = a d_(k-1) + (1-a)(y_k - y_(k-1))/Ts,  a = exp(-Ts/tau_d)
///   f = kp e - kd d + integral + excitation, clamped to ±f_max;  integral += ki Ts e
///
/// f uses the integral before this step's increment; the increment is dropped when the raw f is
/// beyond the limit on the side that e pushes to. Source: docs/theory/base_model.md section 4.
#include <algorithm>

#include "control/position/position_controller.h"
#include "core/base/parameters.h"

namespace ambrig {

struct PidParameters {
  double kp = kRequired;
  double kd = kRequired;
  double ki = kRequired;
  double derivative_time_constant = kRequired;
  double f_max = kRequired;
};

inline constexpr Field<PidParameters> kPidFields[] = {
    {"kp", &PidParameters::kp, "N/m", -1e12, 1e12, "proportional gain per axis"},
    {"kd", &PidParameters::kd, "N s/m", -1e9, 1e9, "derivative gain, on the measurement"},
    {"ki", &PidParameters::ki, "N/(m s)", -1e15, 1e15, "integral gain"},
    {"derivative_time_constant", &PidParameters::derivative_time_constant, "s", 0, 10, "tau_d"},
    {"f_max", &PidParameters::f_max, "N", 1e-9, 1e9, "the force is clamped to ±f_max"},
};

struct PidState {
  double derivative = 0;  // [m/s]
  double last = 0;        // [m]
  double integral = 0;    // [N]
  bool started = false;   // the first reading has no predecessor: no derivative
};

/// a of the derivative's filter.
double PidFilter(const PidParameters& p, double Ts);
/// Reading -> force of one PID, r = 0; states d_(k-1), y_(k-1), integral.
StateSpace PidLinear(const PidParameters& p, double Ts);
/// One step; `a` of PidFilter. `shape` is applied to the force between the PID and the excitation
/// and may keep states of its own; what it makes of the force is what the limit sees.
template <class Shape>
double PidStep(const PidParameters& p, double Ts, double a, double y, double r, double excitation,
               PidState& s, const Shape& shape) {
  const double e = r - y;
  if (!s.started) s.last = y;
  s.started = true;
  s.derivative = a * s.derivative + (1 - a) * (y - s.last) / Ts;
  s.last = y;
  const double raw = shape(p.kp * e - p.kd * s.derivative + s.integral) + excitation;
  const bool pushes_out = (raw > p.f_max && e > 0) || (raw < -p.f_max && e < 0);
  if (!pushes_out) s.integral += p.ki * Ts * e;
  return std::clamp(raw, -p.f_max, p.f_max);
}
double PidStep(const PidParameters& p, double Ts, double a, double y, double r, double excitation,
               PidState& s);

class DecentralisedPid : public PositionController {
 public:
  DecentralisedPid(std::vector<PidParameters> axes, double Ts);
  void Step(const std::vector<double>& y, const std::vector<double>& r,
            const std::vector<double>& excitation, double Omega, std::vector<double>& f) override;
  void Hold(const std::vector<double>& force, const std::vector<double>& y,
            const std::vector<double>& r) override;
  StateSpace Linear(double Omega) const override;
  void WriteC(CCode& code) const override;
  std::unique_ptr<PositionController> Clone() const override {
    return std::make_unique<DecentralisedPid>(*this);
  }

 private:
  std::vector<PidParameters> axes_;
  std::vector<double> filter_;
  std::vector<PidState> states_;
  double Ts_;
};

}  // namespace ambrig
