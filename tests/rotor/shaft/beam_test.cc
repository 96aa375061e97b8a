#include "rotor/shaft/beam.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/constants.h"
#include "rotor/shaft/rotor_modes.h"
#include "tests/rotor/shaft/uniform_shaft.h"

namespace ambrig {
namespace {

// cos(b) cosh(b) = -1. Cubic elements give w too high by (b h / L)^4 / 1440, so b by half of that
// (leading term; twice it is allowed for the next).
TEST(BeamElement, CantileverRoots) {
  const int n = 9;
  BeamDefinition d = UniformShaft(1, 0.01, n);
  d.theory = EulerBernoulli();
  const PlaneModes modes = HeldModes(BuildBeam(d), {0, 1}, 5);
  const double exact[] = {1.875104068711961, 4.694091132974175, 7.854757438237613,
                          10.99554073487547, 14.13716839104647};
  const double unit = std::sqrt(kSteel.E * Inertia(0.01) / (kSteel.rho * Area(0.01)));
  for (int i = 0; i < 5; ++i) {
    const double root = std::sqrt(modes.omega(i) / unit);
    EXPECT_GT(root, exact[i] - 1e-8);
    EXPECT_LT(root - exact[i], 2 * exact[i] * std::pow(exact[i] / n, 4) / 2880 + 1e-8);
  }
}

// Solid rod and thin tube as the two papers print them.
TEST(BeamElement, ShearCoefficientLimits) {
  const double nu = 0.3;
  const auto cowper = ShearCoefficient::kCowper, hutchinson = ShearCoefficient::kHutchinson;
  EXPECT_NEAR(ShearCoefficientOf(cowper, 0, nu), 6 * (1 + nu) / (7 + 6 * nu), 1e-15);
  EXPECT_NEAR(ShearCoefficientOf(cowper, 1, nu), 2 * (1 + nu) / (4 + 3 * nu), 1e-15);
  EXPECT_NEAR(ShearCoefficientOf(hutchinson, 0, nu),
              6 * (1 + nu) * (1 + nu) / (7 + 12 * nu + 4 * nu * nu), 1e-15);
  EXPECT_NEAR(ShearCoefficientOf(hutchinson, 1, nu), (1 + nu) / (2 + nu), 1e-15);
}

/// Pinned-pinned Timoshenko shaft, mode k: rho² I/(kappa G) w⁴ - (rho A + rho I a² (1 + E/(kappa
/// G))) w² + E I a⁴ = 0, a = k pi / L; without shear kappa G is infinite.
double PinnedFrequency(int k, double length, double d, bool shear, bool rotary) {
  const double a2 = std::pow(k * kPi / length, 2),
               kG = shear ? ShearCoefficientOf(ShearCoefficient::kCowper, 0, kSteel.nu) *
                                kSteel.shear_modulus()
                          : 1e30;
  const double I = Inertia(d), rI = rotary ? kSteel.rho * I : 0;
  const double A = rI * kSteel.rho / kG;
  const double B = kSteel.rho * Area(d) + rI * a2 + kSteel.rho * I * a2 * kSteel.E / kG;
  const double C = kSteel.E * I * a2 * a2;
  return std::sqrt(2 * C / (B + std::sqrt(B * B - 4 * A * C)));
}

double PinnedError(int elements, const BeamTheory& theory, int k) {
  const double length = 1, od = 0.1;
  BeamDefinition d = UniformShaft(length, od, elements);
  d.theory = theory;
  const PlaneModes modes = HeldModes(BuildBeam(d), {0, 2 * elements}, k);
  const double exact = PinnedFrequency(k, length, od, theory.shear, theory.rotary_inertia);
  return modes.omega(k - 1) / exact - 1;
}

TEST(BeamElement, FrequencyConvergesWithFourthOrder) {
  BeamTheory rayleigh;
  rayleigh.shear = false;
  for (const BeamTheory& theory : {EulerBernoulli(), rayleigh}) {
    const double e8 = PinnedError(8, theory, 2), e16 = PinnedError(16, theory, 2);
    EXPECT_NEAR(std::log2(e8 / e16), 4, 0.1);
    EXPECT_NEAR(std::log2(e16 / PinnedError(32, theory, 2)), 4, 0.1);
    EXPECT_GT(e8, 0);  // consistent mass: from above
  }
  const double kh = 2 * kPi / 16;
  EXPECT_NEAR(PinnedError(16, EulerBernoulli(), 2), std::pow(kh, 4) / 1440,
              0.05 * std::pow(kh, 4) / 1440);
}

// With shear the static shapes miss, inside an element, the shear force q s of the inertia load
// q = rho A w² W and the moment m s of m = rho I w² Psi. Their energies, q² h²/(12 kappa G A) and
// m² h²/(12 E I) against w² (rho A W² + rho I Psi²), are a second order term, small for slender
// shafts.
TEST(BeamElement, ShearAddsTheDerivedSecondOrderTerm) {
  const double d = 0.1, k = 2 * kPi, A = Area(d), I = Inertia(d), rho = kSteel.rho;
  const double kGA =
      ShearCoefficientOf(ShearCoefficient::kCowper, 0, kSteel.nu) * kSteel.shear_modulus() * A;
  const double w2 = std::pow(PinnedFrequency(2, 1, d, true, true), 2), EI = kSteel.E * I;
  const double tilt = kGA * k / (kGA + EI * k * k - rho * I * w2);  // Psi / W
  const double energy = std::pow(rho * A * w2, 2) / kGA + std::pow(rho * I * w2 * tilt, 2) / EI;
  const double per_h2 = energy / 12 / (w2 * (rho * A + rho * I * tilt * tilt)) / 2;  // of w, not w²
  const double fourth = std::pow(k, 4) / 1440;
  for (int n : {32, 64}) {
    const double h = 1.0 / n, expected = per_h2 * h * h;
    EXPECT_NEAR(PinnedError(n, BeamTheory{}, 2), expected, 2 * fourth * std::pow(h, 4)) << n;
    EXPECT_GT(expected, 4 * fourth * std::pow(h, 4));  // so that the line above says something
  }
}

TEST(BeamElement, LumpedMassConvergesToTheSameFrequency) {
  BeamTheory lumped;
  lumped.mass = MassKind::kLumped;
  const double e16 = PinnedError(16, lumped, 2), e32 = PinnedError(32, lumped, 2);
  EXPECT_LT(e16, 0);  // from below
  EXPECT_NEAR(std::log2(e16 / e32), 2, 0.1);
}

// Cone from d1 (clamped) to d2, end load P: bending P L³/(3 E I1) d1/d2, shear 4 P L/(pi kappa G d1
// d2).
TEST(BeamElement, OneTaperedElementIsStaticallyExact) {
  const double d1 = 0.04, d2 = 0.03, L = 0.2, P = 1000;
  BeamDefinition d = UniformShaft(L, d1, 1);
  d.sections[0].od_right = d2;
  const BeamRotor r = BuildBeam(d);
  const Eigen::Vector2d tip = r.K.bottomRightCorner<2, 2>().inverse() * Eigen::Vector2d(P, 0);
  const double kG =
      ShearCoefficientOf(ShearCoefficient::kCowper, 0, kSteel.nu) * kSteel.shear_modulus();
  const double exact =
      P * L * L * L / (3 * kSteel.E * Inertia(d1)) * d1 / d2 + 4 * P * L / (kPi * kG * d1 * d2);
  EXPECT_NEAR(tip(0), exact, 1e-9 * exact);
  // Truncated cone: volume pi L (d1² + d1 d2 + d2²)/12.
  EXPECT_NEAR(Totals(r).mass, kSteel.rho * kPi * L / 12 * (d1 * d1 + d1 * d2 + d2 * d2), 1e-12);
}

TEST(BeamElement, LayersOfOneBarAreTheBar) {
  BeamDefinition whole = UniformShaft(0.5, 0.05, 3), layered = whole;
  whole.theory.shear = layered.theory.shear = false;  // kappa of a tube is not that of its bar
  layered.sections = {Uniform(0.5, 0.03), Uniform(0.5, 0.05)};
  layered.sections[1].id = layered.sections[1].id_right = 0.03;
  const BeamRotor a = BuildBeam(whole), b = BuildBeam(layered);
  EXPECT_LT((a.K - b.K).norm(), 1e-12 * a.K.norm());
  EXPECT_LT((a.M - b.M).norm(), 1e-12 * a.M.norm());
  EXPECT_LT((a.J - b.J).norm(), 1e-12 * a.J.norm());
}

TEST(BeamElement, SleeveAddsMassAndNoStiffness) {
  BeamDefinition plain = UniformShaft(0.5, 0.03, 5), sleeved = plain;
  ShaftSection sleeve = Uniform(0.2, 0.05);
  sleeve.z0 = 0.1;
  sleeve.id = sleeve.id_right = 0.03;
  sleeve.material.rho = 7650;
  sleeve.stiff = false;
  sleeved.sections.push_back(sleeve);
  const BeamRotor a = BuildBeam(plain), b = BuildBeam(sleeved);
  ASSERT_EQ(a.z, b.z);  // 0.1 and 0.3 are nodes anyway
  EXPECT_EQ(a.K, b.K);
  const double mass = 7650 * (Area(0.05) - Area(0.03)) * 0.2;
  EXPECT_NEAR(Totals(b).mass - Totals(a).mass, mass, 1e-12);
  EXPECT_LT(FreeModes(b, 1).omega(0), FreeModes(a, 1).omega(0));
}

}  // namespace
}  // namespace ambrig
