/// kind = "state-feedback": gains on the position and velocity of an observer, for each axis
///
///   m x'' = k_s x + f,  f as commanded one period ago        (model of the axis, sampled exactly)
///   s+ = A s + B f_1 + L (y - s_1),  f = -K s+ + integral    s = (x, v) estimated, f_1 the last f
///   integral+ = integral - ki Ts y
///
/// s+ is the state when f acts, so that the delay costs nothing but the prediction:
/// with ki = 0 the poles of the loop are those of A - B K, those of the observer
/// (bandwidth `observer`, damping `observer_damping`) and 0. The integral, which carries static
/// forces, is not told to the observer.
#include <cmath>

#include "control/interface/controller_kind.h"
#include "control/kinds/state_feedback.h"
#include "control/position/state_space_controller.h"
#include "core/math/constants.h"

namespace ambrig {

namespace {

struct StateFeedbackSettings : ControllerSettings {
  StateFeedbackGains gains;
};

void ReadStateFeedback(const TomlTable& t, const ControllerNames&, ControllerParameters& c) {
  auto settings = std::make_shared<StateFeedbackSettings>();
  t.Read(settings->gains, kStateFeedbackFields);
  c.own = std::move(settings);
}

std::unique_ptr<PositionController> MakeStateFeedback(const ControllerParameters& c,
                                                      const ControllerSite& site) {
  const auto& gains = dynamic_cast<const StateFeedbackSettings&>(*c.own).gains;
  const std::vector<StateSpace> axes(site.axes.size(), StateFeedbackSystem(gains, site.period));
  return std::make_unique<StateSpaceController>(std::vector<double>{0},
                                                std::vector<StateSpace>{Append(axes)}, site.f_max);
}

void DocumentStateFeedback(std::vector<ParameterRow>& rows) {
  AddRows(rows, "[controller] kind = \"state-feedback\"", kStateFeedbackFields);
}

}  // namespace

SampledAxis SampleAxis(double mass, double stiffness, double Ts) {
  SampledAxis s;
  const double a = std::sqrt(std::abs(stiffness) / mass) * Ts;
  const bool unstable = stiffness > 0;
  const double c = a == 0 ? 1 : unstable ? std::cosh(a) : std::cos(a);
  const double sinc = a == 0 ? 1 : (unstable ? std::sinh(a) : std::sin(a)) / a;
  // (c - 1)/k_s without its cancellation at k_s = 0
  const double half = a == 0 ? 1 : (unstable ? std::sinh(a / 2) : std::sin(a / 2)) / (a / 2);
  s.A << c, Ts * sinc, stiffness / mass * Ts * sinc, c;
  s.B << 0.5 * Ts * Ts / mass * half * half, Ts / mass * sinc;
  return s;
}

Eigen::Vector2d ObserverGain(const SampledAxis& s, double frequency, double damping, double Ts) {
  const double omega = 2 * kPi * frequency;
  const std::complex<double> pole = std::exp(
      Ts * omega * std::complex<double>(-damping, std::sqrt(std::max(0.0, 1 - damping * damping))));
  const double sum = 2 * pole.real(), product = std::norm(pole);
  const double first = s.A.trace() - sum;
  return {first, s.A(1, 0) + (product - (s.A(0, 0) - first) * s.A(1, 1)) / s.A(0, 1)};
}

StateSpace StateFeedbackSystem(const StateFeedbackGains& g, double Ts) {
  const SampledAxis model = SampleAxis(g.mass, g.negative_stiffness, Ts);
  const Eigen::Vector2d L = ObserverGain(model, g.observer, g.observer_damping, Ts);
  const Eigen::RowVector2d K(g.kp, g.kd);
  Eigen::Matrix2d estimate = model.A;
  estimate.col(0) -= L;
  // States: estimate, last feedback, integral; input e = -y.
  StateSpace s;
  s.A = Eigen::MatrixXd::Zero(4, 4);
  s.A.block<2, 2>(0, 0) = estimate;
  s.A.block<2, 1>(0, 2) = model.B;
  s.A.block<1, 2>(2, 0) = -K * estimate;
  s.A(2, 2) = -K * model.B;
  s.A(3, 3) = 1;
  s.B = Eigen::MatrixXd::Zero(4, 1);
  s.B.topRows(2) = -L;
  s.B(2, 0) = K * L;
  s.B(3, 0) = g.ki * Ts;
  s.C = s.A.row(2);
  s.C(0, 3) = 1;
  s.D = s.B.row(2);
  return s;
}

const ControllerKind& StateFeedbackKind() {
  static constexpr ControllerKind kind{
      .name = "state-feedback",
      .doc = "gains on the states of an observer, for each axis",
      .read = ReadStateFeedback,
      .make = MakeStateFeedback,
      .document = DocumentStateFeedback,
  };
  return kind;
}

}  // namespace ambrig
