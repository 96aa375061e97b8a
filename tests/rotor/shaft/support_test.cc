// Supports over speed, on housings, with masses; axial force: against closed forms.
#include "rotor/shaft/support.h"

#include <gtest/gtest.h>

#include "core/math/constants.h"
#include "rotor/shaft/rotor_modes.h"
#include "rotor/shaft/shaft_file.h"

namespace ambrig {
namespace {

BeamDefinition SupportedBar(int elements) {
  BeamDefinition d;
  ShaftSection s;
  s.length = 1;
  s.od = s.od_right = 0.02;
  s.material = {2.1e11, 7800, 0.3};
  d.sections = {s};
  d.elements_per_section = elements;
  d.theory.shear = d.theory.rotary_inertia = d.theory.gyroscopic = false;
  return d;
}

// A cubic through the rows of a cubic is that cubic (not-a-knot), a line through a line's rows that
// line.
TEST(Support, TablesReproducePolynomials) {
  const std::vector<double> at = {0, 100, 250, 300, 600};
  const auto cubic = [](double x) { return 3e6 + 2e3 * x - 7 * x * x + 0.02 * x * x * x; };
  std::vector<double> y, line;
  for (double x : at) y.push_back(cubic(x)), line.push_back(5 - 2 * x);
  for (double x : {10.0, 170.0, 299.0, 451.0}) {
    EXPECT_NEAR(OnTable(at, y, x, true), cubic(x), 1e-9 * 3e6);
    EXPECT_NEAR(OnTable(at, line, x, false), 5 - 2 * x, 1e-9);
  }
  EXPECT_EQ(OnTable(at, y, 1e4, true), y.back());
}

// A pinned Euler beam under tension N: w_n² = (n pi/L)^4 EI/(rho A) (1 + N L²/(n² pi² EI)).
TEST(Support, TensionOfAPinnedBeam) {
  BeamDefinition d = SupportedBar(16);
  const double EI = 2.1e11 * kPi / 64 * std::pow(0.02, 4), rhoA = 7800 * kPi / 4 * 4e-4;
  for (const double N : {2e4, -0.5 * kPi * kPi * EI}) {
    d.sections[0].axial_force = N;
    const BeamRotor beam = BuildBeam(d);
    BeamRotor stiffened = beam;
    stiffened.K += beam.tension;
    const auto modes = HeldModes(stiffened, {0, 32}, 2);
    for (int n = 1; n <= 2; ++n) {
      const double w =
          std::pow(n * kPi, 2) * std::sqrt(EI / rhoA) * std::sqrt(1 + N / (n * n * kPi * kPi * EI));
      EXPECT_NEAR(modes.omega(n - 1) / w, 1, 2e-5) << N << " " << n;
    }
  }
}

// A stiff bar on two springs that stand on one heavy block each, which stands on a spring: two
// masses in series.
TEST(Support, ChainOfTwoMasses) {
  BeamDefinition d = SupportedBar(2);
  d.sections[0].material.E = 1e13;
  const double m = 7800 * kPi / 4 * 4e-4, k = 10, K = 40, M = 1.5;
  for (const double z : {0.0, 1.0}) {
    const std::string name = z == 0 ? "left" : "right";
    d.housings.push_back({name, M, M, M});
    SpringSupport on = IsotropicSupport(z, k, 0), ground = IsotropicSupport(kRequired, K, 0);
    on.on = ground.carries = name;
    d.supports.push_back(on);
    d.supports.push_back(ground);
  }
  const auto modes = WhirlModes(Assemble(BuildBeam(d)), 0, 40);
  // bounce: m/2 on k on M on K; the bar bends by (w / w_bending)², 5e-7, of it
  const double a = k / (m / 2), b = (k + K) / M, c = k * k / (m / 2 * M);
  for (const double sign : {-1.0, 1.0}) {
    const double w = std::sqrt((a + b) / 2 + sign * std::sqrt(std::pow((a - b) / 2, 2) + c));
    double nearest = 1e300;
    for (const WhirlMode& mode : modes)
      if (std::abs(mode.omega_d - w) < std::abs(nearest - w)) nearest = mode.omega_d;
    EXPECT_NEAR(nearest / w, 1, 1e-5);
  }
}

TEST(Support, FileKeepsEveryCoefficient) {
  const TomlTable root = TomlTable::FromText(R"(
[rotor]
kind = "beam"
[[rotor.section]]
length = 1.0
od = 0.02
material = "steel"
axial_force = 1200.0
[[rotor.support]]
name = "seal"
z = 0.25
speed = [0.0, 100.0, 400.0]
interpolation = "cubic"
kxx = [1e6, 2e6, 2.5e6]
kxy = [0.0, 1e5, 3e5]
mxx = 2.0
on = "casing"
[[rotor.support]]
carries = "casing"
k = 1e8
kzz = 3e7
[[rotor.housing]]
name = "casing"
mass = 40.0
[[rotor.point_mass]]
name = "ring"
z = 0.75
mass = 1.5
)",
                                             "shaft.toml");
  BeamFile file = ReadBeam(*root.Table("rotor"));
  const TomlTable again = TomlTable::FromText(BeamText(file), "again.toml");
  const BeamDefinition d = ReadBeam(*again.Table("rotor")).definition;
  ASSERT_EQ(d.supports.size(), 2U);
  ASSERT_EQ(d.masses.size(), 1U);
  EXPECT_EQ(d.masses[0].name, "ring");
  EXPECT_EQ(d.masses[0].z, 0.75);
  EXPECT_EQ(d.masses[0].mass_y, 1.5);
  EXPECT_EQ(d.sections[0].axial_force, 1200);
  EXPECT_EQ(d.supports[0].on, "casing");
  EXPECT_TRUE(d.supports[0].cubic);
  EXPECT_EQ(d.supports[0].At(100).kxy, 1e5);
  EXPECT_EQ(d.supports[0].At(50).mxx, 2);
  EXPECT_EQ(d.supports[1].kzz, 3e7);
  EXPECT_EQ(d.supports[1].kyy, 1e8);
  EXPECT_EQ(d.housings[0].mass_y, 40);
  EXPECT_EQ(d.masses[0].mass_x, 1.5);
  const LinearRotor slow = Assemble(BuildBeam(d), 0), fast = Assemble(BuildBeam(d), 400);
  EXPECT_NEAR((fast.K - slow.K).cwiseAbs().maxCoeff(), 1.5e6, 1e-3);
  EXPECT_NEAR((fast.M - slow.M).cwiseAbs().maxCoeff(), 0, 1e-12);
}

TEST(Support, NamesAHousingThatIsMissing) {
  const TomlTable root = TomlTable::FromText(
      "[rotor]\nkind = \"beam\"\n[[rotor.section]]\nlength = 1.0\nod = 0.02\nmaterial = \"steel\"\n"
      "[[rotor.support]]\nz = 0.0\nk = 1e6\non = \"wall\"\n",
      "shaft.toml");
  EXPECT_THROW(ReadBeam(*root.Table("rotor")), InputError);
}

}  // namespace
}  // namespace ambrig
