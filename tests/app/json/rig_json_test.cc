// A rig file resolved as JSON, and what differs between two rigs.
#include "app/json/rig_json.h"

#include <gmock/gmock.h>

#include <cmath>

#include "rig/rig_file.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;

RigParameters PlainRig() { return ReadRigText(ReferenceRigText(), "rig.toml"); }

/// What differs, by its name.
const RigDifference* Named(const std::vector<RigDifference>& all, const std::string& what) {
  for (const RigDifference& d : all)
    if (d.what == what) return &d;
  return nullptr;
}

TEST(RigJson, NumbersHaveUnitsAndOnlyCalibratedOnesAFittedValue) {
  RigParameters rig = PlainRig();
  rig.tolerances = {{"rotor.mass", 0.05, kRequired}, {"rotor.inertia_polar", 1e-4, 0.0123}};
  const auto json = RigJson(rig);
  const auto& mass = json["values"]["rotor.mass"];
  EXPECT_EQ(mass["value"], rig.rotor.mass);
  EXPECT_EQ(mass["unit"], "kg");
  EXPECT_EQ(mass["sd"], 0.05);
  EXPECT_FALSE(mass.contains("fitted"));
  EXPECT_EQ(json["values"]["rotor.inertia_polar"]["fitted"], 0.0123);
  EXPECT_FALSE(json["values"]["rotor.inertia_transverse"].contains("sd"));
}

// Eight coils 45 degrees apart from 22.5 on, within a half turn from the x axis.
TEST(RigJson, CoilsStandWhereTheDrawingPutsThem) {
  const auto json = RigJson(PlainRig());
  const auto& coils = json["bearings"][0]["coils"];
  ASSERT_EQ(coils.size(), 8u);
  for (std::size_t k = 0; k < 8; ++k) {
    const double turned = 22.5 + 45 * static_cast<double>(k);
    EXPECT_NEAR(coils[k]["angle_deg"].get<double>(), turned > 180 ? turned - 360 : turned, 1e-9)
        << k;
    EXPECT_EQ(coils[k]["gap"], PlainRig().bearings[0].radial.gap);
  }
  EXPECT_EQ(json["bearings"][0]["axes"], nlohmann::json({"A.x", "A.y"}));
  EXPECT_EQ(json["bearings"][0]["clearance"], PlainRig().bearings[0].auxiliary->clearance);
}

TEST(RigDifferences, ARigIsItself) { EXPECT_TRUE(RigDifferences(PlainRig(), PlainRig()).empty()); }

TEST(RigDifferences, ANumberIsToldWithItsUnitAndInSds) {
  RigParameters a = PlainRig(), b = a;
  b.rotor.mass = a.rotor.mass + 0.1;
  a.tolerances = b.tolerances = {{"rotor.mass", 0.05, kRequired}};
  const auto all = RigDifferences(a, b);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].what, "rotor.mass");
  EXPECT_EQ(all[0].unit, "kg");
  EXPECT_NEAR(std::stod(all[0].b) - std::stod(all[0].a), 0.1, 1e-7);
  EXPECT_NEAR(all[0].sds, 2, 1e-9);
  EXPECT_NEAR(RigDifferences(b, a)[0].sds, -2, 1e-9);
}

// A calibrated value is what simulates: a rig with value 4 fitted 4.2 equals one of 4.2 but for its
// tolerance.
TEST(RigDifferences, TheCalibratedValueCountsAndToleranceIsItsOwnLine) {
  RigParameters a = PlainRig();
  a.tolerances.clear();
  RigParameters b = a;
  a.tolerances = {{"rotor.mass", 0.05, a.rotor.mass + 0.2}};
  b.rotor.mass = a.rotor.mass + 0.2;
  const auto all = RigDifferences(a, b);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].what, "rotor.mass.sd");
  EXPECT_EQ(all[0].b, "");  // b has none
  EXPECT_EQ(all[0].sds, 0);
}

TEST(RigDifferences, PlacesGravityAndKindsCountToo) {
  const RigParameters a = PlainRig();
  RigParameters b = a;
  b.gravity[1] = -1.62;
  b.bearings[1].z += 0.01;
  const auto all = RigDifferences(a, b);
  EXPECT_EQ(all.size(), 2u);
  ASSERT_NE(Named(all, "gravity[1]"), nullptr);
  EXPECT_EQ(Named(all, "gravity[1]")->b, "-1.62");
  ASSERT_NE(Named(all, "bearings.B.z"), nullptr);
}

TEST(RigDifferences, AnEffectOfOneRigOnlyIsToldNumberByNumber) {
  const RigParameters a = PlainRig();
  const RigParameters b = ReadRigText(ReferenceRigText() +
                                          "\n[[effect]]\nname = \"cross-coupling\"\ntarget = "
                                          "\"A\"\nparameters = { stiffness = 1.5e4 }\n",
                                      "rig.toml");
  const auto all = RigDifferences(a, b);
  const RigDifference* d = Named(all, "effect cross-coupling at A: stiffness");
  ASSERT_NE(d, nullptr);
  EXPECT_EQ(d->a, "");
  EXPECT_EQ(d->b, "15000");
  EXPECT_EQ(d->unit, "N/m");
  const auto back = RigDifferences(b, a);
  ASSERT_NE(Named(back, d->what), nullptr);
  EXPECT_EQ(Named(back, d->what)->b, "");
}

}  // namespace
}  // namespace ambrig
