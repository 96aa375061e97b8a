#include "rotor/shaft/beam_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/math/constants.h"
#include "rotor/shaft/ross_file.h"
#include "rotor/shaft/rotor_modes.h"

namespace ambrig {
namespace {

const char* const kFile = R"([rotor]
kind = "beam"
modes = 2
modal_damping = [0.001, 0.002]
elements_per_section = 3
stations = [0.07]
[rotor.materials.m300]
E = { value = 1.9e11, sd = 2e9 }
rho = 8000.0
nu = 0.3
[[rotor.section]]
length = 0.1
od = 0.02
material = "m300"
[[rotor.section]]
length = 0.2
od = 0.03
od_right = 0.02
id = 0.01
E = 2.1e11
rho = 7850
[[rotor.sleeve]]
z0 = 0.02
length = 0.05
id = 0.02
od = 0.04
rho = 7650
[[rotor.disk]]
z = 0.2
width = 0.02
id = 0.026
od = 0.1
material = "steel"
name = "wheel"
[[rotor.disk]]
z = 0.3
mass = 0.5
inertia_diametral = 1e-4
inertia_polar = 2e-4
[[rotor.support]]
z = 0
k = 1e6
c = 10
kyy = 2e6
)";

BeamFile Parse(const std::string& text, std::vector<Tolerance>* tolerances = nullptr) {
  return ReadBeam(*TomlTable::FromText(text, "rig.toml").Table("rotor"), tolerances);
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string MessageOf(const std::string& text) {
  try {
    Parse(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

TEST(BeamFile, ReadsEveryTable) {
  std::vector<Tolerance> tolerances;
  const BeamFile file = Parse(kFile, &tolerances);
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
  const double plain = BuildReduced(Parse(kFile)).omega[1];
  const double no_shear =
      BuildReduced(Parse(Replaced(kFile, "modes = 2", "modes = 2\nshear = false"))).omega[1];
  const double lumped =
      BuildReduced(Parse(Replaced(kFile, "modes = 2", "modes = 2\nmass = \"lumped\""))).omega[1];
  EXPECT_GT(no_shear, plain);
  EXPECT_LT(lumped, plain);
}

TEST(BeamFile, MistakesNameFileLineAndKey) {
  EXPECT_EQ(MessageOf(Replaced(kFile, "od = 0.02", "od = -0.02")),
            "rig.toml:13: rotor.section[1].od = -0.02 m, allowed 1e-05 to 100 m (outer diameter "
            "(left end))");
  EXPECT_EQ(MessageOf(Replaced(kFile, "\"m300\"", "\"m30\"")),
            "rig.toml:14: rotor.section[1].material = \"m30\", allowed: aluminium, m300, steel, "
            "titanium (did you mean m300?)");
  EXPECT_EQ(MessageOf(Replaced(kFile, "id = 0.01", "id = 0.05")),
            "rig.toml:19: rotor.section[2].id: id = 0.05 m, allowed 0 to below od = 0.03 m");
  EXPECT_EQ(MessageOf(Replaced(kFile, "z = 0.3", "z = 0.4")),
            "rig.toml:1: rotor: disk \"\" at z = 0.4 m is off the shaft, allowed 0 to "
            "0.30000000000000004 m");
  EXPECT_EQ(MessageOf(Replaced(kFile, "inertia_polar = 2e-4", "inertia_polar = 3e-4")),
            "rig.toml:39: rotor.disk[2].inertia_polar: 0.0003 kg m2, allowed up to twice "
            "inertia_diametral = 0.0001 kg m2");
  EXPECT_EQ(MessageOf(Replaced(kFile, "[0.001, 0.002]", "[0.001, 0.002, 0.003]")),
            "rig.toml:4: rotor.modal_damping: 3 values, allowed: one, or one per mode (2)");
  EXPECT_EQ(MessageOf(Replaced(kFile, "modes = 2", "modes = 101")),
            "rig.toml:3: rotor.modes: 101, allowed 0 to 100");
  EXPECT_NE(MessageOf(Replaced(kFile, "width = 0.02", "widht = 0.02")).find("did you mean"),
            std::string::npos);
  EXPECT_EQ(
      MessageOf("[rotor]\nkind = \"beam\"\n"),
      "rig.toml:1: rotor.section: is missing, allowed: tables, each written [[rotor.section]]");
}

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
  BeamDefinition d = Parse(kFile).definition;
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

TEST(RossFile, NamedInARigFile) {
  const Scratch file("rig_rotor.toml");
  file.Write(FriswellAsRossToml());
  const BeamFile beam =
      Parse("[rotor]\nkind = \"beam\"\nmodes = 1\nfile = \"" + file.path + "\"\n");
  EXPECT_NEAR(BuildReduced(beam).mass, 107.117, 1e-3);
}

}  // namespace
}  // namespace ambrig
