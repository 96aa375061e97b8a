#include <gtest/gtest.h>

#include <cmath>

#include "core/math/constants.h"
#include "rotor/shaft/beam.h"
#include "rotor/shaft/rotor_modes.h"

namespace ambrig {
namespace {

const Material kSteel{2.1e11, 7850, 0.3};

ShaftSection Uniform(double length, double od) {
  ShaftSection s;
  s.length = length;
  s.od = s.od_right = od;
  s.material = kSteel;
  return s;
}

BeamDefinition UniformShaft(double length, double od, int elements) {
  BeamDefinition d;
  d.sections = {Uniform(length, od)};
  d.elements_per_section = elements;
  return d;
}

BeamTheory EulerBernoulli() {
  BeamTheory t;
  t.shear = t.rotary_inertia = false;
  return t;
}

double Area(double d) { return kPi / 4 * d * d; }
double Inertia(double d) { return kPi / 64 * std::pow(d, 4); }

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

/// Rigid motions on the matrices give the totals that Totals() sums directly.
TEST(BeamMatrices, RigidMotionsGiveTheTotals) {
  BeamDefinition d = UniformShaft(0.7, 0.04, 4);
  d.sections[0].od_right = 0.06;
  d.sections[0].id = 0.01, d.sections[0].id_right = 0.02;
  d.disks = {{0.2, 3.0, 0.01, 0.018, "disk"}};
  const BeamRotor r = BuildBeam(d);
  const RotorTotals t = Totals(r);
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(r.M.rows()), tilt = shift;
  for (std::size_t i = 0; i < r.z.size(); ++i) {
    shift(2 * i) = 1;
    tilt(2 * i) = r.z[i] - t.z_com;
    tilt(2 * i + 1) = 1;
  }
  EXPECT_NEAR(shift.dot(r.M * shift), t.mass, 1e-10 * t.mass);
  EXPECT_NEAR(shift.dot(r.M * tilt), 0, 1e-10 * t.mass);
  EXPECT_NEAR(tilt.dot(r.M * tilt), t.inertia_transverse, 1e-10 * t.inertia_transverse);
  EXPECT_NEAR(tilt.dot(r.J * tilt), t.inertia_polar, 1e-10 * t.inertia_polar);
  // Neither costs force: against the stiffest entry only rounding stays.
  EXPECT_LT((r.K * shift).norm() + (r.K * tilt).norm(), 1e-11 * r.K.norm());
  // Lumping keeps mass and centre of mass.
  d.theory.mass = MassKind::kLumped;
  const BeamRotor lumped = BuildBeam(d);
  EXPECT_NEAR(shift.dot(lumped.M * shift), t.mass, 1e-10 * t.mass);
  EXPECT_NEAR(shift.dot(lumped.M * tilt), 0, 1e-10 * t.mass);
}

// docs/theory/base_model.md section 1: a free spinning body nutates forward with (Ip/It) Omega.
TEST(BeamMatrices, FreeRotorNutatesLikeARigidBody) {
  BeamDefinition d = UniformShaft(0.3, 0.08, 4);
  d.disks = {{0.15, 12.0, 0.05, 0.09, "disk"}};
  const BeamRotor r = BuildBeam(d);
  const RotorTotals t = Totals(r);
  const double speed = 100, nutation = t.inertia_polar / t.inertia_transverse * speed;
  const auto modes = WhirlModes(Assemble(r), speed, 4);
  // Bending is 100 times faster; it softens the nutation by (nutation / bending)², 1e-4.
  double nearest = 1e9;
  Whirl sense = Whirl::kMixed;
  for (const WhirlMode& m : modes)
    if (std::abs(m.omega_d - nutation) < std::abs(nearest - nutation))
      nearest = m.omega_d, sense = m.sense();
  EXPECT_NEAR(nearest, nutation, 1e-4 * nutation);
  EXPECT_EQ(sense, Whirl::kForward);
}

// Spinning Rayleigh shaft on pins: rho (A + I a²) w² -/+ 2 rho I a² Omega w - E I a⁴ = 0
// forward/backward.
TEST(BeamMatrices, SpinningPinnedShaft) {
  const double L = 1, od = 0.1, speed = 2000, a2 = kPi * kPi / (L * L);
  BeamDefinition d = UniformShaft(L, od, 12);
  d.theory.shear = false;
  d.supports = {IsotropicSupport(0, 1e15, 0), IsotropicSupport(L, 1e15, 0)};
  const auto modes = WhirlModes(Assemble(BuildBeam(d)), speed, 2);
  const double A = kSteel.rho * (Area(od) + Inertia(od) * a2),
               B = 2 * kSteel.rho * Inertia(od) * a2 * speed;
  const double C = kSteel.E * Inertia(od) * a2 * a2;
  const double root = std::sqrt(B * B + 4 * A * C);
  const double tolerance =
      2 * std::pow(kPi / 12, 4) / 1440 + 1e-6;  // mesh; and eps times the 1e15 N/m pin
  EXPECT_NEAR(modes[0].omega_d, (root - B) / (2 * A), tolerance * modes[0].omega_d);
  EXPECT_NEAR(modes[1].omega_d, (root + B) / (2 * A), tolerance * modes[1].omega_d);
  EXPECT_EQ(modes[0].sense(), Whirl::kBackward);
  EXPECT_EQ(modes[1].sense(), Whirl::kForward);
}

// A force at z turns the shaft as Mx = -z fy, My = z fx, and tilts move it by (z beta, -z alpha).
TEST(BeamMatrices, SignsOfTheTilts) {
  const LinearRotor r = Assemble(BuildBeam(UniformShaft(1, 0.05, 1)));
  Eigen::VectorXd alpha = Eigen::VectorXd::Zero(8), beta = alpha;
  alpha(2) = alpha(6) = 1, alpha(5) = -1;  // y(1) = -z alpha
  beta(3) = beta(7) = 1, beta(4) = 1;      // x(1) = +z beta
  EXPECT_LT((r.K * alpha).norm(), 1e-11 * r.K.norm());
  EXPECT_LT((r.K * beta).norm(), 1e-11 * r.K.norm());
  // It alpha'' + Ip Omega beta' = Mx, It beta'' - Ip Omega alpha' = My.
  EXPECT_GT(alpha.dot(r.G * beta), 0);
  EXPECT_NEAR(alpha.dot(r.G * beta), -beta.dot(r.G * alpha), 1e-15);
  EXPECT_LT((r.G + r.G.transpose()).norm(), 1e-15);
}

TEST(RotorModes, TruncatedBasisFollowsTheFullRotor) {
  BeamDefinition d = UniformShaft(1.0, 0.03, 10);
  d.disks = {{0.3, 5, 0.02, 0.038, "disk"}};
  d.supports = {IsotropicSupport(0, 1e6, 50), IsotropicSupport(1.0, 2e6, 80)};
  const LinearRotor full = Assemble(BuildBeam(d));
  const auto a = WhirlModes(full, 500, 6), b = WhirlModes(Truncate(full, 32), full, 500, 6);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(b[i].omega_d, a[i].omega_d, 1e-4 * a[i].omega_d);
    EXPECT_NEAR(b[i].whirl, a[i].whirl, 1e-3);
  }
  // All modes kept: only the coordinates differ.
  const auto c = WhirlModes(Truncate(full, 44), full, 500, 6);
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_NEAR(c[i].omega_d, a[i].omega_d, 1e-8 * a[i].omega_d);
}

TEST(RotorModes, CriticalSpeedMapRisesToThePinnedShaft) {
  BeamDefinition d = UniformShaft(1.0, 0.03, 10);
  d.supports = {IsotropicSupport(0, 1, 0), IsotropicSupport(1.0, 1, 0)};
  const BeamRotor r = BuildBeam(d);
  const auto map = CriticalSpeedMap(r, {1e4, 1e6, 1e8, 1e11}, 1);
  for (int i = 1; i < 4; ++i) EXPECT_GT(map[i].speeds[0].speed, map[i - 1].speeds[0].speed);
  // Pinned: gyroscopics move a slender shaft's critical speed by the rotary inertia's own part,
  // (pi r / L)² / 2 with r = d/4: 3e-4.
  const double pinned = HeldModes(r, {0, 20}, 1).omega(0);
  EXPECT_NEAR(map[3].speeds[0].speed, pinned, 2 * 3e-4 * pinned);
}

TEST(RotorModes, OrbitAxes) {
  const OrbitAxes forward = Orbit({3, 0}, {0, -2}), backward = Orbit({3, 0}, {0, 2});
  EXPECT_NEAR(forward.major, 3, 1e-15);
  EXPECT_NEAR(forward.minor, 2, 1e-15);
  EXPECT_NEAR(backward.minor, -2, 1e-15);
}

std::string Message(const BeamDefinition& d) {
  try {
    BuildBeam(d);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(BeamErrors, SayWhatIsWrong) {
  BeamDefinition gap = UniformShaft(0.1, 0.02, 1);
  gap.sections.push_back(Uniform(0.1, 0.02));
  gap.sections[1].z0 = 0.2;
  EXPECT_EQ(Message(gap), "beam rotor: no shaft section between z = 0.1 and 0.2 m");
  BeamDefinition off = UniformShaft(0.1, 0.02, 1);
  off.disks = {{0.2, 1, 1, 1, "impeller"}};
  EXPECT_EQ(Message(off), "disk \"impeller\" at z = 0.2 m is off the shaft, allowed 0 to 0.1 m");
  BeamDefinition bore = UniformShaft(0.1, 0.02, 1);
  bore.sections[0].id = 0.03;
  EXPECT_EQ(Message(bore), "shaft section \"\": id = 0.03 m, allowed 0 to below od = 0.02 m");
  EXPECT_EQ(Message({}), "beam rotor: no shaft section, allowed: at least one");
}

}  // namespace
}  // namespace ambrig
