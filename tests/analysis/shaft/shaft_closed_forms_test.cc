// A shaft on supports against closed forms: beam statics, rods, Jeffcott's rotor.
#include <gtest/gtest.h>

#include "analysis/shaft/shaft_analysis.h"
#include "core/math/constants.h"

namespace ambrig {
namespace {

constexpr double kE = 2.1e11, kRho = 7800, kNu = 0.3, kD = 0.03, kL = 1.2;

BeamDefinition UniformBar(int elements) {
  BeamDefinition d;
  ShaftSection s;
  s.length = kL;
  s.od = s.od_right = kD;
  s.material = {kE, kRho, kNu};
  d.sections = {s};
  d.elements_per_section = elements;
  return d;
}

/// A stiff bar with a disk, m = 10.15 kg together (Totals), in the middle on two springs of k/2 and
/// dampers of c/2 each.
BeamDefinition Jeffcott(double k, double c) {
  BeamDefinition d = UniformBar(2);
  d.sections[0].material = {1e13, 1, kNu};
  d.sections[0].od = d.sections[0].od_right = 0.4;
  d.disks.push_back({kL / 2, 10, 0.5, 0.1, "disk"});
  for (const double z : {0.0, kL}) d.supports.push_back(IsotropicSupport(z, k / 2, c / 2));
  return d;
}

// Uniform beam on two supports: w L/2 each, w L²/8 in the middle, 5 w L⁴/(384 EI) without shear.
TEST(ShaftStatics, SimplySupportedBeam) {
  BeamDefinition d = UniformBar(8);
  d.theory.shear = false;
  for (const double z : {0.0, kL}) d.supports.push_back(IsotropicSupport(z, 1e12, 0));
  const StaticDeflection s = DeflectUnderWeight(BuildBeam(d), 0, 9.81);
  const double w = 9.81 * kRho * kPi / 4 * kD * kD, EI = kE * kPi / 64 * std::pow(kD, 4);
  ASSERT_TRUE(s.held);
  EXPECT_NEAR(s.weight / (w * kL), 1, 1e-12);
  for (const SupportReaction& r : s.reactions) EXPECT_NEAR(r.fy / (w * kL / 2), 1, 1e-6);
  EXPECT_NEAR(s.y[4] / (-5 * w * std::pow(kL, 4) / (384 * EI)), 1, 1e-6);
  EXPECT_NEAR(s.moment[7] / (w * kL * kL / 8), 1, 1e-6);  // right end of the fourth element
  EXPECT_NEAR(s.shear[0] / (w * kL / 2), 1, 1e-6);
  EXPECT_NEAR(s.moment.front(), 0, 1e-6 * w * kL * kL);
  EXPECT_NEAR(s.x[4], 0, 1e-15);
}

TEST(ShaftStatics, FreeShaftIsNotHeld) {
  EXPECT_FALSE(DeflectUnderWeight(BuildBeam(UniformBar(4)), 0).held);
  BeamDefinition one = UniformBar(4);
  one.supports.push_back(IsotropicSupport(0, 1e7, 0));
  EXPECT_FALSE(DeflectUnderWeight(BuildBeam(one), 0).held);
}

// Free rod: n pi c/L with c = sqrt(E/rho), sqrt(G/rho); the error of quadratic rods falls with h⁴.
TEST(ShaftRods, FreeRod) {
  const BeamRotor coarse = BuildBeam(UniformBar(4)), fine = BuildBeam(UniformBar(8));
  const double axial = std::sqrt(kE / kRho), twist = std::sqrt(kE / (2 * (1 + kNu)) / kRho);
  for (int n = 1; n <= 3; ++n) {
    const double exact = n * kPi * axial / kL;
    const double e4 = AxialModes(coarse, 0, 3)[n - 1].omega / exact - 1,
                 e8 = AxialModes(fine, 0, 3)[n - 1].omega / exact - 1;
    const double leading = std::pow(n * kPi / 8, 4) / 1440;  // (k h)⁴/1440 of quadratic rods
    EXPECT_NEAR(e8 / leading, 1, 0.15);
    EXPECT_GT(std::log2(e4 / e8), 3.5) << n;
    EXPECT_NEAR(TorsionalModes(fine, 0, 3)[n - 1].omega / (n * kPi * twist / kL), 1 + leading,
                0.15 * leading);
  }
}

// Two heavy disks on a light shaft: omega² = k (1/I1 + 1/I2), k = G J/L.
TEST(ShaftRods, TwoDisksTwist) {
  BeamDefinition d = UniformBar(1);
  d.sections[0].material.rho = 1e-2;
  d.disks = {{0, 5, 1, 0.3, "a"}, {kL, 5, 1, 0.7, "b"}};
  const double k = kE / (2 * (1 + kNu)) * kPi / 32 * std::pow(kD, 4) / kL;
  EXPECT_NEAR(TorsionalModes(BuildBeam(d), 0, 1)[0].omega / std::sqrt(k * (1 / 0.3 + 1 / 0.7)), 1,
              1e-8);
}

// A stiff shaft of mass m on kzz that stands on a housing M on K: two masses in series.
TEST(ShaftRods, AxialChain) {
  BeamDefinition d = UniformBar(2);
  d.sections[0].material.E = 1e13;
  const double m = kRho * kPi / 4 * kD * kD * kL, k = 1e3, K = 3e3, M = 4;
  d.housings.push_back({"casing", 1, 1, M});
  SpringSupport on, ground;
  on.z = 0;
  on.kzz = k;
  on.on = ground.carries = "casing";
  ground.kzz = K;
  d.supports = {on, ground};
  const auto modes = AxialModes(BuildBeam(d), 0, 2);
  const double a = k / m, b = (k + K) / M, c = k * k / (m * M);
  for (const int sign : {-1, 1}) {
    const double w = std::sqrt((a + b) / 2 + sign * std::sqrt(std::pow((a - b) / 2, 2) + c));
    EXPECT_NEAR(modes[sign < 0 ? 0 : 1].omega / w, 1, 1e-5);
  }
}

// x = u Omega²/(k - m Omega² + i c Omega); forward circles, y a quarter turn behind x.
TEST(ShaftUnbalance, JeffcottRotor) {
  const double k = 1e6, c = 150, u = 5e-5;
  const BeamRotor beam = BuildBeam(Jeffcott(k, c));
  const double m = Totals(beam).mass;
  std::vector<double> speeds;
  for (int n = 1; n <= 400; ++n) speeds.push_back(1.5 * n);
  const auto sweep =
      SweepShaft(beam, {{"one", {{kL / 2, u, 0.7}}}}, {{"disk", kL / 2, ""}}, speeds).front();
  for (std::size_t n = 0; n < speeds.size(); ++n) {
    const double w = speeds[n];
    const std::complex<double> exact =
        std::polar(u * w * w, 0.7) / std::complex<double>(k - m * w * w, c * w);
    // the bar bends by k (L³/(48 EI) + L/(4 kappa G A)) = 4e-6 of the motion, near resonance Q = 21
    // times that
    EXPECT_LT(std::abs(sweep.probes[0].x[n] - exact), 1e-4 * std::abs(exact)) << w;
    EXPECT_LT(std::abs(sweep.probes[0].y[n] + std::complex<double>(0, 1) * exact),
              1e-4 * std::abs(exact));
    const std::complex<double> force = -0.5 * std::complex<double>(k, c * w) * exact;
    EXPECT_LT(std::abs(sweep.forces[0].x[n] - force), 1e-4 * std::abs(force));
  }
  // Peak at omega_n/sqrt(1 - 2 zeta²), AF = 1/(2 zeta) to first order in zeta.
  const double wn = std::sqrt(k / m), zeta = c / (2 * m * wn);
  ASSERT_EQ(sweep.probes[0].peaks.size(), 1U);
  EXPECT_NEAR(sweep.probes[0].peaks[0].speed / (wn / std::sqrt(1 - 2 * zeta * zeta)), 1, 1e-4);
  EXPECT_NEAR(sweep.probes[0].peaks[0].amplification * 2 * zeta, 1, 0.02);
}

TEST(ShaftUnbalance, AngleOfTheLongAxis) {
  EXPECT_NEAR(NodalAngle({1, 0}, {1, 0}), kPi / 4, 1e-12);
  EXPECT_NEAR(NodalAngle({2, 0}, {0, -1}), 0, 1e-12);                 // forward ellipse along x
  EXPECT_NEAR(std::abs(NodalAngle({1, 0}, {0, 2})), kPi / 2, 1e-12);  // backward along y
}

// ISO 21940-11: U = m G/Omega in all; API 617: 6350 W/N g mm a plane.
TEST(ShaftUnbalance, GradesAndApi) {
  const BeamRotor beam = BuildBeam(Jeffcott(1e6, 100));
  const StaticDeflection weight = DeflectUnderWeight(beam, 0);
  const double speed = 500;
  const auto grade = GradeUnbalance(beam, weight, 2.5e-3, speed);
  EXPECT_NEAR(grade[0].planes[0].magnitude + grade[0].planes[1].magnitude,
              Totals(beam).mass * 2.5e-3 / speed, 1e-9);
  EXPECT_NEAR(grade[1].planes[1].phase, kPi, 1e-12);
  const auto api = ApiUnbalance(beam, weight, speed);
  EXPECT_NEAR(api[0].planes[0].magnitude / (6350e-6 * Totals(beam).mass / 2 / (speed * 30 / kPi)),
              1, 1e-4);
  EXPECT_NEAR(api[2].planes[0].z, kL / 2, 1e-12);
}

// Jeffcott with cross-coupling q: m s² + c s + k ∓ i q = 0 has its limit at q = c sqrt(k/m).
TEST(ShaftCoupling, JeffcottLimit) {
  const double k = 1e6, c = 150;
  const BeamRotor beam = BuildBeam(Jeffcott(k, c));
  const double m = Totals(beam).mass, limit = c * std::sqrt(k / m);
  const Level1 l = AssessCoupling(beam, 300, 4, {kL / 2, limit / 3});
  ASSERT_TRUE(l.found);
  EXPECT_NEAR(l.limit / limit, 1, 1e-3);
  EXPECT_NEAR(l.ratio(), 3, 3e-3);
  const double zeta = c / (2 * std::sqrt(k * m));
  EXPECT_NEAR(l.log_decrement.front() / (2 * kPi * zeta), 1 - l.q.front() / limit, 1e-3);
  EXPECT_NEAR(AlfordCoupling(1e6, 1000, 0.5, 0.02, 1.5), 3 * 1e6 / 1000 / 0.01 * 1.5, 1e-6);
}

// Damped critical speed of the bounce: Im s = sqrt(k/m - (c/2m)²), whatever the speed.
TEST(ShaftCampbell, JeffcottCritical) {
  const double k = 1e6, c = 400;
  const BeamRotor beam = BuildBeam(Jeffcott(k, c));
  const double m = Totals(beam).mass;
  std::vector<double> speeds;
  for (int n = 0; n <= 20; ++n) speeds.push_back(30 * n);
  const ShaftCampbell found = FollowShaft(beam, ShapesOfBeam(beam, 300, 4), speeds, 4);
  EXPECT_TRUE(found.stable());
  const double exact = std::sqrt(k / m - std::pow(c / (2 * m), 2));
  bool some = false;
  for (const DampedCritical& at : found.criticals)
    some = some || std::abs(at.speed / exact - 1) < 1e-4;
  EXPECT_TRUE(some);
}

// Supports whose table rises with the square of the speed: the critical speed is where they agree.
TEST(ShaftCampbell, TablesCountAtTheirSpeed) {
  BeamDefinition d = Jeffcott(1e6, 100);
  for (SpringSupport& s : d.supports) {
    for (int n = 0; n <= 6; ++n) {
      s.speed.push_back(100.0 * n);
      SupportCoefficients row = s;
      row.kxx = row.kyy = 2.5e5 + 2.5 * std::pow(100.0 * n, 2);
      s.table.push_back(row);
    }
    s.cubic = true;
  }
  const BeamRotor beam = BuildBeam(d);
  std::vector<double> speeds;
  for (int n = 0; n <= 12; ++n) speeds.push_back(50 * n);
  const ShaftCampbell found = FollowShaft(beam, ShapesOfBeam(beam, 300, 4), speeds, 4);
  const double exact =
      std::sqrt(5e5 / (Totals(beam).mass - 5));  // k(w) = 5e5 + 5 w² = m w², less 5e-6 for damping
  double nearest = 0;
  for (const DampedCritical& at : found.criticals)
    if (std::abs(at.speed - exact) < std::abs(nearest - exact)) nearest = at.speed;
  EXPECT_NEAR(nearest / exact, 1, 1e-3);
}

}  // namespace
}  // namespace ambrig
