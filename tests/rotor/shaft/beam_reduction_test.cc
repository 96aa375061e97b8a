#include <gtest/gtest.h>

#include <cmath>

#include "rotor/shaft/reduction.h"
#include "rotor/shaft/rotor_modes.h"

namespace ambrig {
namespace {

/// Unsymmetric on purpose: tapered end, disk off centre, sleeve.
BeamDefinition Rotor() {
  BeamDefinition d;
  const Material steel{2.1e11, 7850, 0.3};
  const auto add = [&](double z0, double length, double od, double od_right, double id,
                       bool stiff) {
    ShaftSection s;
    s.z0 = z0, s.length = length, s.od = od, s.od_right = od_right, s.id = s.id_right = id;
    s.material = steel, s.stiff = stiff;
    d.sections.push_back(s);
  };
  add(0, 0.2, 0.02, 0.03, 0, true);
  add(0.2, 0.4, 0.03, 0.03, 0, true);
  add(0.3, 0.1, 0.05, 0.05, 0.03, false);
  d.disks = {{0.5, 2.0, 0.004, 0.0075, "disk"}};
  d.elements_per_section = 4;
  d.stations = {0.11};
  return d;
}

TEST(Reduction, RigidPartIsTheRotor) {
  const BeamRotor r = BuildBeam(Rotor());
  const RotorTotals t = Totals(r);
  const ReducedRotor reduced = Reduce(r, 0, {0.0});
  EXPECT_NEAR(reduced.mass, t.mass, 1e-10);
  EXPECT_NEAR(reduced.z_com, t.z_com, 1e-10);
  EXPECT_NEAR(reduced.inertia_transverse, t.inertia_transverse, 1e-10);
  EXPECT_NEAR(reduced.inertia_polar, t.inertia_polar, 1e-10);
  const LinearRotor l = Linear(reduced);
  EXPECT_NEAR(l.G(2, 3), t.inertia_polar, 1e-10);   // alpha row: + Ip Omega beta'
  EXPECT_NEAR(l.G(3, 2), -t.inertia_polar, 1e-10);  // beta row: - Ip Omega alpha'
}

// With every mode kept the reduction is a change of coordinates: same eigenvalues at speed on
// supports.
TEST(Reduction, AllModesAreTheFullRotor) {
  BeamDefinition d = Rotor();
  d.supports = {IsotropicSupport(0.11, 3e5, 40), IsotropicSupport(0.6, 2e5, 60)};
  d.supports[0].kxy = 2e4;  // cross-coupled, so that no symmetry helps
  const BeamRotor beam = BuildBeam(d);
  const ReducedRotor reduced = Reduce(beam, 2 * static_cast<int>(beam.z.size()) - 2, {0.0});
  LinearRotor modal = Linear(reduced);
  for (const SpringSupport& s : d.supports) AddSupport(reduced, s, modal);
  const auto full = WhirlModes(Assemble(beam), 800, 8), ours = WhirlModes(modal, 800, 8);
  for (int i = 0; i < 8; ++i)
    EXPECT_LT(std::abs(full[i].s - ours[i].s), 1e-6 * std::abs(full[i].s));
}

// Few modes: bending modes left out are static flexibility only; the lowest whirl modes stay.
TEST(Reduction, FewModesFollowTheGyroscopicSplit) {
  const BeamRotor beam = BuildBeam(Rotor());
  const auto bending = [](const std::vector<WhirlMode>& modes) {
    std::vector<WhirlMode> out;
    for (const WhirlMode& m : modes)
      if (m.omega_d > 500) out.push_back(m);  // above the nutation of the free rotor
    return out;
  };
  const auto full = bending(WhirlModes(Assemble(beam), 1500, 10));
  double error[2] = {0, 0};
  int row = 0;
  for (int n : {2, 6}) {
    const auto ours = bending(WhirlModes(Linear(Reduce(beam, n, {0.0})), 1500, 10));
    for (int i = 0; i < 4; ++i) {
      error[row] = std::max(error[row], std::abs(ours[i].omega_d / full[i].omega_d - 1));
      EXPECT_EQ(ours[i].sense(), full[i].sense());
    }
    ++row;
  }
  EXPECT_LT(error[0], 0.01);
  EXPECT_LT(error[1], 0.1 * error[0]);
}

TEST(Reduction, ModesAreOrthogonalToRigidMotion) {
  const BeamRotor beam = BuildBeam(Rotor());
  const ReducedRotor r = Reduce(beam, 3, {0.0});
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(beam.M.rows());
  for (Eigen::Index i = 0; i < shift.size(); i += 2) shift(i) = 1;
  EXPECT_LT((shift.transpose() * beam.M * r.shape).norm(), 1e-10);
  const Eigen::Matrix3d identity = r.shape.transpose() * beam.M * r.shape;
  EXPECT_LT((identity - Eigen::Matrix3d::Identity()).norm(), 1e-9);
}

TEST(Reduction, DampingRatiosAndRayleighAdd) {
  BeamDefinition d = Rotor();
  for (ShaftSection& s : d.sections) s.damping_stiffness = 2e-6;
  const ReducedRotor r = Reduce(BuildBeam(d), 2, {0.001, 0.003});
  // Stiffness-proportional damping beta K: zeta = beta w / 2.
  EXPECT_NEAR(r.zeta[0], 0.001 + 1e-6 * r.omega[0], 1e-12);
  EXPECT_NEAR(r.zeta[1], 0.003 + 1e-6 * r.omega[1], 1e-12);
}

TEST(Station, NodesAndBetween) {
  const BeamRotor beam = BuildBeam(Rotor());
  const ReducedRotor r = Reduce(beam, 3, {0.0});
  for (int i : {0, 3, static_cast<int>(beam.z.size()) - 1}) {
    const ModalStation s = StationAt(r, beam.z[i]);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(s.phi(k), r.shape(2 * i, k), 1e-10);
      EXPECT_NEAR(s.slope(k), r.shape(2 * i + 1, k), 1e-9);
    }
  }
  // Continuous across a node, and close to a mesh four times finer.
  BeamDefinition fine = Rotor();
  fine.elements_per_section = 16;
  const ReducedRotor f = Reduce(BuildBeam(fine), 3, {0.0});
  for (double z : {0.03, 0.17, 0.24, 0.41, 0.57}) {
    const ModalStation s = StationAt(r, z), t = StationAt(f, z);
    for (int k = 0; k < 3; ++k) {
      const double scale = r.shape.col(k).cwiseAbs().maxCoeff();
      // Static shapes between nodes miss the inertia load: (k h)^4 / 384 of the amplitude,
      // k h < 0.8.
      EXPECT_NEAR(s.phi(k), t.phi(k), 2e-3 * scale) << z << " mode " << k;
    }
  }
  EXPECT_NEAR(StationAt(r, 0.2 - 1e-9).phi(1), StationAt(r, 0.2 + 1e-9).phi(1), 1e-6);
  // Beyond the end: straight on.
  const ModalStation end = StationAt(r, 0.6), past = StationAt(r, 0.65);
  EXPECT_NEAR(past.phi(0), end.phi(0) + 0.05 * end.slope(0), 1e-12);
  EXPECT_NEAR(past.arm, 0.65 - r.z_com, 1e-15);
}

// Static deflection between two soft springs: modal sum against the stiffness matrix.
TEST(Station, ForceInAndDisplacementOut) {
  BeamDefinition d = Rotor();
  d.supports = {IsotropicSupport(0.11, 1e5, 0), IsotropicSupport(0.6, 1e5, 0)};
  const BeamRotor beam = BuildBeam(d);
  const ReducedRotor r = Reduce(beam, 12, {0.0});
  LinearRotor modal = Linear(r);
  for (const SpringSupport& s : d.supports) AddSupport(r, s, modal);
  const Eigen::MatrixXd rows = StationRows(StationAt(r, 0.5));
  const Eigen::VectorXd q = modal.K.ldlt().solve(rows.row(1).transpose() * 10.0);
  const LinearRotor full = Assemble(beam);
  const int node = NodeAt(beam, 0.5);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(full.K.rows());
  f(4 * node + 1) = 10.0;
  const double exact = full.K.ldlt().solve(f)(4 * node + 1);
  EXPECT_NEAR((rows * q)(1), exact, 1e-4 * exact);
  EXPECT_NEAR((rows * q)(0), 0, 1e-18);
}

}  // namespace
}  // namespace ambrig
