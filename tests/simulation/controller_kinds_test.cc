// Kinds of controllers in runs: duties without a current loop, state feedback, feedback linearisation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/read_file.h"
#include "rig/rig_figures.h"
#include "rig/rig_file.h"
#include "simulation/simulate.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

/// [controller] of the text up to the next table, without what is shared.
std::string WithController(std::string text, const std::string& keys) {
  const std::size_t at = text.find("[controller]");
  const std::size_t end = text.find("\n[", at + 1);
  return text.replace(at, end - at, "[controller]\n" + keys);
}

RunResult Hover(const std::string& text, const std::string& more = "") {
  const RigParameters rig = ReadRigText(text, "rig.toml");
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

// Two fifths of the clearance away from the centre the step response is that of a linear loop: half of the step gives
// half of the way at every instant, which the bias-current map does not do.
TEST(ControllerKinds, FeedbackLinearisationIsLinearFarFromTheCentre) {
  const auto unequal = [](const char* kind) {
    const std::string rig = WithController(
        kSixPoles, std::string("kind = \"") + kind +
                       "\"\nkp = 2.0e5\nkd = 300.0\nki = 0.0\nderivative_time_constant = 1.0e-4\n" +
                       kShared);
    const std::string weightless = Replaced(rig, "[0.0, -9.81, 0.0]", "[0.0, 0.0, 0.0]");
    const std::string half = Replaced(kPush, "6.0e-5", "3.0e-5");
    const RunResult a = Hover(weightless, kPush), b = Hover(weightless, half);
    const auto &x = a.record.Find("A.r.x")->samples, &y = b.record.Find("A.r.x")->samples;
    double error = 0, most = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
      error = std::max(error, std::abs(x[k] - 2 * y[k]));
      most = std::max(most, std::abs(x[k]));
    }
    return error / most;
  };
  const double linearised = unequal("feedback-linearisation");
  EXPECT_LT(linearised, 0.02);
  EXPECT_GT(unequal("pid"), 5 * linearised);
}

/// Gains in duties, and the same in forces: N = k c0 2 U/kp.
TEST(ControllerKinds, DutyPidIsAPidInItsUnits) {
  std::string rig = Replaced(kSixPoles, "bandwidth = 1200.0", "mode = \"voltage\"\nkp = 1.0");
  const RigParameters p = ReadRigText(rig, "rig.toml");
  const double n = ForceConstant(p.bearings[0]) * 1.5 * 2 * 30 / 1.0;
  const auto with = [&](const std::string& kind, double scale) {
    return Hover(
        WithController(rig, fmt::format("kind = \"{}\"\nkp = {:.17g}\nkd = {:.17g}\nki = {:.17g}\n"
                                        "derivative_time_constant = 1.0e-4\n{}",
                                        kind, 4e5 * scale, 900 * scale, 1e6 * scale, kShared)));
  };
  const RunResult duty = with("duty-pid", 1 / n), force = with("pid", 1);
  const auto &a = duty.record.Find("A.d2")->samples, &b = force.record.Find("A.d2")->samples;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-9) << k;
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
