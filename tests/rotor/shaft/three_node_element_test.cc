/// The element with a node in its middle: order of convergence against the exact Timoshenko shaft,
/// pinned in closed form and clamped by the roots of its transfer matrix; rigid motion, statics,
/// what a file may say.
#include "rotor/shaft/three_node_element.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/errors.h"
#include "rotor/shaft/beam_file.h"
#include "rotor/shaft/rotor_modes.h"
#include "rotor/shaft/shaft_file.h"
#include "tests/rotor/shaft/uniform_shaft.h"

namespace ambrig {
namespace {

constexpr double kLength = 1, kDiameter = 0.1;

BeamTheory ThreeNodes() {
  BeamTheory theory;
  theory.element = ElementKind::kThreeNode;
  return theory;
}

BeamRotor ShaftOf(int elements, const BeamTheory& theory) {
  BeamDefinition d = UniformShaft(kLength, kDiameter, elements);
  d.theory = theory;
  return BuildBeam(d);
}

struct Section {
  double EI = kSteel.E * Inertia(kDiameter), rA = kSteel.rho * Area(kDiameter),
         rI = kSteel.rho * Inertia(kDiameter);
  double kGA = ShearCoefficientOf(ShearCoefficient::kCowper, 0, kSteel.nu) *
               kSteel.shear_modulus() * Area(kDiameter);
};

/// Mode k of the shaft pinned at both ends, exact: rI rA/kGA w⁴ - (rA + (rI + rA EI/kGA) a²)
/// w² + EI a⁴ = 0.
double ExactPinned(int k) {
  const Section s;
  const double a2 = std::pow(k * kPi / kLength, 2), A = s.rI * s.rA / s.kGA,
               B = s.rA + (s.rI + s.rA * s.EI / s.kGA) * a2, C = s.EI * a2 * a2;
  return std::sqrt(2 * C / (B + std::sqrt(B * B - 4 * A * C)));
}

/// Determinant whose roots w are the frequencies of the shaft clamped at 0 and free at L: over
/// y = (w, psi, M, Q) w' = psi + Q/kGA, psi' = M/EI, M' = -Q - rI w² psi, Q' = -rA w² w, the block
/// of exp(A L) from (M, Q) at 0 to (M, Q) at L.
double CantileverDeterminant(double omega) {
  const Section s;
  Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
  A(0, 1) = 1;
  A(0, 3) = s.EI / s.kGA;  // M and Q over EI
  A(1, 2) = 1;
  A(2, 3) = -1;
  A(2, 1) = -s.rI / s.EI * omega * omega;
  A(3, 0) = -s.rA / s.EI * omega * omega;
  const int pieces = 64;
  Eigen::Matrix4d step = Eigen::Matrix4d::Identity(), term = step, all = step;
  for (int k = 1; k < 20; ++k) {
    term = term * A * (kLength / pieces / k);
    step += term;
  }
  for (int k = 0; k < pieces; ++k) all = step * all;
  return all.bottomRightCorner<2, 2>().determinant();
}

double ExactCantilever(int mode) {
  const double step = 10;
  for (double low = step;; low += step) {
    if ((CantileverDeterminant(low) > 0) == (CantileverDeterminant(low + step) > 0)) continue;
    if (--mode > 0) continue;
    double a = low, b = low + step;
    for (int k = 0; k < 60; ++k) {
      const double middle = (a + b) / 2;
      ((CantileverDeterminant(middle) > 0) == (CantileverDeterminant(a) > 0) ? a : b) = middle;
    }
    return a;
  }
}

double PinnedErrorOf(int elements, const BeamTheory& theory, int k) {
  const BeamRotor r = ShaftOf(elements, theory);
  const int last = static_cast<int>(r.M.rows()) - 2;
  return HeldModes(r, {0, last}, k).omega(k - 1) / ExactPinned(k) - 1;
}

double CantileverErrorOf(int elements, const BeamTheory& theory, int k) {
  return HeldModes(ShaftOf(elements, theory), {0, 1}, k).omega(k - 1) / ExactCantilever(k) - 1;
}

// From above, as every Ritz value of consistent mass.
TEST(ThreeNodeElement, FrequenciesWithShearConvergeWithFourthOrder) {
  for (int k : {1, 2, 3}) {
    const double p8 = PinnedErrorOf(8, ThreeNodes(), k), p16 = PinnedErrorOf(16, ThreeNodes(), k);
    const double c8 = CantileverErrorOf(8, ThreeNodes(), k);
    const double c16 = CantileverErrorOf(16, ThreeNodes(), k);
    EXPECT_GT(std::log2(p8 / p16), 3.8) << k << ": " << p8 << ' ' << p16;
    EXPECT_GT(std::log2(c8 / c16), 3.8) << k << ": " << c8 << ' ' << c16;
    EXPECT_GT(p16, 0);
    EXPECT_GT(c16, 0);
  }
}

// What the shapes miss inside an element: the shear force Q'' s²/2 of a load that grows with s,
// Q'' = rho A w² W', and, because Q' = -M'' holds in them, the moment m' s²/2 of m' = rho I w²
// Psi'. Over what the element can fit, {1, s}, the mean square of s² is h⁴/180, so that their
// energy (Q''²/kGA + m'²/EI) h⁴/720 against w² (rho A W² + rho I Psi²) is the error of w², twice
// that of w. The next term is smaller by the order of (k h)².
TEST(ThreeNodeElement, TheErrorIsTheDerivedFourthOrderTerm) {
  const Section s;
  for (int k : {2, 3}) {
    const double a = k * kPi / kLength, w2 = std::pow(ExactPinned(k), 2);
    const double tilt = s.kGA * a / (s.kGA + s.EI * a * a - s.rI * w2);  // Psi / W
    const double missed =
        std::pow(s.rA * w2 * a, 2) / s.kGA + std::pow(s.rI * w2 * a * tilt, 2) / s.EI;
    const auto beyond = [&](int n) {
      const double expected =
          missed * std::pow(kLength / n, 4) / 720 / (w2 * (s.rA + s.rI * tilt * tilt)) / 2;
      return PinnedErrorOf(n, ThreeNodes(), k) / expected - 1;
    };
    EXPECT_LT(std::abs(beyond(16)), 0.1 * std::pow(a / 16, 2)) << k;
    EXPECT_NEAR(std::log2(beyond(8) / beyond(16)), 2, 0.1) << k;
  }
}

// The oracle of the test above against a closed form: without shear and rotary inertia 1.8751².
TEST(ThreeNodeElement, TheCantileversOracleMeetsASlenderShaft) {
  const Section s;
  const double slender = std::pow(1.875104068711961, 2) * std::sqrt(s.EI / s.rA);
  // Both terms lower the frequency by about (d/L)²: 1 % here.
  EXPECT_NEAR(ExactCantilever(1), slender, 0.015 * slender);
  EXPECT_LT(ExactCantilever(1), slender);
}

TEST(ThreeNodeElement, WithoutShearNoWorseThanFourthOrder) {
  BeamTheory euler = EulerBernoulli();
  euler.element = ElementKind::kThreeNode;
  const double unit = std::sqrt(Section{}.EI / Section{}.rA), exact = std::pow(3 * kPi, 2) * unit;
  const auto error = [&](int n) {
    const BeamRotor r = ShaftOf(n, euler);
    return HeldModes(r, {0, static_cast<int>(r.M.rows()) - 2}, 3).omega(2) / exact - 1;
  };
  EXPECT_GT(std::log2(error(2) / error(4)), 6);  // shapes of fifth degree
}

TEST(ThreeNodeElement, RigidMotionCostsNothingAndWeighsWhatTheShaftDoes) {
  BeamDefinition d = UniformShaft(0.4, 0.06, 1);
  d.sections[0].od_right = 0.04;
  d.theory = ThreeNodes();
  const BeamRotor r = BuildBeam(d);
  ASSERT_EQ(r.z.size(), 3u);
  Eigen::VectorXd shift(6), tilt(6);
  shift << 1, 0, 1, 0, 1, 0;
  tilt << r.z[0], 1, r.z[1], 1, r.z[2], 1;
  const double scale = r.K.cwiseAbs().maxCoeff();
  EXPECT_LT((r.K * shift).norm(), 1e-12 * scale);
  EXPECT_LT((r.K * tilt).norm(), 1e-12 * scale);
  EXPECT_LT((r.K - r.K.transpose()).norm(), 1e-12 * scale);
  const RotorTotals t = Totals(r);
  EXPECT_NEAR(shift.dot(r.M * shift), t.mass, 1e-12 * t.mass);
  EXPECT_NEAR(shift.dot(r.M * tilt), t.mass * t.z_com, 1e-11 * t.mass);
  EXPECT_NEAR(tilt.dot(r.J * tilt), t.inertia_polar, 1e-12);
}

// A round section has twice the inertia about its axis that it has about a diameter: J is twice
// what rotary inertia adds to M.
TEST(ThreeNodeElement, GyroscopicIsTwiceRotaryInertia) {
  BeamDefinition d = UniformShaft(0.4, 0.06, 2);
  d.sections[0].od_right = 0.04;
  d.theory = ThreeNodes();
  const BeamRotor with = BuildBeam(d);
  d.theory.rotary_inertia = false;
  const BeamRotor without = BuildBeam(d);
  EXPECT_LT((with.J - 2 * (with.M - without.M)).norm(), 1e-12 * with.J.norm());
  EXPECT_GT(with.J.norm(), 0);
  d.theory.gyroscopic = false;
  EXPECT_EQ(BuildBeam(d).J.norm(), 0);
}

// Under its own weight the parabola of shear: clamped, w(L) = q L⁴/(8 EI) + q L²/(2 kGA); one
// element is exact, at its middle node, too.
TEST(ThreeNodeElement, OneElementIsExactUnderConstantLoad) {
  const BeamRotor r = ShaftOf(1, ThreeNodes());
  const Section s;
  Eigen::VectorXd shift(6);
  shift << 1, 0, 1, 0, 1, 0;
  const Eigen::VectorXd load = 9.81 * r.M * shift;
  const Eigen::VectorXd u = r.K.bottomRightCorner<4, 4>().ldlt().solve(load.tail<4>());
  const double q = 9.81 * s.rA, L = kLength, x = L / 2;
  const double tip = q * std::pow(L, 4) / (8 * s.EI) + q * L * L / (2 * s.kGA);
  const double middle =
      q * x * x / (24 * s.EI) * (6 * L * L - 4 * L * x + x * x) + q * (L * x - x * x / 2) / s.kGA;
  EXPECT_NEAR(u(2), tip, 1e-10 * tip);
  EXPECT_NEAR(u(0), middle, 1e-10 * tip);
}

// An axial force, a sleeve, layers of their own and a taper go through the same shapes: the fourth
// order stays, and the element of two nodes, extrapolated with its second order, tends to the same
// frequency (left over: its fourth order term, (k h)^4/1440).
TEST(ThreeNodeElement, EverythingElseConvergesToTheSameShaft) {
  const auto lowest = [](int n, bool three, bool separate) {
    BeamDefinition d = UniformShaft(1, 0.06, n);
    d.sections[0].od_right = 0.04;
    d.sections[0].axial_force = -2e5;
    ShaftSection sleeve = Uniform(0.5, 0.09);
    sleeve.z0 = 0.25;
    sleeve.id = sleeve.id_right = 0.06;
    sleeve.stiff = false;
    d.sections.push_back(sleeve);
    d.theory = three ? ThreeNodes() : BeamTheory{};
    d.theory.separate_layers = separate;
    BeamRotor r = BuildBeam(d);
    r.K += r.tension;
    return HeldModes(r, {0, static_cast<int>(r.M.rows()) - 2}, 2).omega(1);
  };
  for (const bool separate : {false, true}) {
    const double f16 = lowest(16, true, separate), f32 = lowest(32, true, separate),
                 f64 = lowest(64, true, separate);
    EXPECT_NEAR(std::log2((f16 - f32) / (f32 - f64)), 4, 0.2) << separate;
    const double two = (4 * lowest(128, false, separate) - lowest(64, false, separate)) / 3;
    EXPECT_NEAR(two / (f64 + (f64 - f32) / 15), 1, 1e-6) << separate;
  }
}

TEST(ThreeNodeElement, AFileAsksForItAndKeepsIt) {
  const std::string text =
      "[rotor]\nkind = \"beam\"\nelement = \"three_node\"\n[[rotor.section]]\nlength = 1.0\nod = "
      "0.05\n"
      "material = \"steel\"\n";
  const BeamFile file = ReadBeam(*TomlTable::FromText(text, "shaft.toml").Table("rotor"));
  EXPECT_EQ(file.definition.theory.element, ElementKind::kThreeNode);
  EXPECT_NE(BeamText(file).find("element = \"three_node\""), std::string::npos);
  try {
    ReadBeam(*TomlTable::FromText("[rotor]\nmass = \"lumped\"\n" + text.substr(8), "shaft.toml")
                  .Table("rotor"));
    FAIL() << "a lumped element of three nodes";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("element"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("allowed: consistent mass"), std::string::npos);
  }
}

}  // namespace
}  // namespace ambrig
