#include "rotor/shaft/beam_file.h"

#include <gtest/gtest.h>

#include "core/math/constants.h"
#include "rotor/shaft/rotor_modes.h"
#include "rotor/shaft/shaft_file.h"
#include "tests/rotor/shaft/shaft_tables.h"

namespace ambrig {
namespace {

using testing::kShaftTables;
using testing::ParseShaft;
using testing::Replaced;
using testing::ShaftMessage;

TEST(BeamFile, ReadsEveryTable) {
  std::vector<Tolerance> tolerances;
  const BeamFile file = ParseShaft(kShaftTables, &tolerances);
  const BeamDefinition& d = file.definition;
  ASSERT_EQ(d.sections.size(), 3u);
  EXPECT_EQ(d.sections[0].material.rho, 8000);
  EXPECT_EQ(d.sections[0].od_right, 0.02);
  EXPECT_EQ(d.sections[1].z0, 0.1);
  EXPECT_EQ(d.sections[1].od_right, 0.02);
  EXPECT_EQ(d.sections[1].id_right, 0.01);
  EXPECT_FALSE(d.sections[2].stiff);
  EXPECT_EQ(d.sections[2].material.rho, 7650);
  EXPECT_NEAR(d.disks[0].mass, 7810 * kPi / 4 * (0.1 * 0.1 - 0.026 * 0.026) * 0.02, 1e-12);
  EXPECT_EQ(d.disks[1].inertia_polar, 2e-4);
  EXPECT_EQ(d.supports[0].kxx, 1e6);
  EXPECT_EQ(d.supports[0].kyy, 2e6);
  EXPECT_EQ(d.supports[0].cyy, 10);
  EXPECT_EQ(file.modes, 2);
  ASSERT_EQ(tolerances.size(), 1u);
  EXPECT_EQ(tolerances[0].path, "rotor.materials.m300.E");
  const ReducedRotor r = BuildReduced(file);
  EXPECT_EQ(r.zeta, (std::vector<double>{0.001, 0.002}));
  const RotorTotals t = Totals(BuildBeam(d));
  EXPECT_NEAR(r.mass, t.mass, 1e-10);
}

TEST(BeamFile, ChoicesReachTheModel) {
  const double plain = BuildReduced(ParseShaft(kShaftTables)).omega[1];
  const double no_shear =
      BuildReduced(ParseShaft(Replaced(kShaftTables, "modes = 2", "modes = 2\nshear = false")))
          .omega[1];
  const double lumped =
      BuildReduced(ParseShaft(Replaced(kShaftTables, "modes = 2", "modes = 2\nmass = \"lumped\"")))
          .omega[1];
  EXPECT_GT(no_shear, plain);
  EXPECT_LT(lumped, plain);
}

TEST(BeamFile, TheTheoryIsReadKeyByKey) {
  const auto theory = [](const std::string& line) {
    return ParseShaft(Replaced(kShaftTables, "modes = 2", "modes = 2\n" + line)).definition.theory;
  };
  EXPECT_TRUE(theory("").gyroscopic);
  EXPECT_FALSE(theory("gyroscopic = false").gyroscopic);
  EXPECT_TRUE(theory("gyroscopic = false").rotary_inertia);
  EXPECT_FALSE(theory("rotary_inertia = false").rotary_inertia);
  EXPECT_EQ(theory("shear_coefficient = \"hutchinson\"").coefficient,
            ShearCoefficient::kHutchinson);
  EXPECT_EQ(theory("").coefficient, ShearCoefficient::kCowper);
}

// pi/4 D² L rho, m D²/16 + m L²/12 about a diameter, m D²/8 about the axis.
TEST(BeamFile, ADiskWithoutABoreIsSolid) {
  const Disk disk = ParseShaft(Replaced(kShaftTables, "id = 0.026\n", "")).definition.disks[0];
  const double m = 7810 * kPi / 4 * 0.1 * 0.1 * 0.02;
  EXPECT_NEAR(disk.mass, m, 1e-12);
  EXPECT_NEAR(disk.inertia_polar, m * 0.1 * 0.1 / 8, 1e-15);
  EXPECT_NEAR(disk.inertia_diametral, m * (0.1 * 0.1 / 16 + 0.02 * 0.02 / 12), 1e-15);
  EXPECT_NE(ShaftMessage(Replaced(kShaftTables, "id = 0.026", "id = 0.1")).find("allowed above id"),
            std::string::npos);
}

TEST(BeamFile, ASectionNeedsAWall) {
  EXPECT_EQ(ShaftMessage(Replaced(kShaftTables, "id = 0.01", "id = 0.03")),
            "rig.toml:19: rotor.section[2].id: id = 0.03 m, allowed 0 to below od = 0.03 m");
}

TEST(BeamFile, MistakesNameFileLineAndKey) {
  EXPECT_EQ(ShaftMessage(Replaced(kShaftTables, "od = 0.02", "od = -0.02")),
            "rig.toml:13: rotor.section[1].od = -0.02 m, allowed 1e-05 to 100 m (outer diameter "
            "(left end))");
  EXPECT_EQ(ShaftMessage(Replaced(kShaftTables, "\"m300\"", "\"m30\"")),
            "rig.toml:14: rotor.section[1].material = \"m30\", allowed: aluminium, m300, steel, "
            "titanium (did you mean m300?)");
  EXPECT_EQ(ShaftMessage(Replaced(kShaftTables, "id = 0.01", "id = 0.05")),
            "rig.toml:19: rotor.section[2].id: id = 0.05 m, allowed 0 to below od = 0.03 m");
  EXPECT_EQ(ShaftMessage(Replaced(kShaftTables, "z = 0.3", "z = 0.4")),
            "rig.toml:1: rotor: disk \"\" at z = 0.4 m is off the shaft, allowed 0 to "
            "0.30000000000000004 m");
  EXPECT_EQ(ShaftMessage(Replaced(kShaftTables, "inertia_polar = 2e-4", "inertia_polar = 3e-4")),
            "rig.toml:39: rotor.disk[2].inertia_polar: 0.0003 kg m2, allowed up to twice "
            "inertia_diametral = 0.0001 kg m2");
  EXPECT_EQ(ShaftMessage(Replaced(kShaftTables, "[0.001, 0.002]", "[0.001, 0.002, 0.003]")),
            "rig.toml:4: rotor.modal_damping: 3 values, allowed: one, or one per mode (2)");
  EXPECT_EQ(ShaftMessage(Replaced(kShaftTables, "modes = 2", "modes = 101")),
            "rig.toml:3: rotor.modes: 101, allowed 0 to 100");
  EXPECT_NE(
      ShaftMessage(Replaced(kShaftTables, "width = 0.02", "widht = 0.02")).find("did you mean"),
      std::string::npos);
  EXPECT_EQ(
      ShaftMessage("[rotor]\nkind = \"beam\"\n"),
      "rig.toml:1: rotor.section: is missing, allowed: tables, each written [[rotor.section]]");
}

TEST(BeamFile, StaticCorrectionIsReadAndWritten) {
  EXPECT_FALSE(ParseShaft(kShaftTables).static_correction);
  const BeamFile file =
      ParseShaft(Replaced(kShaftTables, "modes = 2", "modes = 2\nstatic_correction = true"));
  EXPECT_TRUE(file.static_correction);
  EXPECT_TRUE(ParseShaft(BeamText(file)).static_correction);
  EXPECT_EQ(BuildReduced(file).modes(), 2);  // stations are a rig's
  EXPECT_EQ(BuildReduced(file, {file.definition.sections.front().z0}).modes(), 3);
}

}  // namespace
}  // namespace ambrig
