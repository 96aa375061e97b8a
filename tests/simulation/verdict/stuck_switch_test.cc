// What a stuck switch leaves to the other coils, against the closed form of two opposed magnets.
#include "simulation/verdict/stuck_switch.h"

#include <gmock/gmock.h>

#include <string>

#include "rig/rig_file.h"
#include "simulation/simulate.h"

namespace ambrig {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr double kGap = 4e-3, kConstant = 6e-3, kMost = 3;  // [m], [m], [A]

/// Two magnets on a horizontal axis, so that no weight helps; nothing limits the stop but half of
/// the gap.
RigParameters TwoMagnets(double resistance) {
  return ReadRigText(
      "name = \"pair\"\ngravity = [0.0, 0.0, 0.0]\n[rotor]\nkind = \"point\"\nmass = "
      "0.06\n[amplifier]\n"
      "modulation = \"two-level\"\nbus_voltage = 24.2\nswitch_drop = 0.1\ndiode_drop = 0.6\n"
      "switching_frequency = 10000.0\nbandwidth = 500.0\nadc_samples_per_period = 18\nadc_bits = "
      "12\n"
      "adc_range = 8.0\ncurrent_noise = 0.001\ni_max = 3.0\n[controller]\nkind = \"pid\"\nrate = "
      "5000.0\n"
      "kp = 2000.0\nkd = 5.0\nki = 1000.0\nderivative_time_constant = 1.0e-3\nf_max = 5.0\n"
      "bias_current = 1.0\n[bearings.M]\nkind = \"opposed\"\ncoils = 2\nangle_deg = 0.0\ngap = "
      "0.004\n"
      "inductance_far = 0.02\ninductance_near = 0.03\ngap_constant = 0.006\nsensor = { noise = "
      "1e-6 }\n"
      "resistance = " +
          std::to_string(resistance) + "\n",
      "rig.toml");
}

// f = i² L_0/(2 g_c (1 + g/g_c)²) of each magnet: at the far side, half a gap away, the stuck one
// is held up to i_max (g_c + 3/2 gap)/(g_c + 1/2 gap), centred up to i_max.
TEST(StuckSwitch, TwoMagnetsByTheirClosedForm) {
  for (const int coil : {0, 1}) {
    const StuckSwitchLimit limit = LimitOfStuckSwitch(TwoMagnets(2), 0, coil);
    EXPECT_DOUBLE_EQ(limit.end, 12);  // (24.2 - 0.2) V over 2 ohm
    EXPECT_NEAR(limit.centred, kMost, 1e-5);
    EXPECT_NEAR(limit.far, kMost * (kConstant + 1.5 * kGap) / (kConstant + 0.5 * kGap), 1e-5);
  }
}

// A coil whose resistance keeps its current below that: the other one always can.
TEST(StuckSwitch, AWeakSupplyIsAlwaysHeld) {
  const StuckSwitchLimit limit = LimitOfStuckSwitch(TwoMagnets(6), 0, 0);
  EXPECT_DOUBLE_EQ(limit.end, 4);
  EXPECT_NEAR(limit.centred, kMost, 1e-5);
  EXPECT_EQ(limit.far, limit.end);
}

const std::string kStators = AMBRIG_SOURCE_DIR "/examples/stators/";

/// Notes of a run in which the switches of a coil stay on.
RunResult WithStuckSwitch(const std::string& rig_file, const std::string& coil) {
  const RigParameters rig = ReadRig(kStators + rig_file);
  return Simulate(
      rig,
      ReadScenarioText("rig = \"" + rig_file +
                           "\"\nduration = 0.08\nrecord_rate = 12500.0\nseed = 1\n[[fault]]\n"
                           "time = 0.05\ntarget = \"" +
                           coil + "\"\nkind = \"switch-stuck-on\"\n",
                       "scenario.toml", rig),
      {});
}

// Benches of which the switch is told within a millisecond and the rotor is lost: no currents of
// the others could have kept it, and the run says so.
TEST(StuckSwitch, LostRotorsSayThatNothingCouldHoldThem) {
  for (const auto& [rig, coil] :
       {std::pair{"series_pairs.toml", "A.coil4"}, std::pair{"six_poles.toml", "A.coil2"},
        std::pair{"e_core_and_thrust.toml", "Z.coil1"}}) {
    const RunResult r = WithStuckSwitch(rig, coil);
    EXPECT_TRUE(r.touchdown) << rig;
    EXPECT_THAT(r.notes, Contains(AllOf(
                             HasSubstr(std::string(coil) + " stuck on: its current rises to"),
                             HasSubstr("the other coils within i_max = 6 A hold the shaft against"),
                             HasSubstr("at the far side of its clearance"),
                             EndsWith("only cutting that coil's supply could keep it"))))
        << rig;
  }
}

// A pair of a homopolar bearing pulls with both of its poles, at the far side the other way: only
// the centre is judged.
TEST(StuckSwitch, OfAPairOfOppositePolesOnlyTheCentreIsJudged) {
  const RunResult r = WithStuckSwitch("homopolar.toml", "A.coil2");
  EXPECT_TRUE(r.touchdown);
  EXPECT_THAT(r.notes,
              Contains(AllOf(HasSubstr("A.coil2 stuck on"),
                             EndsWith("only cutting that coil's supply could keep it there"))));
}

}  // namespace
}  // namespace ambrig
