// Modes of the whole beam by reduction and inverse iteration, against its own eigenvalues computed
// densely, the equation itself, and the fourth order of the elements.
#include "rotor/shaft/whole_beam_modes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/math/constants.h"
#include "tests/rotor/shaft/uniform_shaft.h"

namespace ambrig {
namespace {

/// A stepped shaft with a disk on anisotropic damped bearings, one of them cross-coupled.
BeamDefinition SteppedShaft(int elements) {
  BeamDefinition d;
  double z = 0;
  for (const auto& [length, od] : {std::pair{0.3, 0.05}, {0.5, 0.08}, {0.4, 0.04}}) {
    ShaftSection s;
    s.z0 = z;
    s.length = length;
    s.od = s.od_right = od;
    s.material = {2.1e11, 7850, 0.3};
    d.sections.push_back(s);
    z += length;
  }
  d.disks.push_back({0.8, 12, 0.05, 0.09, "disk"});
  for (const double at : {0.1, 1.1}) {
    SpringSupport s = IsotropicSupport(at, 2e7, 3e3);
    s.kyy = 3e7;
    s.kxy = at < 0.5 ? 4e6 : 0;
    s.kyx = -s.kxy;
    d.supports.push_back(s);
  }
  d.elements_per_section = elements;
  return d;
}

TEST(WholeBeamModes, AreThoseOfTheWholeBeam) {
  const BeamRotor beam = BuildBeam(SteppedShaft(6));
  const LinearRotor rotor = Assemble(beam);
  const Eigen::MatrixXd shapes = ShapesOf(rotor, 20, SupportColumns(beam));
  ASSERT_LT(shapes.cols(), rotor.M.rows() / 2);
  for (const double speed : {0.0, 600.0, 1500.0}) {
    const auto dense = WhirlModes(rotor, speed, 8);
    const auto found = FindWhirlModes(rotor, shapes, speed, 8).oscillatory;
    ASSERT_EQ(found.size(), dense.size());
    for (std::size_t k = 0; k < dense.size(); ++k) {
      EXPECT_LT(std::abs(found[k].s - dense[k].s), 1e-8 * std::abs(dense[k].s))
          << speed << " " << k;
      EXPECT_NEAR(found[k].whirl, dense[k].whirl, 1e-5);
    }
  }
}

// A seal with cross-coupled added mass makes M unsymmetric: the pair still solves the equation.
TEST(WholeBeamModes, SolveTheEquationWithUnsymmetricMass) {
  BeamDefinition d = SteppedShaft(4);
  d.supports[0].mxx = d.supports[0].myy = 3;
  d.supports[0].mxy = 0.8;
  d.supports[0].myx = -0.8;
  const BeamRotor beam = BuildBeam(d);
  const LinearRotor rotor = Assemble(beam);
  for (const WhirlMode& m :
       FindWhirlModes(rotor, ShapesOf(rotor, 16, SupportColumns(beam)), 500, 6).oscillatory) {
    const Eigen::MatrixXcd P = m.s * m.s * rotor.M.cast<std::complex<double>>() +
                               m.s * (rotor.D + 500 * rotor.G).cast<std::complex<double>>() +
                               rotor.K.cast<std::complex<double>>();
    EXPECT_LT((P * m.shape).norm(), 1e-9 * P.norm() * m.shape.norm());
  }
  const auto dense = WhirlModes(rotor, 500, 4);
  const auto found =
      FindWhirlModes(rotor, ShapesOf(rotor, 16, SupportColumns(beam)), 500, 4).oscillatory;
  for (std::size_t k = 0; k < dense.size(); ++k)
    EXPECT_LT(std::abs(found[k].s - dense[k].s), 1e-8 * std::abs(dense[k].s));
}

TEST(WholeBeamModes, CriticalSpeedsOfTheWholeBeam) {
  BeamDefinition d = SteppedShaft(6);
  for (SpringSupport& s : d.supports) s.kxy = s.kyx = 0;
  const BeamRotor beam = BuildBeam(d);
  const LinearRotor rotor = Assemble(beam);
  const auto dense = CriticalSpeeds(rotor, 6);
  const auto found = FindCriticalSpeeds(rotor, ShapesOf(rotor, 20, SupportColumns(beam)), 6);
  ASSERT_EQ(found.size(), dense.size());
  for (std::size_t k = 0; k < dense.size(); ++k) {
    EXPECT_NEAR(found[k].speed / dense[k].speed, 1, 1e-8);
    EXPECT_GT(found[k].whirl * dense[k].whirl, 0);
  }
}

// On one support the shaft swings freely: its stiffness there is rounding, of either sign.
TEST(WholeBeamModes, NoCriticalSpeedsOfAShaftThatSwings) {
  for (const double k : {1e4, 1e6, 1e8, 3e8}) {
    BeamDefinition d = SteppedShaft(6);
    d.supports = {IsotropicSupport(0.1, k, 0)};
    const BeamRotor beam = BuildBeam(d);
    const LinearRotor rotor = Assemble(beam);
    EXPECT_TRUE(FindCriticalSpeeds(rotor, ShapesOf(rotor, 20, SupportColumns(beam)), 6).empty())
        << k;
  }
}

// A free shaft: its bending modes twice, none of its rigid motions.
TEST(WholeBeamModes, FreeShaftHasNoRigidModes) {
  BeamDefinition d = SteppedShaft(6);
  d.supports.clear();
  const BeamRotor beam = BuildBeam(d);
  const LinearRotor rotor = Assemble(beam);
  const PlaneModes free = FreeModes(beam, 3);
  const WholeBeamModes found =
      FindWhirlModes(rotor, ShapesOf(rotor, 30, SupportColumns(beam)), 0, 6);
  ASSERT_EQ(found.oscillatory.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(found.oscillatory[k].omega_d / free.omega(static_cast<Eigen::Index>(k / 2)), 1,
                1e-7);
}

// A stiff rotor of mass m on springs k and dampers c beyond critical damping: m s² + c s + k = 0
// has two real roots, once for each direction; none of its motions of translation oscillates.
TEST(WholeBeamModes, OverdampedMotionsAreRealPoles) {
  BeamDefinition d;
  ShaftSection s;
  s.length = 1.2;
  s.od = s.od_right = 0.4;
  s.material = {1e13, 1, 0.3};
  d.sections = {s};
  d.elements_per_section = 2;
  d.disks.push_back({0.6, 10, 0.5, 0.1, "disk"});
  const double k = 1e6, c = 8e3;
  for (const double z : {0.0, 1.2}) d.supports.push_back(IsotropicSupport(z, k / 2, c / 2));
  const BeamRotor beam = BuildBeam(d);
  const double m = Totals(beam).mass, root = std::sqrt(c * c / 4 - k * m);
  const LinearRotor rotor = Assemble(beam);
  const WholeBeamModes found =
      FindWhirlModes(rotor, ShapesOf(rotor, 8, SupportColumns(beam)), 0, 4);
  for (const double exact : {(-c / 2 - root) / m, (-c / 2 + root) / m}) {
    int near = 0;
    for (const double s_k : found.real) near += std::abs(s_k / exact - 1) < 1e-3 ? 1 : 0;
    EXPECT_EQ(near, 2) << exact;
  }
  EXPECT_TRUE(std::is_sorted(found.real.begin(), found.real.end()));
}

// Pinned Euler beam: omega_n = (n pi/L)² sqrt(EI/(rho A)); the error falls with the fourth power of
// the element length.
TEST(WholeBeamModes, ConvergeWithTheFourthOrder) {
  BeamDefinition d;
  ShaftSection s;
  s.length = 1;
  s.od = s.od_right = 0.02;
  s.material = {2.1e11, 7800, 0.3};
  d.sections = {s};
  d.theory.shear = d.theory.rotary_inertia = d.theory.gyroscopic = false;
  const double exact = std::pow(3 * kPi, 2) * std::sqrt(2.1e11 * 0.02 * 0.02 / 16 / 7800);
  std::vector<double> error;
  for (const int n : {4, 8, 16}) {
    d.elements_per_section = n;
    error.push_back(HeldModes(BuildBeam(d), {0, 2 * n}, 3).omega(2) / exact - 1);
  }
  EXPECT_GT(std::log2(error[0] / error[1]), 3.5);
  EXPECT_GT(std::log2(error[1] / error[2]), 3.5);
}

// Supports of 1e20 N/m, as rotors of teaching examples have them, blur no low mode: those of the
// shaft held there.
TEST(WholeBeamModes, RigidSupportsKeepTheLowModes) {
  BeamDefinition d = SteppedShaft(6);
  d.supports = {IsotropicSupport(0, 1e20, 0), IsotropicSupport(1.2, 1e20, 0)};
  const BeamRotor beam = BuildBeam(d);
  const LinearRotor rotor = Assemble(beam);
  const PlaneModes held = HeldModes(beam, {0, static_cast<int>(beam.M.rows()) - 2}, 4);
  for (const int shapes : {30, static_cast<int>(rotor.M.rows())}) {
    const WholeBeamModes found =
        FindWhirlModes(rotor, ShapesOf(rotor, shapes, SupportColumns(beam)), 0, 8);
    ASSERT_EQ(found.oscillatory.size(), 8U);
    for (std::size_t k = 0; k < 8; ++k) {
      EXPECT_NEAR(found.oscillatory[k].omega_d / held.omega(static_cast<Eigen::Index>(k / 2)), 1,
                  1e-9);
      EXPECT_LT(std::abs(found.oscillatory[k].zeta), 1e-9);
    }
  }
  // at speed: every pair split, none lost
  const WholeBeamModes fast =
      FindWhirlModes(Assemble(beam, 500), ShapesOf(rotor, 30, SupportColumns(beam)), 500, 8);
  ASSERT_EQ(fast.oscillatory.size(), 8U);
  for (std::size_t k = 0; k < 8; k += 2) {
    EXPECT_LT(fast.oscillatory[k].omega_d, held.omega(static_cast<Eigen::Index>(k / 2)));
    EXPECT_GT(fast.oscillatory[k + 1].omega_d, held.omega(static_cast<Eigen::Index>(k / 2)));
  }
}

// All shapes of a mesh of three nodes are asked for: the motion of its rigid supports is none of
// them. Pinned at both ends, Euler-Bernoulli: (pi/L)² sqrt(EI/(rho A)) to (k h)⁴/1440, k h = pi/2
// here.
TEST(WholeBeamModes, RigidSupportsOfAMeshOfThreeNodes) {
  BeamDefinition d = UniformShaft(1, 0.04, 2);
  d.theory = EulerBernoulli();
  d.supports = {IsotropicSupport(0, 1e20, 0), IsotropicSupport(1, 1e20, 0)};
  const BeamRotor beam = BuildBeam(d);
  const LinearRotor rotor = Assemble(beam);
  const Eigen::MatrixXd shapes = ShapesOf(rotor, 20, SupportColumns(beam));
  const Eigen::MatrixXd gram = shapes.transpose() * rotor.M * shapes;
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(gram.rows(), gram.rows())).norm(), 1e-6);
  const auto modes = FindWhirlModes(rotor, shapes, 100, 4).oscillatory;
  ASSERT_GE(modes.size(), 2u);
  const double exact = kPi * kPi * std::sqrt(kSteel.E * Inertia(0.04) / (kSteel.rho * Area(0.04)));
  for (int k : {0, 1})
    EXPECT_NEAR(modes[static_cast<std::size_t>(k)].s.imag() / exact, 1,
                1.5 * std::pow(kPi / 2, 4) / 1440);
}

}  // namespace
}  // namespace ambrig
