// Where a rotor is past its poles and where it has fallen, by a body under one or two magnets.
#include "simulation/verdict/run_watch.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "rig/rig_file.h"
#include "simulation/simulate.h"

namespace ambrig {
namespace {

constexpr double kBodyGap = 4e-3, kGravity = 9.81;  // [m], [m/s²]

/// A body of 60 g below magnet 1; magnet 2, if there, is on the other side.
RigParameters Magnets(int coils) {
  return ReadRigText(
      fmt::format(
          "name = \"body\"\ngravity = [0.0, -{}, 0.0]\n[rotor]\nkind = \"point\"\nmass = 0.06\n"
          "[amplifier]\nmodulation = \"two-level\"\nbus_voltage = 24.0\n"
          "switching_frequency = 10000.0\nbandwidth = 500.0\nadc_samples_per_period = 18\n"
          "adc_bits = 12\nadc_range = 8.0\ncurrent_noise = 0.001\ni_max = 3.0\n[controller]\n"
          "kind = \"pid\"\nrate = 5000.0\nkp = 2000.0\nkd = 10.0\nki = 8.0e4\n"
          "derivative_time_constant = 2.0e-4\nf_max = 5.0\nbias_current = 1.0\n[bearings.M]\n"
          "kind = \"opposed\"\ncoils = {}\nangle_deg = 90.0\ngap = {}\ninductance_far = 0.02\n"
          "inductance_near = 0.03\ngap_constant = 0.006\nresistance = 2.0\n"
          "sensor = {{ noise = 1e-6 }}\n",
          kGravity, coils, kBodyGap),
      "rig.toml");
}

/// Of 0.15 s, the fault at 0.05 s.
RunResult RunWith(int coils, const std::string& kind) {
  const RigParameters rig = Magnets(coils);
  return Simulate(rig,
                  ReadScenarioText("duration = 0.15\nfault_tolerance = false\nnoise = false\n"
                                   "[[fault]]\ntime = 0.05\ntarget = \"M.coil1\"\nkind = \"" +
                                       kind + "\"\n",
                                   "scenario.toml", rig),
                  {});
}

long Count(const RunResult& r, const std::string& kind) {
  return std::ranges::count(r.events, kind, &RunEvent::kind);
}

// Nothing stands on that side: the model holds, and the body falls as bodies do.
TEST(RunWatch, ABodyThatLosesItsOnlyMagnetFallsFreely) {
  const RunResult r = RunWith(1, "open");
  EXPECT_EQ(Count(r, "model_invalid"), 0);
  EXPECT_TRUE(r.notes.empty());
  EXPECT_TRUE(r.drop);
  ASSERT_EQ(Count(r, "drop"), 1);
  const double fallen = 0.5 * kGravity * 0.1 * 0.1;  // [m]
  EXPECT_NEAR(r.metrics.max_orbit.at("M"), fallen, 0.01 * fallen);
  EXPECT_NEAR(r.metrics.settled_orbit, fallen, 0.01 * fallen);
  const auto drop = std::ranges::find(r.events, "drop", &RunEvent::kind);
  EXPECT_NEAR(drop->t, 0.05 + std::sqrt(2 * kBodyGap / kGravity), 1e-3);
}

TEST(RunWatch, ABodyPulledIntoItsOnlyMagnetIsPastThePoles) {
  const RunResult r = RunWith(1, "switch-stuck-on");
  EXPECT_EQ(Count(r, "model_invalid"), 1);
  EXPECT_TRUE(r.drop);
  EXPECT_DOUBLE_EQ(r.metrics.max_orbit.at("M"), kBodyGap);
}

// The same fall ends in the other magnet.
TEST(RunWatch, BetweenTwoMagnetsBothSidesArePoles) {
  const RunResult r = RunWith(2, "open");
  EXPECT_EQ(Count(r, "model_invalid"), 1);
  EXPECT_TRUE(r.drop);
  EXPECT_DOUBLE_EQ(r.metrics.max_orbit.at("M"), kBodyGap);
}

TEST(RunWatch, AHealthyBodyHovers) {
  const RigParameters rig = Magnets(1);
  const RunResult r =
      Simulate(rig,
               ReadScenarioText("duration = 0.1\nfault_tolerance = false\nnoise = false\n",
                                "scenario.toml", rig),
               {});
  EXPECT_TRUE(r.events.empty());
  EXPECT_FALSE(r.drop);
  EXPECT_LT(r.metrics.max_orbit.at("M"), 0.05 * kBodyGap);
}

}  // namespace
}  // namespace ambrig
