// Kinds of controllers in runs: duties without a current loop, state feedback, feedback
// linearisation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/read_file.h"
#include "rig/rig_figures.h"
#include "rig/rig_file.h"
#include "simulation/simulate.h"
#include "tests/cli/cli_run.h"
#include "tests/rig/exact_coils.h"

namespace ambrig {
namespace {

/// [controller] of the text up to the next table, without what is shared.
std::string WithController(std::string text, const std::string& keys) {
  const std::size_t at = text.find("[controller]");
  const std::size_t end = text.find("\n[", at + 1);
  return text.replace(at, end - at, "[controller]\n" + keys);
}

RunResult Hover(const std::string& text, const std::string& more = "") {
  const RigParameters rig = WithExactCoils(ReadRigText(text, "rig.toml"));
  return Simulate(rig,
                  ReadScenarioText("rig = \"rig.toml\"\nduration = 0.2\nrecord_rate = 12500.0\n"
                                   "noise = false\nfault_tolerance = false\n" +
                                       more,
                                   "scenario.toml", rig),
                  {});
}

double Largest(const RunResult& r, const std::string& channel) {
  double largest = 0;
  for (const double v : r.record.Find(channel)->samples) largest = std::max(largest, std::abs(v));
  return largest;
}

const std::string kSixPoles = ReadFile(AMBRIG_SOURCE_DIR "/examples/stators/six_poles.toml");
constexpr const char* kShared = "rate = 12500.0\nbias_current = 1.5\nf_max = 25.0\n";
constexpr const char* kPush =
    "[[excitation]]\ntarget = \"A.x\"\nport = \"reference\"\nkind = \"step\"\namplitude = 6.0e-5\n"
    "start = 0.05\nstop = 0.2\n";

TEST(ControllerKinds, StateFeedbackHovers) {
  const RunResult r = Hover(WithController(
      kSixPoles, std::string("kind = \"state-feedback\"\nkp = 3.4e5\nkd = 450.0\nki = 3.0e6\n"
                             "mass = 0.4\nnegative_stiffness = 1.13e5\nobserver = 600.0\n") +
                     kShared));
  EXPECT_FALSE(r.touchdown);
  EXPECT_LT(Largest(r, "A.r.y"), 5e-6);
}

/// Six poles without weight under a PID of either kind. The reference moves both journals to
/// `reference`, then a force of 0.4 N in the middle comes and goes; the sensors stand at `sensors`
/// from the middle, the magnets at 60 mm.
struct Pushed {
  double place = 0, yield = 0;  // [m]
};
Pushed PushAt(const char* kind, double reference, double sensors = 0.070) {
  std::string rig = WithController(
      kSixPoles, std::string("kind = \"") + kind +
                     "\"\nkp = 2.0e5\nkd = 300.0\nki = 0.0\nderivative_time_constant = 1.0e-4\n" +
                     kShared);
  rig = Replaced(rig, "[0.0, -9.81, 0.0]", "[0.0, 0.0, 0.0]");
  rig = Replaced(rig, "z = -0.070", fmt::format("z = {}", -sensors));
  rig = Replaced(rig, "z = 0.070", fmt::format("z = {}", sensors));
  std::string more;
  for (const char* axis : {"A.x", "B.x"})
    more += fmt::format(
        "[[excitation]]\ntarget = \"{}\"\nport = \"reference\"\nkind = \"step\"\namplitude = {}\n"
        "start = 0.02\nstop = 0.2\n",
        axis, reference);
  more += "[[load]]\nforce = [0.4, 0.0]\nz = 0.0\nstart = 0.1\nstop = 0.2\n";
  const RunResult r = Hover(rig, more);
  const auto& x = r.record.Find("A.r.x")->samples;
  const double before = x[static_cast<std::size_t>(0.0995 * 12500)];
  return {before, x.back() - before};
}

// A force yields F/(2 kp) wherever the rotor is, as in a linear loop. With the bias-current map the
// gain of the magnets grows off the centre: at a third of the gap, with bias and control currents
// of no force together, by sum c²/(1 - u c)/3 = 1.09 over the poles' cosines c.
TEST(ControllerKinds, FeedbackLinearisationIsLinearFarFromTheCentre) {
  const double stiff = 0.4 / (2 * 2.0e5);
  for (const double reference : {0.0, 5.0e-5, 1.0e-4}) {
    const Pushed p = PushAt("feedback-linearisation", reference);
    EXPECT_NEAR(p.place, reference, 0.005 * reference + 1e-9);
    EXPECT_NEAR(p.yield, stiff, 0.005 * stiff) << reference;
  }
  const Pushed centre = PushAt("pid", 0), away = PushAt("pid", 4.3e-5);
  EXPECT_NEAR(away.place, 1e-4, 1e-5);
  EXPECT_GT(centre.yield, 2 * stiff);  // kp less the negative stiffness of 1.13e5 N/m
  EXPECT_GT(centre.yield / away.yield, 1.05);
}

// One reference alone tilts the rotor: what the sensors read is not where the magnets are, and the
// force is still the one asked for.
TEST(ControllerKinds, FeedbackLinearisationKnowsWhereItsSensorsStand) {
  const std::string rig = Replaced(
      WithController(kSixPoles,
                     std::string("kind = \"feedback-linearisation\"\nkp = 2.0e5\nkd = 300.0\nki = "
                                 "0.0\nderivative_time_constant = 1.0e-4\n") +
                         kShared),
      "[0.0, -9.81, 0.0]", "[0.0, 0.0, 0.0]");
  const RunResult r = Hover(rig, kPush);
  // No force at rest, so both sensors read their references; the magnet stands at 130/140 of the
  // way.
  EXPECT_NEAR(r.record.Find("A.x")->samples.back(), 6e-5, 3e-7);
  EXPECT_NEAR(r.record.Find("B.x")->samples.back(), 0, 3e-7);
  EXPECT_NEAR(r.record.Find("A.r.x")->samples.back(), 6e-5 * 130 / 140, 3e-7);
}

/// Gains in duties, and the same in forces: N = k c0 2 U/kp. The loop is one that `ambrig analyze`
/// finds stable at all speeds: in a loop that is not, the clamped force makes a limit cycle, which
/// amplifies the rounding of N.
TEST(ControllerKinds, DutyPidIsAPidInItsUnits) {
  std::string rig = Replaced(kSixPoles, "bandwidth = 1200.0", "mode = \"voltage\"\nkp = 1.0");
  const RigParameters p = ReadRigText(rig, "rig.toml");
  const double n = ForceConstant(p.bearings[0]) * 1.5 * 2 * 30 / 1.0;
  const auto with = [&](const std::string& kind, double scale) {
    return Hover(
        WithController(rig, fmt::format("kind = \"{}\"\nkp = {:.17g}\nkd = {:.17g}\nki = {:.17g}\n"
                                        "derivative_time_constant = 1.0e-4\n{}",
                                        kind, 1.6e5 * scale, 400 * scale, 2e5 * scale,
                                        Replaced(kShared, "25.0", "60.0"))),
        Replaced(kPush, "6.0e-5", "1.0e-5"));
  };
  const RunResult duty = with("duty-pid", 1 / n), force = with("pid", 1);
  const auto &a = duty.record.Find("A.d1")->samples, &b = force.record.Find("A.d1")->samples;
  ASSERT_EQ(a.size(), b.size());
  double most = 0, moved = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    most = std::max(most, std::abs(a[k] - b[k]));
    moved = std::max(moved, std::abs(a[k] - a.front()));
  }
  EXPECT_LT(most, 1e-12);
  EXPECT_GT(moved, 1e-4);  // it is not at rest
  EXPECT_FALSE(duty.touchdown);
  EXPECT_LT(Largest(duty, "A.r.y"), 1e-5);
}

// Without [controller]: steps of current into a held rotor; a free one is refused.
TEST(ControllerKinds, AHeldRotorNeedsNoController) {
  std::string text = WithController(kSixPoles, "");
  text.erase(text.find("[controller]\n"), 13);
  const RunResult held = Hover(
      text,
      "[start]\nstate = \"clamped\"\n[[excitation]]\ntarget = \"A.coil1\"\nport = \"current\"\n"
      "kind = \"step\"\namplitude = 1.0\nstart = 0.05\nstop = 0.2\n");
  EXPECT_NEAR(held.record.Find("A.i1")->samples.back(), 1, 1e-3);
  try {
    Hover(text);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_STREQ(
        e.what(),
        "scenario.toml: the rotor is free, but rig.toml has no [controller], allowed: one, "
        "or [start] state = \"clamped\"");
  }
}

TEST(ControllerKinds, DutyPidNeedsAmplifiersInVoltageMode) {
  const std::string rig =
      WithController(kSixPoles, std::string("kind = \"duty-pid\"\nkp = 1e4\nkd = 20.0\nki = 0.0\n"
                                            "derivative_time_constant = 1e-4\n") +
                                    kShared);
  try {
    Hover(rig);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("allowed: [amplifier] mode = \"voltage\""),
              std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace ambrig
