// The user's own law: same numbers as the built-in effect, one clear line for every mistake.
#include "effects/formula.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/effects/effect_rigs.h"
#include "tests/effects/motion_rig.h"

namespace ambrig::motion {
namespace {

using ::testing::HasSubstr;

std::string Effect(const std::string& target, const std::string& lines) {
  return "\n[[effect]]\nname = \"formula\"\ntarget = \"" + target + "\"\n" + lines + "\n";
}

std::string Complaint(const std::string& target, const std::string& lines) {
  try {
    Rig(Effect(target, lines));
  } catch (const InputError& e) {
    return e.what();
  }
  return "none";
}

const char* kSealRub = R"toml(label = "seal rub"
parameters = { k = { value = 1e6, null = 0.0, min = 0.0, max = 1e7, unit = "N/m" }, c = { value = 1e-5, min = 0.0, max = 1e-4, unit = "m" } }
force = { x = "-k * max(x - c, 0)", y = "0" })toml";

TEST(Formula, SealRubOfTheCatalogue) {
  Plant plant = BuildPlant(TrueRig(Rig(Effect("B", kSealRub))));
  MotionState s;
  s.q[0] = 3e-5;
  EXPECT_NEAR(Forces(plant, s).Q[0], -20, 1e-12);
  EXPECT_NEAR(Forces(plant, s).stator_x, -20, 1e-12);
  s.q[0] = -3e-5;
  EXPECT_EQ(Forces(plant, s).Q[0], 0);
}

TEST(Formula, ParametersCarryUnitNullAndBounds) {
  const RigParameters rig = Rig(Effect("B", kSealRub));
  EffectInstance e = rig.effects.at(0);
  ASSERT_EQ(e.table.size(), 2u);
  EXPECT_EQ(e.Value("c"), 1e-5);
  const EffectParameter& k = e.table[0].name == "k" ? e.table[0] : e.table[1];
  EXPECT_EQ(k.unit, "N/m");
  EXPECT_EQ(k.hi, 1e7);
  EXPECT_EQ(k.null_value, 0);
  EXPECT_TRUE(k.has_null);
  EXPECT_FALSE(e.IsNull());
  e.Set("k", 0);  // c has no null: it does not count
  EXPECT_TRUE(e.IsNull());
}

TEST(Formula, WithoutNullsIsAlwaysOn) {
  const RigParameters rig =
      Rig(Effect("A", "parameters = { load = 3.0 }\nforce = { y = \"-load\" }"));
  EXPECT_FALSE(rig.effects[0].IsNull());
  EXPECT_EQ(Forces(BuildPlant(TrueRig(rig)), MotionState{}).Q[1], -3);
}

TEST(Formula, SameForceAsCrossCoupling) {
  Plant formula = BuildPlant(TrueRig(
      Rig(Effect("A", "parameters = { k = 4e4 }\nforce = { x = \"-k * y\", y = \"k * x\" }"))));
  Plant effect = PlantOf({{"cross-coupling", "A", {{"stiffness", 4e4}}}});
  MotionState s;
  for (std::size_t d = 0; d < 5; ++d) s.q[d] = 1e-5 * (static_cast<double>(d) - 1.7);
  EXPECT_EQ(Forces(formula, s).Q, Forces(effect, s).Q);
}

TEST(Formula, KnowsMotionCurrentsBusAndConditions) {
  Plant plant =
      BuildPlant(TrueRig(Rig(Effect("A",
                                    "force = { x = \"1e3*vx + theta + 2*omega + 3*t + i3 - i4 + "
                                    "bus\", y = \"omega > 10 ? tanh(1) : sign(-2) + pi\" }"))));
  MotionState s;
  s.v[0] = 1e-3;
  s.theta = 0.5;
  s.Omega = 7;
  s.t = 0.25;
  plant.bearings[0].lanes.i[2] = 2.5;
  plant.bearings[0].lanes.i[3] = 0.5;
  plant.bus.voltage = 28;
  EXPECT_NEAR(Forces(plant, s).Q[0], 1 + 0.5 + 14 + 0.75 + 2 + 28, 1e-12);
  EXPECT_NEAR(Forces(plant, s).Q[1], kPi - 1, 1e-12);
  s.Omega = 11;
  EXPECT_NEAR(Forces(plant, s).Q[1], std::tanh(1.0), 1e-12);
}

TEST(Formula, FollowsAPlantThatMoves) {
  Plant first = BuildPlant(TrueRig(Rig(Effect("A", "force = { x = \"bus + i1\" }"))));
  const Plant plant = std::move(first);
  plant.bus.voltage = 12;
  EXPECT_EQ(Forces(plant, MotionState{}).Q[0], 12);
}

TEST(Formula, ReadingTorqueVoltage) {
  Plant reading = BuildPlant(
      TrueRig(Rig(Effect("B.y", "parameters = { q = 60.0 }\nreading = \"y * (1 + q * y)\""))));
  MotionState s;
  s.q[0] = 1e-4;
  s.q[1] = 2e-4;
  EXPECT_EQ(Reading(reading, 1, s).first, 1e-4);
  EXPECT_NEAR(Reading(reading, 1, s).second, 2e-4 * (1 + 60 * 2e-4), 1e-18);

  Plant torque = BuildPlant(TrueRig(Rig(Effect("rig", "torque = \"-1e-3 * omega\""))));
  s.Omega = 500;
  EXPECT_NEAR(Forces(torque, s).torque, -0.5, 1e-15);

  Plant voltage =
      BuildPlant(TrueRig(Rig(Effect("A.coil3", "voltage = \"-0.1 * i + 1e3 * x + omega\""))));
  ASSERT_EQ(voltage.bearings[0].voltage[2].size(), 1u);
  EXPECT_TRUE(voltage.bearings[0].voltage[1].empty());
  EXPECT_NEAR(voltage.bearings[0].voltage[2][0]->Voltage({0, 2, 30, 1e-3, 0, &s}), -0.2 + 1 + 500,
              1e-12);

  Plant axial = BuildPlant(TrueRig(Rig(Effect("z", "force = \"-1e5 * x\""))));
  s.q[2] = 2e-5;
  EXPECT_NEAR(Forces(axial, s).Q[2], -2, 1e-12);
}

TEST(Formula, RunsLikeTheEffectItWritesOut) {
  const RigParameters formula =
      Rig(Effect("B.y", "parameters = { g = 1.06 }\nreading = \"g * y\""));
  const RigParameters effect = RigWith({{"sensor-gain", "B.y", {{"gain", 1.06}}}});
  EXPECT_EQ(
      Change(RunText(formula, LevitatedText()).record, RunText(effect, LevitatedText()).record), 0);
  EXPECT_GT(
      Change(RunText(formula, LevitatedText()).record, RunText(Rig(), LevitatedText()).record),
      1e-4);
}

TEST(Formula, VoltageReachesTheCoil) {
  // -r i in series is r more resistance in the copper (mean over a period against the sampled
  // current: ripple and the hold over 40 us leave a little, against the change that r makes).
  RigParameters more = Rig();
  more.bearings[0].radial.resistance = 0.8;
  std::string text;
  for (int j = 1; j <= 8; ++j)
    text += Effect("A.coil" + std::to_string(j), "voltage = \"-0.3 * i\"");
  const Record with = RunText(Rig(text), LevitatedText()).record;
  const double made = Change(with, RunText(Rig(), LevitatedText()).record);
  EXPECT_GT(made, 1e-4);
  EXPECT_LT(Change(with, RunText(more, LevitatedText()).record), 0.3 * made);
}

TEST(Formula, MistakesAreOneClearLine) {
  const std::string unknown =
      Complaint("A", "parameters = { k = 1.0 }\nforce = { x = \"-k * xx\" }");
  EXPECT_THAT(unknown, HasSubstr("rig.toml:"));
  EXPECT_THAT(unknown, HasSubstr("force.x = \"-k * xx\": unknown name \"xx\""));
  EXPECT_THAT(unknown, HasSubstr("known: x, y, vx, vy, theta, omega, t, bus, i1"));
  EXPECT_THAT(unknown, HasSubstr("k; functions: abs"));
  EXPECT_EQ(unknown.find('\n'), std::string::npos);
  EXPECT_THAT(Complaint("A", "force = { x = \"2 * (x + 1\" }"), HasSubstr("parenthesis"));
  EXPECT_THAT(Complaint("A", "force = { x = \"2 * \" }"), HasSubstr("ends too early"));
  EXPECT_THAT(Complaint("A", "force = { x = \"\" }"), HasSubstr("is empty"));
  EXPECT_THAT(Complaint("A", "force = { x = \"x = 3\" }"), HasSubstr("compare with \"==\""));
  EXPECT_THAT(Complaint("A", "force = { x = \"x, y\" }"), HasSubstr("one formula is allowed"));
  EXPECT_THAT(Complaint("A", "force = { x = \"x / sqrt(x^2 + y^2)\" }"),
              HasSubstr("with the shaft at rest"));
  EXPECT_THAT(Complaint("A", "force = { x = \"sqrt(-1 - x)\" }"), HasSubstr("gives"));
  EXPECT_THAT(Complaint("A", "force = { z = \"x\" }"), HasSubstr("unknown"));
  EXPECT_THAT(Complaint("A", "force = \"x\""), HasSubstr("acts on a plane"));
  EXPECT_THAT(Complaint("A.x", "force = { x = \"x\" }"), HasSubstr("acts on one axis"));
  EXPECT_THAT(Complaint("A", "torque = \"1\""), HasSubstr("needs \"rig\" as target"));
  EXPECT_THAT(Complaint("rig", "force = { x = \"1\" }"), HasSubstr("needs a plane or an axis"));
  EXPECT_THAT(Complaint("rig", "torque = \"i1\""), HasSubstr("unknown name \"i1\""));
  EXPECT_THAT(Complaint("A", ""), HasSubstr("has no formula"));
  EXPECT_THAT(Complaint("A", "parameters = { t = 1.0 }\nforce = { x = \"t\" }"),
              HasSubstr("reserved name"));
  EXPECT_THAT(Complaint("A", "parameters = { max = 1.0 }\nforce = { x = \"1\" }"),
              HasSubstr("not a valid parameter name"));
  EXPECT_THAT(
      Complaint("A", "parameters = { k = { value = 2.0, max = 1.0 } }\nforce = { x = \"k\" }"),
      HasSubstr("allowed -inf to 1"));
  EXPECT_THAT(
      Complaint("A", "parameters = { k = { value = 1.0, mx = 1.0 } }\nforce = { x = \"k\" }"),
      HasSubstr("mx"));
}

}  // namespace
}  // namespace ambrig::motion
