// Matrices of whole shafts and their modes, against rigid bodies and closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "core/math/constants.h"
#include "rotor/shaft/beam.h"
#include "rotor/shaft/beam_mesh.h"
#include "rotor/shaft/rotor_modes.h"
#include "tests/rotor/shaft/uniform_shaft.h"

namespace ambrig {
namespace {

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

// Planes closer than 1e-7 of the shaft's length are one node, wherever the origin of z is.
TEST(BeamMatrices, PlanesNextToEachOtherAreOneNode) {
  for (const double z0 : {-0.5, 0.0, 3.0}) {
    BeamDefinition d = UniformShaft(1, 0.04, 1);
    d.sections[0].z0 = z0;
    d.stations = {z0 + 0.3};
    d.disks = {{z0 + 0.3 + 5e-8, 1, 0.01, 0.01, "disk"}};
    EXPECT_EQ(BuildBeam(d).z.size(), 3u) << z0;
    d.disks[0].z = z0 + 0.3 + 2e-7;
    EXPECT_EQ(BuildBeam(d).z.size(), 4u) << z0;
    d.disks[0].z = z0 + 1 + 2e-7;
    EXPECT_THROW(BuildBeam(d), InputError) << z0;
  }
}

// A shaft that is the same in both planes gives way alike in both, wherever it is pushed and read:
// at a node as between two.
TEST(BeamMatrices, RowsOfAPlaneReadBothDirectionsAlike) {
  BeamDefinition d = UniformShaft(0.6, 0.03, 3);
  for (const double z : {0.0, 0.6}) d.supports.push_back(IsotropicSupport(z, 1e7, 0));
  const BeamRotor r = BuildBeam(d);
  const LinearRotor whole = Assemble(r);
  const auto gives = [&](double push, double read, int from, int to) {
    const Eigen::VectorXd f = ShaftRows(r, push).row(from).transpose();
    return ShaftRows(r, read).row(to).dot(whole.K.ldlt().solve(f));
  };
  for (const double z : {0.07, 0.2, 0.31})
    for (const double at : {0.11, 0.4}) {
      const double x = gives(z, at, 0, 0);
      EXPECT_GT(x, 0);
      EXPECT_NEAR(gives(z, at, 1, 1), x, 1e-9 * x);
      EXPECT_NEAR(gives(at, z, 0, 0), x, 1e-9 * x);  // Maxwell and Betti
      EXPECT_NEAR(gives(z, at, 0, 1), 0, 1e-9 * x);
    }
}

// base_model.md section 1: a free spinning body nutates forward with (Ip/It) Omega.
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
  const OrbitAxes forward = AxesOfOrbit({3, 0}, {0, -2}), backward = AxesOfOrbit({3, 0}, {0, 2});
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

// Dense matrices of more would take hours and more memory than machines have.
TEST(BeamErrors, TooManyElementsAreRefused) {
  EXPECT_EQ(Message(UniformShaft(0.1, 0.02, static_cast<int>(kMostElements))), "");
  EXPECT_NE(Message(UniformShaft(0.1, 0.02, static_cast<int>(kMostElements) + 1))
                .find("more than 500 elements"),
            std::string::npos);
}

TEST(BeamErrors, SayWhatIsWrong) {
  BeamDefinition gap = UniformShaft(0.1, 0.02, 1);
  gap.sections.push_back(Uniform(0.1, 0.02));
  gap.sections[1].z0 = 0.2;
  EXPECT_EQ(Message(gap), "beam rotor: no shaft section between z = 0.1 m and z = 0.2 m");
  BeamDefinition off = UniformShaft(0.1, 0.02, 1);
  off.disks = {{0.2, 1, 1, 1, "impeller"}};
  EXPECT_EQ(Message(off), "disk \"impeller\" at z = 0.2 m is off the shaft, allowed 0 to 0.1 m");
  BeamDefinition bore = UniformShaft(0.1, 0.02, 1);
  bore.sections[0].id = 0.03;
  EXPECT_EQ(Message(bore), "shaft section \"\": id = 0.03 m, allowed 0 to below od = 0.02 m");
  EXPECT_EQ(Message({}), "beam rotor: no shaft section, allowed: at least one");
}

TEST(BeamMesh, ASectionNeedsAWallAtBothEnds) {
  ShaftSection s = UniformShaft(1, 0.04, 1).sections[0];
  EXPECT_EQ(SectionProblem(s), "");
  for (double ShaftSection::*inner : {&ShaftSection::id, &ShaftSection::id_right}) {
    for (const double bore : {0.04, 0.05, -0.01}) {
      ShaftSection thin = s;
      thin.*inner = bore;
      EXPECT_NE(SectionProblem(thin), "") << bore;
    }
    ShaftSection tube = s;
    tube.*inner = 0.0399;
    EXPECT_EQ(SectionProblem(tube), "");
  }
  s.length = 0;
  EXPECT_NE(SectionProblem(s), "");
}

}  // namespace
}  // namespace ambrig
