#include "rotor/shaft/ross_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/math/constants.h"
#include "rotor/shaft/rotor_modes.h"
#include "tests/rotor/shaft/shaft_tables.h"

namespace ambrig {
namespace {

using testing::kShaftTables;
using testing::ParseShaft;
using testing::Replaced;

/// A file of this test's own, gone afterwards.
struct Scratch {
  explicit Scratch(const std::string& name)
      : path((std::filesystem::path(::testing::TempDir()) /
              ("ambrig_ross_" + std::to_string(::getpid()) + "_" + name))
                 .string()) {}
  ~Scratch() { std::filesystem::remove(path); }
  void Write(const std::string& text) const { std::ofstream(path) << text; }
  std::string path;
};

// Friswell 5.9.2 as ROSS saves it (6 elements here; the tables in the order of the saved file).
std::string FriswellAsRossToml() {
  std::string text = "ross_version = \"2.3.0\"\n\n[parameters]\n";
  for (int i = 0; i < 6; ++i) {
    const std::string tag = "Shaft Element " + std::to_string(i);
    text +=
        "\n[\"ShaftElement_" + tag +
        "\"]\nL = 0.25\nidl = 0.0\nodl = 0.05\nidr = 0.0\nodr = 0.05\nn = " + std::to_string(i) +
        "\naxial_force = 0\ntorque = 0\nshear_effects = true\nrotary_inertia = true\ngyroscopic = "
        "true\n"
        "shear_method_calc = \"cowper\"\ntag = \"" +
        tag +
        "\"\nalpha = 0.0\nbeta = 0.0\n"
        "\n[\"ShaftElement_" +
        tag +
        "\".material]\nname = \"steel\"\nrho = 7810.0\nE = 211000000000.0\n"
        "G_s = 81200000000.0\ncolor = \"#525252\"\n";
  }
  text +=
      "\n[\"DiskElement_Disk 0\"]\nn = 2\nm = 32.58972765304033\nId = 0.17808928257067666\n"
      "Ip = 0.32956362089137037\ntag = \"Disk 0\"\nscale_factor = 1.0\ncolor = \"Firebrick\"\n"
      "\n[\"DiskElement_Disk 1\"]\nn = 4\nm = 51.525\nId = 0.423581\nIp = 0.805082\ntag = \"Disk "
      "1\"\n";
  for (int n : {0, 6})
    text += "\n[\"BearingElement_Bearing " + std::to_string(n) + "\"]\nn = " + std::to_string(n) +
            "\ntag = \"Bearing\"\ncxx = [ 0,]\nkxx = [ 1000000.0,]\nkxy = [ 0,]\nkyx = [ 0,]\n"
            "kyy = [ 800000.0,]\ncyy = [ 0,]\nmxx = [ 0,]\nscale_factor = 1\n";
  return text;
}

TEST(RossFile, PublishedRotorInRossFormat) {
  const Scratch file("friswell.toml");
  file.Write(FriswellAsRossToml());
  RossRotor r = ReadRoss(file.path);
  EXPECT_TRUE(r.ignored.empty());
  ASSERT_EQ(r.definition.sections.size(), 6u);
  r.definition.elements_per_section = 8;  // the published numbers have 48 elements
  const auto modes = WhirlModes(Assemble(BuildBeam(r.definition)), 4000 * kPi / 30, 6);
  const double published[] = {82.33, 86.86, 239.64, 287.25, 583.49, 806.89};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(modes[i].omega_n, published[i], 5e-4 * published[i]);
}

/// Everything ROSS can hold: taper, bore, sleeve, damping, cross-coupling.
BeamDefinition Everything() {
  BeamDefinition d = ParseShaft(kShaftTables).definition;
  d.sections[0].damping_stiffness = 1e-6;
  d.sections[1].damping_mass = 0.5;
  d.supports[0].kxy = 1e3;
  d.supports[0].name = "left";
  d.theory.coefficient = ShearCoefficient::kHutchinson;
  d.theory.separate_layers = true;                     // as ROSS takes the sleeve
  d.disks.push_back({0.1, 0.2, 1e-4, 2e-4, "wheel"});  // a second one of that name
  return d;
}

TEST(RossFile, RoundTripInBothFormats) {
  const BeamDefinition d = Everything();
  const LinearRotor before = Assemble(BuildBeam(d));
  for (const char* name : {"round.toml", "round.json"}) {
    const Scratch file(name);
    WriteRoss(d, file.path);
    const RossRotor back = ReadRoss(file.path);
    EXPECT_TRUE(back.ignored.empty());
    EXPECT_EQ(back.definition.supports[0].name, "left");
    ASSERT_EQ(back.definition.disks.size(), 3u);
    EXPECT_EQ(back.definition.disks[0].name, "wheel 0");
    EXPECT_EQ(back.definition.disks[1].name, "wheel");
    const LinearRotor after = Assemble(BuildBeam(back.definition));
    ASSERT_EQ(after.M.rows(), before.M.rows()) << name;
    // z = sums of L and nu from E / (2 G) - 1: some roundings of 1e-16, times the cancellation in
    // L.
    EXPECT_LT((after.M - before.M).norm(), 1e-11 * before.M.norm()) << name;
    EXPECT_LT((after.K - before.K).norm(), 1e-11 * before.K.norm()) << name;
    EXPECT_LT((after.D - before.D).norm(), 1e-11 * before.D.norm()) << name;
    EXPECT_LT((after.G - before.G).norm(), 1e-11 * before.G.norm()) << name;
  }
}

TEST(RossFile, CoefficientsAtSpeedMagneticBearingsAndTheRest) {
  const Scratch file("more.toml");
  std::string text = FriswellAsRossToml();
  text = Replaced(text, "kxx = [ 1000000.0,]", "kxx = [ 1e6, 3e6,]\nfrequency = [ 0.0, 100.0,]");
  text +=
      "\n[\"MagneticBearingElement_AMB\"]\nn = 3\ng0 = 0.001\ni0 = 1.0\nag = 1e-4\nnw = "
      "200\n[PointMass_housing]\nn = 7\nm = 5.0\n";
  file.Write(text);
  const RossRotor r = ReadRoss(file.path);
  EXPECT_EQ(r.definition.supports[0].At(25).kxx, 1.5e6);
  EXPECT_EQ(r.definition.supports[0].At(1e4).kxx, 3e6);
  ASSERT_EQ(r.magnetic_bearings.size(), 1u);
  EXPECT_EQ(r.magnetic_bearings[0].z, 0.75);
  ASSERT_EQ(r.ignored.size(), 2u);
  EXPECT_EQ(r.ignored[0],
            "MagneticBearingElement_AMB (node 3): its controller (a transfer function is not in "
            "ROSS's file)");
  EXPECT_EQ(r.ignored[1], "PointMass_housing (node 7): 5 kg at a node that no bearing reaches");
}

std::string RossMessage(const std::string& text) {
  const Scratch file("bad.toml");
  file.Write(text);
  try {
    ReadRoss(file.path);
  } catch (const InputError& e) {
    return std::string(e.what()).substr(file.path.size());
  }
  return "no error";
}

TEST(RossFile, Mistakes) {
  EXPECT_EQ(RossMessage("a = 1\n"),
            ": no shaft element, allowed: a file saved by ROSS's Rotor.save");
  const std::string good = FriswellAsRossToml();
  EXPECT_EQ(RossMessage(Replaced(good, "odl = 0.05\n", "")),
            ":5: ShaftElement_Shaft Element 0: odl is missing");
  EXPECT_EQ(RossMessage(Replaced(good, "n = 3\n", "n = 9\n")), ": no shaft element with n = 6");
  EXPECT_NE(RossMessage(Replaced(good, "n = 4\nm", "n = 40\nm")).find("n = 40, allowed 0 to 6"),
            std::string::npos);
  EXPECT_NE(RossMessage(Replaced(good, "tag = \"Bearing\"", "n_link = 7")).find("n_link"),
            std::string::npos);
  EXPECT_NE(RossMessage(Replaced(good, "m = 32.58972765304033", "m = -5.0"))
                .find("mass = -5 kg, allowed 0"),
            std::string::npos);
  EXPECT_NE(RossMessage(Replaced(good, "Ip = 0.805082", "Ip = 0.9")).find("twice Id"),
            std::string::npos);
  const Scratch huge("huge.json");
  huge.Write("{\"ShaftElement_a\": {\"L\": 1e400}}");
  EXPECT_THROW(ReadRoss(huge.path), InputError);
  EXPECT_THROW(ReadRoss("/nonexistent/rotor.json"), InputError);
  EXPECT_THROW(WriteRoss(Everything(), "/nonexistent/rotor.toml"), InputError);
}

// What hangs on a coupling behind the last shaft (a motor in a torsional model), and gears of which
// ROSS saves the teeth alone, are named with their size.
TEST(RossFile, NamesWhatNoShaftFollows) {
  const std::string more =
      "[CouplingElement_hub]\nn = 6\nL = 0.3\nm_l = 2.0\nm_r = 3.0\nIp_l = 0.02\nIp_r = 0.03\nkt_x "
      "= 0.0\n"
      "[CouplingElement_motor]\nn = 7\nL = 1.0\nm_l = 4.0\nm_r = 5.0\nkt_x = 7.0\n"
      "[GearElementTVMS_wheel]\nn = 2\nn_teeth = 37\nmodule = 0.003\n";
  const Scratch file("hanging.toml");
  file.Write(FriswellAsRossToml() + more);
  const RossRotor ross = ReadRoss(file.path);
  EXPECT_TRUE(ross.definition.shafts.empty());
  ASSERT_EQ(ross.definition.disks.size(), 3u);
  EXPECT_EQ(ross.definition.disks.back().name, "hub_left");
  EXPECT_EQ(ross.definition.disks.back().mass, 2);
  EXPECT_EQ(ross.definition.disks.back().inertia_diametral, 0.01);
  EXPECT_EQ(ross.definition.disks.back().z, 1.5);
  ASSERT_EQ(ross.ignored.size(), 3u);
  EXPECT_NE(ross.ignored[0].find("its right half, which no shaft follows, 3 kg, kt_x = 0 N/m"),
            std::string::npos)
      << ross.ignored[0];
  EXPECT_NE(ross.ignored[1].find("no shaft at either side, 9 kg, kt_x = 7 N/m"), std::string::npos)
      << ross.ignored[1];
  EXPECT_NE(ross.ignored[2].find("its mass and mesh, of which ROSS saves the 37 teeth"),
            std::string::npos)
      << ross.ignored[2];
}

TEST(RossFile, NamedInARigFile) {
  const Scratch file("rig_rotor.toml");
  file.Write(FriswellAsRossToml());
  const BeamFile beam =
      ParseShaft("[rotor]\nkind = \"beam\"\nmodes = 1\nfile = \"" + file.path + "\"\n");
  EXPECT_NEAR(BuildReduced(beam).mass, 107.117, 1e-3);
}

}  // namespace
}  // namespace ambrig
