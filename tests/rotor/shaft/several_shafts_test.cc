// Shafts inside one another and in line, torque, and layers apart.
#include "rotor/shaft/several_shafts.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "rotor/shaft/ross_file.h"
#include "rotor/shaft/rotor_modes.h"
#include "rotor/shaft/shaft_file.h"
#include "tests/rotor/shaft/uniform_shaft.h"

namespace ambrig {
namespace {

struct TwoShaftsFile {
  explicit TwoShaftsFile(const std::string& ending)
      : path((std::filesystem::path(::testing::TempDir()) /
              ("several_shafts_" + std::to_string(::getpid()) + ending))
                 .string()) {}
  ~TwoShaftsFile() { std::filesystem::remove(path); }
  BeamFile Read() const {
    bool ross = false;
    return ReadShaft(path, &ross);
  }
  std::string path;
};

std::vector<double> LateralFrequencies(const BeamDefinition& d, int count) {
  std::vector<double> out;
  for (const WhirlMode& m : WhirlModes(Assemble(BuildBeam(d)), 0, count)) out.push_back(m.omega_d);
  return out;
}

constexpr const char* kCoaxial = R"([rotor]
kind = "beam"
elements_per_section = 3
[[rotor.shaft]]
name = "inner"
[[rotor.shaft]]
name = "outer"
[[rotor.section]]
shaft = "inner"
length = 1.0
od = 0.05
E = 1e13
rho = 1000.0
[[rotor.section]]
shaft = "outer"
z0 = 0.25
length = 0.5
od = 0.2
id = 0.19
E = 1e13
rho = 1000.0
[[rotor.disk]]
name = "fan"
shaft = "outer"
z = 0.5
mass = 1.0
inertia_diametral = 1e-3
inertia_polar = 2e-3
[[rotor.support]]
name = "left"
z = 0.0
k = 1e11
[[rotor.support]]
name = "right"
z = 1.0
k = 1e11
[[rotor.support]]
name = "front"
shaft = "inner"
z = 0.25
to = "outer"
k = 1e3
[[rotor.support]]
name = "back"
shaft = "outer"
z = 0.75
to = "inner"
k = 1e3
)";

// A stiff tube on two springs inside which a stiff shaft stands: it bounces at sqrt(2 k / m) and
// tilts at sqrt(2 k (L/2)^2 / I). The shafts' own bending, some 1e7 N/m, gives way by 1e-4 of the
// springs.
TEST(SeveralShafts, ATubeOnSpringsAroundAShaft) {
  TwoShaftsFile file(".toml");
  std::ofstream(file.path) << kCoaxial;
  const BeamFile read = file.Read();
  const double area = kPi / 4 * (0.04 - 0.0361), tube = 1000 * area * 0.5;
  const double tilt = tube * (0.25 / 12 + (0.01 + 0.19 * 0.19 / 4) / 4) + 1e-3;
  const auto found = LateralFrequencies(read.definition, 4);
  EXPECT_NEAR(found[0] / std::sqrt(2e3 / (tube + 1)), 1, 2e-4);
  EXPECT_NEAR(found[2] / std::sqrt(2e3 / 16 / tilt), 1, 2e-4);
  EXPECT_NEAR(Totals(BuildBeam(read.definition)).z_com, 0.5, 1e-12);
  ASSERT_EQ(read.planes.size(), 1U);
  EXPECT_EQ(PlaceText(read.definition.shafts, read.planes[0].z), "z = 0.5 m of outer");
}

TEST(SeveralShafts, OurFileAndRossKeepThem) {
  TwoShaftsFile file(".toml"), ross(".json");
  std::ofstream(file.path) << kCoaxial;
  const BeamFile read = file.Read();
  const auto before = LateralFrequencies(read.definition, 8);
  WriteBeam(read, file.path);
  EXPECT_TRUE(WriteRoss(read.definition, ross.path).empty());
  for (const BeamDefinition& d : {file.Read().definition, ReadRoss(ross.path).definition})
    for (std::size_t k = 0; k < 8; ++k)
      EXPECT_NEAR(LateralFrequencies(d, 8)[k] / before[k], 1, 1e-9);
}

/// A shaft of 1 m, or two halves of it joined by a coupling.
BeamDefinition Halves(double stiffness) {
  BeamDefinition d = UniformShaft(0.5, 0.05, 3);
  d.sections.push_back(Uniform(0.5, 0.05));
  d.sections[1].z0 = 0.5;
  d.sections[0].shaft = "a";
  d.sections[1].shaft = "b";
  d.shafts = {{"a", 0, 0}, {"b", 0, 0}};
  for (const double z : {0.0, 1.0}) {
    d.supports.push_back(IsotropicSupport(z, 1e7, 0));
    d.supports.back().shaft = z == 0 ? "a" : "b";
  }
  SpringSupport joint = IsotropicSupport(0.5, stiffness, 0);
  joint.krx = joint.kry = joint.krz = joint.kzz = stiffness;
  joint.name = "joint";
  joint.to_z = 0.5;
  joint.shaft = "a";
  joint.to = "b";
  d.supports.push_back(joint);
  LayOutShafts(d);
  return d;
}

// A coupling gives way in series with the shaft: 1e13 against some 1e7 N/m.
TEST(SeveralShafts, AStiffCouplingMakesOneShaftOfTwo) {
  BeamDefinition whole = UniformShaft(1, 0.05, 6);
  for (const double z : {0.0, 1.0}) whole.supports.push_back(IsotropicSupport(z, 1e7, 0));
  const auto one = LateralFrequencies(whole, 8), two = LateralFrequencies(Halves(1e13), 8);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(two[k] / one[k], 1, 2e-6);
  EXPECT_LT(LateralFrequencies(Halves(1e5), 8)[0], 0.8 * one[0]);
  TwoShaftsFile ross(".toml");
  EXPECT_TRUE(WriteRoss(Halves(1e5), ross.path).empty());
  const RossRotor back = ReadRoss(ross.path);
  EXPECT_TRUE(back.ignored.empty());
  ASSERT_EQ(back.definition.supports.size(), 3U);
  for (std::size_t k = 0; k < 8; ++k)
    EXPECT_NEAR(LateralFrequencies(back.definition, 8)[k] / LateralFrequencies(Halves(1e5), 8)[k],
                1, 1e-9);
}

TEST(SeveralShafts, PlacesOffAShaftAreNamed) {
  BeamDefinition d = Halves(1e5);
  d.stations.push_back(0.5 * (d.shafts[1].start + 0.5));  // in the gap between them
  EXPECT_THROW(BuildBeam(d), InputError);
}

/// The least torque at which a pinned shaft buckles, over E I / L.
double BucklingTorque(int elements) {
  const double length = 1, od = 0.02;
  BeamDefinition d = UniformShaft(length, od, elements);
  d.theory = EulerBernoulli();
  const double unit = kSteel.E * Inertia(od) / length;
  for (const double z : {0.0, length}) d.supports.push_back(IsotropicSupport(z, 1e6 * unit, 0));
  const Eigen::MatrixXd K = Assemble(BuildBeam(d)).K;
  d.sections[0].torque = unit;
  const Eigen::MatrixXd torque = Assemble(BuildBeam(d)).K - K;
  double least = 1e30;
  const Eigen::VectorXcd all = K.fullPivLu().solve(torque).eigenvalues();
  for (const auto& e : all)
    if (std::abs(e.imag()) < 1e-3 * std::abs(e.real()))
      least = std::min(least, 1 / std::abs(e.real()));
  return least;
}

// Greenhill: T = 2 pi E I / L, a shape of wave number k = 2 pi / L; cubic elements err by (k
// h)⁴/720.
TEST(ShaftTorque, BucklesAPinnedShaft) {
  const double coarse = std::abs(BucklingTorque(4) / (2 * kPi) - 1),
               fine = std::abs(BucklingTorque(8) / (2 * kPi) - 1);
  EXPECT_NEAR(fine / (std::pow(2 * kPi / 8, 4) / 720), 1, 0.1);
  EXPECT_GT(std::log2(coarse / fine), 3.5);
}

// Two tubes inside one another bend as one without shear, whether they share the inside of an
// element or not; with shear those that share its ends alone give way more: nothing holds them
// together between.
TEST(SeparateLayers, AreElementsOfTheirOwn) {
  BeamDefinition d = UniformShaft(1, 0.1, 4);
  d.sections[0].id = d.sections[0].id_right = 0.05;
  d.sections.push_back(Uniform(1, 0.05));
  const auto frequency = [&](bool separate, bool shear) {
    d.theory = shear ? BeamTheory{} : EulerBernoulli();
    d.theory.separate_layers = separate;
    return FreeModes(BuildBeam(d), 1).omega(0);
  };
  EXPECT_NEAR(frequency(true, false) / frequency(false, false), 1, 1e-9);
  EXPECT_LT(frequency(true, true), frequency(false, true) * (1 - 1e-6));
}

}  // namespace
}  // namespace ambrig
