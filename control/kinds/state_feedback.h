#pragma once
/// One axis with state feedback from an observer; equations in state_feedback_kind.cc.
#include <complex>

#include "control/linear/state_space.h"
#include "core/base/parameters.h"

namespace ambrig {

struct StateFeedbackGains {
  double kp = kRequired, kd = kRequired, ki = 0;
  double mass = kRequired, negative_stiffness = kRequired;
  double observer = kRequired, observer_damping = 0.8;
};

inline constexpr Field<StateFeedbackGains> kStateFeedbackFields[] = {
    {"kp", &StateFeedbackGains::kp, "N/m", -1e12, 1e12, "of the estimated position"},
    {"kd", &StateFeedbackGains::kd, "N s/m", -1e9, 1e9, "of the estimated velocity"},
    {"ki", &StateFeedbackGains::ki, "N/(m s)", -1e15, 1e15, "integral gain"},
    {"mass", &StateFeedbackGains::mass, "kg", 1e-9, 1e9, "that an axis moves, in the model"},
    {"negative_stiffness", &StateFeedbackGains::negative_stiffness, "N/m", -1e12, 1e12,
     "k_s of an axis, in the model"},
    {"observer", &StateFeedbackGains::observer, "Hz", 1e-3, 1e6, "frequency of its poles"},
    {"observer_damping", &StateFeedbackGains::observer_damping, "-", 0.05, 1, "of its poles"},
};

/// m x'' = k_s x + f with f constant over a period Ts [s]: (x, v)+ = A (x, v) + B f.
struct SampledAxis {
  Eigen::Matrix2d A;
  Eigen::Vector2d B;
};
SampledAxis SampleAxis(double mass, double stiffness, double Ts);
/// L that gives A - L [1, 0] the poles of this frequency [Hz] and damping.
Eigen::Vector2d ObserverGain(const SampledAxis& axis, double frequency, double damping, double Ts);
/// Error e = r - y [m] -> force [N].
StateSpace StateFeedbackSystem(const StateFeedbackGains& gains, double Ts);

}  // namespace ambrig
