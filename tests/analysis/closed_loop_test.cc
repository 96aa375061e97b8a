// The linear closed loop against the nonlinear rig, and against closed forms.
#include "analysis/closed_loop.h"

#include <gtest/gtest.h>

#include "analysis/closed_loop_modes.h"
#include "analysis/measured_sensitivity.h"
#include "analysis/transfer_function.h"
#include "analysis/unbalance_response.h"
#include "core/math/constants.h"
#include "rig/rig_file.h"
#include "simulation/switching/switching_engine.h"
#include "tests/cli/cli_run.h"
#include "tests/rig/exact_coils.h"
#include "tests/simulation/controlled_rig.h"

namespace ambrig {
namespace {

using Complex = std::complex<double>;

RigParameters BaseRig() { return ReadRigText(ReferenceRigText(), "rig.toml"); }

/// The base rig at a speed, with or without a delay of its loop.
struct Linearised {
  OperatingPoint point;
  ClosedLoop loop;
  explicit Linearised(const RigParameters& rig, double speed = 0)
      : point(FindOperatingPoint(rig)), loop(point, speed) {}
};

/// Readings of all axes under a step of force on one, from the recursion.
Eigen::MatrixXd LinearStep(const ClosedLoop& loop, Eigen::Index axis, double amplitude, int ticks) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(loop.states()),
                  u = Eigen::VectorXd::Zero(loop.Gamma.cols());
  u(loop.Excitation(axis)) = amplitude;
  Eigen::MatrixXd y(ticks, loop.axes());
  for (int k = 0; k < ticks; ++k) {
    y.row(k) = (loop.C * x + loop.D * u).head(loop.axes()).transpose();
    x = loop.Phi * x + loop.Gamma * u;
  }
  return y;
}

/// The same of the switching rig: with the step less without it.
Eigen::MatrixXd SwitchingStep(const RigParameters& rig, const std::string& target, double amplitude,
                              double speed, int ticks) {
  Scenario s;
  s.name = "step";
  s.noise = false;
  s.fault_tolerant = false;
  s.record_rate = rig.controller.rate;
  s.duration = (ticks - 0.5) / rig.controller.rate;
  s.speed = SpeedProfile(std::vector<std::vector<double>>{{0.0, speed}});
  const auto run = [&](double f) {
    Scenario with = s;
    Excitation e;
    e.target = target;
    e.port = "force";
    e.kind = "step";
    e.amplitude = f;
    with.excitations = {e};
    return SwitchingEngine(rig, with, {}).Run().record;
  };
  const Record a = run(amplitude), b = run(-amplitude);
  Eigen::MatrixXd y(ticks, 5);
  const char* names[] = {"A.x", "A.y", "B.x", "B.y", "z"};
  for (int c = 0; c < 5; ++c)
    for (int k = 0; k < ticks; ++k) {
      const auto row = static_cast<std::size_t>(k);
      y(k, c) = 0.5 * (a.Find(names[c])->samples[row] - b.Find(names[c])->samples[row]);
    }
  return y;
}

class StepResponse : public ::testing::TestWithParam<std::tuple<int, double>> {};

// Even part in the amplitude cancels, so what differs is of third order and the switching ripple's
// (a few per mil of the force): 1 % of the largest reading of the tested axis over 20 ms.
TEST_P(StepResponse, IsThatOfTheSwitchingRig) {
  const auto [axis, speed] = GetParam();
  const char* names[] = {"A.x", "A.y", "B.x", "B.y", "z"};
  const RigParameters rig = BaseRig();
  const Linearised l(rig, speed);
  constexpr int kTicks = 250;
  const Eigen::MatrixXd linear = LinearStep(l.loop, axis, 0.5, kTicks),
                        real = SwitchingStep(rig, names[axis], 0.5, speed, kTicks);
  const double size = linear.col(axis).cwiseAbs().maxCoeff();
  EXPECT_GT(size, 1e-7);
  EXPECT_LT((linear - real).cwiseAbs().maxCoeff(), 0.01 * size);
}

INSTANTIATE_TEST_SUITE_P(Axes, StepResponse,
                         ::testing::Values(std::tuple(0, 0.0), std::tuple(3, 400.0),
                                           std::tuple(4, 0.0)));

// The frequency response is the recursion's steady state.
TEST(ClosedLoop, ResponseIsTheSteadyStateOfTheRecursion) {
  const Linearised l(BaseRig(), 200);
  const TransferFunction transfer(l.point, l.loop);
  const double omega = 2 * kPi * 75;
  const Complex expected = transfer(omega)(l.loop.Reading(1), l.loop.Excitation(0));
  Eigen::VectorXcd x = Eigen::VectorXcd::Zero(l.loop.states()),
                   u = Eigen::VectorXcd::Zero(l.loop.Gamma.cols());
  Complex y;
  const double radius = FindModes(l.point, l.loop).spectral_radius;
  ASSERT_LT(radius, 1);
  const int kTicks = static_cast<int>(-30 / std::log(radius));  // e^-30 of the start is left
  for (int k = 0; k < kTicks; ++k) {
    const Complex phase = std::polar(1.0, omega * k * l.loop.Ts());
    u(l.loop.Excitation(0)) = phase;
    y = (l.loop.C.row(l.loop.Reading(1)) * x + l.loop.D.row(l.loop.Reading(1)) * u)(0) / phase;
    x = l.loop.Phi * x + l.loop.Gamma * u;
  }
  EXPECT_LT(std::abs(y - expected), 1e-9 * std::abs(expected) + 1e-15);
}

// Far above every critical speed a rotor turns about its centre of mass: the shaft follows e = U/m.
TEST(ClosedLoop, FastRotorTurnsAboutItsMass) {
  const RigParameters rig = BaseRig();
  const double speed = 2 * kPi * 1500;
  const Linearised l(rig, speed);
  const double u = 1e-5;
  const auto y = UnbalanceAt(l.point, l.loop, {"static", {{0, u, 0}}});
  const double e = u / rig.rotor.mass;
  // The loop still adds its stiffness over m Ω²: (4e5 + 900 Ω)·2/(4.2 Ω²) = 5 %.
  EXPECT_NEAR(std::abs(y(l.loop.Reading(0))), e, 0.06 * e);
  EXPECT_NEAR(std::arg(-y(l.loop.Reading(0))), 0, 0.1);  // opposite to the unbalance
  // Forward circle.
  EXPECT_LT(std::abs(y(l.loop.Reading(1)) + Complex(0, 1) * y(l.loop.Reading(0))), 0.01 * e);
}

// The continuous disturbance as a very short hold: against the same force held over each period by
// the excitation-free recursion there is no such input, so compare with a slow force, where the
// levitated rotor's displacement per force is that of a constant force on a rotor without
// integrator.
TEST(ClosedLoop, LoadAtTheMagnetsIsAForceCommandWhenSlow) {
  // At 5 Hz delays vanish: a load of 1 N and a commanded force of 1 N move the shaft alike up to
  // the phase of the delay, (1.5 Ts + T/2) ω = 0.4 %.
  const Linearised l(BaseRig());
  const TransferFunction transfer(l.point, l.loop);
  const double omega = 2 * kPi * 5;
  const Complex load = transfer.Harmonic({omega, transfer.LoadOn(0)})(l.loop.Reading(0));
  const Complex command = transfer(omega)(l.loop.Reading(0), l.loop.Excitation(0));
  EXPECT_LT(std::abs(load / command - 1.0), 0.02);
}

// A loop delay of whole periods acts as that many in the switching rig.
TEST(ClosedLoop, LoopDelay) {
  RigParameters rig = ReadRigText(
      ReferenceRigText() +
          "\n[[effect]]\nname = \"loop-delay\"\ntarget = \"rig\"\nparameters = { time = 6.0e-5 }\n",
      "delayed.toml");
  const Linearised l(rig);
  constexpr int kTicks = 120;
  const Eigen::MatrixXd linear = LinearStep(l.loop, 0, 0.5, kTicks),
                        real = SwitchingStep(rig, "A.x", 0.5, 0, kTicks);
  const double size = linear.col(0).cwiseAbs().maxCoeff();
  EXPECT_LT((linear - real).cwiseAbs().maxCoeff(), 0.01 * size);
}

// The witness that counts: a sine injected into the nonlinear switching rig, read back from its
// set-points. Amplitude 1 N of 60: |S| within 2 %.
class InjectedSine : public ::testing::TestWithParam<std::tuple<int, double, double>> {};

/// The sine in the nonlinear switching rig against the linear model: complex S within 2 %.
void ExpectMeasuredIsComputed(const RigParameters& rig, int axis, double frequency, double speed,
                              const std::string& what) {
  const Linearised l(rig, speed);
  const TransferFunction transfer(l.point, l.loop);
  const Complex computed =
      transfer(2 * kPi * frequency)(l.loop.Command(axis), l.loop.Excitation(axis));
  SineTest test;
  test.axis = static_cast<std::size_t>(axis);
  test.frequency = frequency;
  test.amplitude = 1;
  test.speed = speed;
  const Complex measured = MeasureSensitivity(rig, test);
  EXPECT_LT(std::abs(measured - computed), 0.02 * std::abs(computed))
      << what << ", axis " << axis << ", " << frequency << " Hz: measured " << measured
      << ", computed " << computed;
}

TEST_P(InjectedSine, ShowsTheComputedSensitivity) {
  const auto [axis, frequency, speed] = GetParam();
  ExpectMeasuredIsComputed(BaseRig(), axis, frequency, speed, "reference rig");
}

INSTANTIATE_TEST_SUITE_P(Frequencies, InjectedSine,
                         ::testing::Values(std::tuple(0, 20.0, 0.0), std::tuple(0, 60.0, 0.0),
                                           std::tuple(1, 110.0, 0.0), std::tuple(0, 200.0, 300.0),
                                           std::tuple(3, 350.0, 0.0), std::tuple(2, 700.0, 300.0),
                                           std::tuple(0, 1500.0, 0.0), std::tuple(4, 90.0, 0.0),
                                           std::tuple(4, 400.0, 0.0)));

// Whatever controls it. At 900 rad/s the unbalance control is at work.
TEST(InjectedSineWith, EveryKindOfController) {
  for (const TestedController& kind : LevitatingControllers())
    for (const double frequency : {45.0, 160.0, 600.0})
      ExpectMeasuredIsComputed(RigWith(kind.controller), 1, frequency, 900, kind.name);
}

// The flexible rig: its modes at 16.6 and 105.6 Hz ring for seconds, the measurement lasts tenths
// of one.
class InjectedSineFlexible : public ::testing::TestWithParam<std::tuple<int, double, double>> {};

TEST_P(InjectedSineFlexible, ShowsTheComputedSensitivity) {
  const auto [axis, frequency, speed] = GetParam();
  const RigParameters rig = ReadRig(AMBRIG_SOURCE_DIR "/examples/tum_mbtr/rig.toml");
  ExpectMeasuredIsComputed(WithExactCoils(rig), axis, frequency, speed, "TUM MBTR");
}

INSTANTIATE_TEST_SUITE_P(Frequencies, InjectedSineFlexible,
                         ::testing::Values(std::tuple(0, 15.0, 0.0), std::tuple(2, 20.0, 0.0),
                                           std::tuple(1, 60.0, 0.0), std::tuple(3, 104.0, 0.0),
                                           std::tuple(0, 180.0, 0.0), std::tuple(2, 400.0, 0.0),
                                           std::tuple(0, 1500.0, 0.0), std::tuple(0, 20.0, 250.0),
                                           std::tuple(3, 75.0, 250.0)));

TEST(InjectedSineWith, EveryKindOfControllerOnTheFlexibleRig) {
  const std::string text = ReadText(AMBRIG_SOURCE_DIR "/examples/tum_mbtr/rig.toml");
  const auto begin = text.find("kind = \"pid\""), end = text.find("f_max = 80.0");
  ASSERT_NE(begin, std::string::npos);
  ASSERT_NE(end, std::string::npos);
  for (const std::string kind : {"kind = \"lqg\"\n", "kind = \"h-infinity\"\n"}) {
    const RigParameters rig =
        ReadRigText(text.substr(0, begin) + kind + "rate = 12500.0\n" + text.substr(end),
                    AMBRIG_SOURCE_DIR "/examples/tum_mbtr/other.toml");
    for (const double frequency : {30.0, 90.0, 500.0})
      ExpectMeasuredIsComputed(rig, 0, frequency, 0, kind);
  }
}

TEST(ClosedLoop, ModesOfTheBaseRig) {
  const Linearised l(BaseRig(), 300);
  const ClosedLoopModes modes = FindModes(l.point, l.loop);
  EXPECT_TRUE(modes.stable());
  int rotor = 0, forward = 0, backward = 0;
  for (const ClosedLoopMode& m : modes.modes) {
    if (!m.of_rotor()) continue;
    ++rotor;
    forward += m.sense() == Whirl::kForward;
    backward += m.sense() == Whirl::kBackward;
    // Identity of the damping measures.
    EXPECT_NEAR(m.log_decrement, 2 * kPi * m.zeta / std::sqrt(1 - m.zeta * m.zeta), 1e-9);
  }
  EXPECT_GE(rotor, 4);
  EXPECT_GE(forward, 1);
  EXPECT_GE(backward, 1);
}

}  // namespace
}  // namespace ambrig
