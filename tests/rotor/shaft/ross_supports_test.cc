// What a file of ROSS holds beside shaft and disks is carried, or named with its size.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <tuple>

#include "core/math/constants.h"
#include "rotor/shaft/ross_file.h"
#include "rotor/shaft/rotor_modes.h"
#include "rotor/shaft/shaft_file.h"

namespace ambrig {
namespace {

class RossTable {
 public:
  RossTable()
      : path_(std::filesystem::path(::testing::TempDir()) /
              ("ross_supports_" + std::to_string(::getpid()) + ".toml")) {
    for (int n = 0; n < 2; ++n)
      text_ += "[\"ShaftElement_" + std::to_string(n) +
               "\"]\nL = 0.5\nidl = 0.0\nodl = 0.02\nn = " + std::to_string(n) +
               "\ntorque = " + (n ? "12.5" : "0") + "\naxial_force = 0\n[\"ShaftElement_" +
               std::to_string(n) + "\".material]\nrho = 7800.0\nE = 1e13\nG_s = 4e12\n";
  }
  ~RossTable() { std::filesystem::remove(path_); }
  void Add(const std::string& text) { text_ += text; }
  RossRotor Read() const {
    std::ofstream(path_) << text_;
    return ReadRoss(path_.string());
  }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
  std::string text_;
};

std::string ChainOf(int at, int node) {
  const std::string n = std::to_string(at), h = std::to_string(node);
  return "[BearingElement_on" + n + "]\nn = " + n + "\nn_link = " + h +
         "\nkxx = [10.0,]\ncxx = [0.0,]\n[BearingElement_under" + n + "]\nn = " + h +
         "\nkxx = [40.0,]\ncxx = [0.0,]\n[PointMass_block" + n + "]\nn = " + h + "\nm = 1.5\n";
}

// A stiff bar on k on blocks M on K: two masses in series; and the same through a file of ours and
// of ROSS.
TEST(RossSupports, HousingsAreCarriedBothWays) {
  RossTable table;
  table.Add(ChainOf(0, 3) + ChainOf(2, 4));
  const RossRotor r = table.Read();
  const double m = 7800 * kPi / 4 * 4e-4, k = 10, K = 40, M = 1.5;
  const double a = k / (m / 2), b = (k + K) / M, c = k * k / (m / 2 * M);
  const double w = std::sqrt((a + b) / 2 - std::sqrt(std::pow((a - b) / 2, 2) + c));
  const auto lowest = [&](const BeamDefinition& d) {
    double nearest = 0;
    for (const WhirlMode& mode : WhirlModes(Assemble(BuildBeam(d)), 0, 40))
      if (std::abs(mode.omega_d - w) < std::abs(nearest - w)) nearest = mode.omega_d;
    return nearest;
  };
  EXPECT_NEAR(lowest(r.definition) / w, 1, 1e-5);
  EXPECT_TRUE(r.ignored.empty());
  EXPECT_EQ(r.definition.sections[1].torque, 12.5);
  EXPECT_TRUE(WriteRoss(r.definition, table.path()).empty());
  EXPECT_NEAR(lowest(ReadRoss(table.path()).definition) / w, 1, 1e-5);
}

TEST(RossSupports, TablesKeepEverySpeedAndCoefficient) {
  RossTable table;
  table.Add(
      "[SealElement_gas]\nn = 1\nfrequency = [0.0, 100.0, 300.0,]\nkxx = [1e6, 2e6, 4e6,]\ncxx = "
      "[10.0, 10.0, 10.0,]\nmxx = [1.0, 1.5, 2.0,]\nkzz = [5.0, 5.0, 5.0,]\n");
  const RossRotor r = table.Read();
  ASSERT_EQ(r.definition.supports.size(), 1U);
  const SpringSupport& s = r.definition.supports[0];
  EXPECT_EQ(s.At(100).kxx, 2e6);
  EXPECT_NEAR(s.At(200).kxx, 3e6, 1e-6);  // the parabola through them is this line
  EXPECT_EQ(s.At(300).kyy, 4e6);
  EXPECT_EQ(s.At(300).myy, 2.0);
  EXPECT_EQ(s.At(50).kzz, 5.0);
  WriteRoss(r.definition, table.path());
  const SpringSupport back = ReadRoss(table.path()).definition.supports[0];
  for (const double speed : {0.0, 40.0, 250.0})
    for (const Field<SupportCoefficients>& f : kSupportCoefficients)
      EXPECT_EQ(back.At(speed).*f.at, s.At(speed).*f.at) << f.key;
}

// Of an isotropic film over three speeds k = 1, 2, 5 MN/m: half way between the first two 1.5 on
// straight lines, 1.25 on the parabola through them.
TEST(RossSupports, TheirInterpolationIsThatOfTheFile) {
  for (const auto& [word, between, told] :
       {std::tuple{"linear", 1.5e6, 0U}, {"cubic", 1.25e6, 0U}, {"pchip", 1.25e6, 1U}}) {
    RossTable table;
    table.Add(
        "[BearingElement_film]\nn = 1\nspeed = [0.0, 100.0, 200.0,]\nkxx = [1e6, 2e6, 5e6,]\n"
        "cxx = [0.0, 0.0, 0.0,]\ninterpolation = \"" +
        std::string(word) + "\"\n");
    const RossRotor r = table.Read();
    ASSERT_EQ(r.definition.supports.size(), 1U);
    EXPECT_NEAR(r.definition.supports[0].At(50).kxx, between, 1) << word;
    EXPECT_EQ(r.ignored.size(), told) << word;
  }
}

// What of a mass is not given beside mx and my is none; of a plain m all three are.
TEST(RossSupports, AMassIsThatOfItsDirections) {
  for (const auto& [mass, x, y, z] : {std::tuple{"m = 1.5", 1.5, 1.5, 1.5},
                                      {"mx = 2.0\nmy = 3.0", 2.0, 3.0, 0.0},
                                      {"mx = 2.0\nmy = 3.0\nmz = 4.0", 2.0, 3.0, 4.0}}) {
    RossTable table;
    table.Add(std::string("[PointMass_block]\nn = 1\n") + mass + "\n");
    const BeamDefinition d = table.Read().definition;
    ASSERT_EQ(d.masses.size(), 1U);
    EXPECT_EQ(d.masses[0].mass_x, x) << mass;
    EXPECT_EQ(d.masses[0].mass_y, y) << mass;
    EXPECT_EQ(d.masses[0].mass_z, z) << mass;
  }
}

// The shaft of two elements, and behind a coupling another one of two: each half sits where its own
// shaft begins or ends.
TEST(RossSupports, TheHalvesOfACouplingSitAtItsTwoEnds) {
  RossTable table;
  for (const int n : {3, 4})
    table.Add("[ShaftElement_" + std::to_string(n) +
              "]\nL = 0.5\nidl = 0.0\nodl = 0.02\nn = " + std::to_string(n) + "\n[ShaftElement_" +
              std::to_string(n) + ".material]\nrho = 7800.0\nE = 1e13\nG_s = 4e12\n");
  table.Add(
      "[CouplingElement_hub]\nn = 2\nm_l = 2.0\nm_r = 3.0\nIp_l = 0.02\nIp_r = 0.03\nkt_x = "
      "1e6\n");
  const BeamDefinition d = table.Read().definition;
  ASSERT_EQ(d.shafts.size(), 2U);
  ASSERT_EQ(d.disks.size(), 2U);
  EXPECT_EQ(d.disks[0].name, "hub_left");
  EXPECT_EQ(d.disks[0].mass, 2);
  EXPECT_EQ(d.disks[0].shaft, d.shafts[0].name);
  EXPECT_NEAR(d.disks[0].z - d.shafts[0].start, 1, 1e-12);
  EXPECT_EQ(d.disks[1].name, "hub_right");
  EXPECT_EQ(d.disks[1].mass, 3);
  EXPECT_EQ(d.disks[1].shaft, d.shafts[1].name);
  EXPECT_NEAR(d.disks[1].z - d.shafts[1].start, 0, 1e-12);
}

// Version 2.3 saves a magnetic bearing as a BearingElement with the springs of its controller.
TEST(RossSupports, MagneticBearingsAreNoSprings) {
  RossTable table;
  table.Add(
      "[BearingElement_AMB]\nn = 1\ng0 = 0.001\ni0 = [1.0, 1.0,]\nag = 1e-4\nnw = 200\nkp_pid = "
      "1e5\n"
      "kxx = [1e6, 2e6,]\ncxx = [-87551.0, 5.0,]\nfrequency = [0.0, 100.0,]\n"
      "[GearElement_g]\nn = 2\nm = 2.0\nId = 3.0\nIp = 1.0\n");
  const RossRotor r = table.Read();
  EXPECT_TRUE(r.definition.supports.empty());
  ASSERT_EQ(r.magnetic_bearings.size(), 1U);
  const RossMagnet& m = r.magnetic_bearings[0];
  EXPECT_EQ(m.z, 0.5);
  // 4 i0 cos(alpha) mu0 nw^2 ag / (4 g0^2), as version 2.3 has it
  EXPECT_NEAR(m.current_gain(), 4 * std::cos(kPi / 8) * 4e-7 * kPi * 4e4 * 1e-4 / 4e-6, 1e-9);
  EXPECT_EQ(m.kp, 1e5);
  EXPECT_EQ(r.ignored.size(), 1U);  // the gear's mesh
  EXPECT_EQ(r.definition.disks.size(), 1U);
}

TEST(RossSupports, MistakesAreNamed) {
  RossTable no_mass;
  no_mass.Add("[BearingElement_b]\nn = 0\nn_link = 7\nkxx = [1e6,]\ncxx = [0.0,]\n");
  EXPECT_THROW(no_mass.Read(), InputError);
  RossTable falling;
  falling.Add(
      "[BearingElement_b]\nn = 0\nfrequency = [10.0, 5.0,]\nkxx = [1e6, 2e6,]\ncxx = [0.0, "
      "0.0,]\n");
  EXPECT_THROW(falling.Read(), InputError);
}

// Straight lines and lumped masses are ours: ROSS is told, the reader warned.
TEST(RossSupports, WhatRossCannotSayIsNamed) {
  RossTable table;
  BeamDefinition d = table.Read().definition;
  d.theory.mass = MassKind::kLumped;
  SpringSupport s = IsotropicSupport(0.5, 1e6, 0);
  s.name = "film";
  s.speed = {0, 10, 20};
  s.table.assign(3, s);
  s.table[1].kxx = 2e6;
  d.supports = {s};
  EXPECT_EQ(WriteRoss(d, table.path()).size(), 2U);
}

// E and G of a steel that is none: the Poisson ratio is told and kept to 1/2, but not of sleeves,
// which carry nothing: below 2 kPa.
TEST(RossMaterial, APoissonRatioThatCannotBeIsTold) {
  for (const auto& [E, told] : {std::pair{2e11, true}, {2e3, true}, {1.9e3, false}}) {
    RossTable table;
    table.Add(
        "[ShaftElement_9]\nL = 0.5\nidl = 0.02\nodl = 0.03\nn = 0\naxial_force = 0\n"
        "torque = 0\n[ShaftElement_9.material]\nrho = 7800.0\nE = " +
        std::to_string(E) + "\nG_s = " + std::to_string(E / 4) + "\n");
    const RossRotor r = table.Read();
    std::string all;
    for (const std::string& text : r.ignored) all += text;
    EXPECT_EQ(all.find("Poisson's ratio 1 of ") != std::string::npos, told) << E << ": " << all;
    for (const ShaftSection& s : r.definition.sections)
      EXPECT_EQ(s.stiff, told || s.material.E > 2e3) << E << " " << s.material.E;
  }
}

}  // namespace
}  // namespace ambrig
