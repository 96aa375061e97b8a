// Modes over the speed that start from their neighbours, against each speed solved alone and
// against eigenvalues of the whole beam.
#include "rotor/shaft/whirl_sweep.h"

#include <gtest/gtest.h>

#include <array>

#include "core/math/constants.h"
#include "rotor/shaft/dynamic_matrix.h"

namespace ambrig {
namespace {

/// A shaft with a disk; one support of a table over the speed, which is overdamped at first.
BeamDefinition ShaftOnTable(double c) {
  BeamDefinition d;
  ShaftSection s;
  s.length = 1.2;
  s.od = s.od_right = 0.06;
  s.material = {2.1e11, 7850, 0.3};
  d.sections = {s};
  d.elements_per_section = 10;
  d.disks.push_back({0.72, 14, 0.06, 0.11, "disk"});
  d.supports = {IsotropicSupport(0.12, 2e7, 2e3), IsotropicSupport(1.08, 1e7, c)};
  SpringSupport& table = d.supports[1];
  table.name = "film";
  table.kxy = 3e6;
  table.kyx = -3e6;
  return d;
}

void ExpectSame(const WholeBeamModes& a, const WholeBeamModes& b, double speed) {
  ASSERT_EQ(a.oscillatory.size(), b.oscillatory.size()) << speed;
  for (std::size_t k = 0; k < a.oscillatory.size(); ++k) {
    const WhirlMode &m = a.oscillatory[k], &n = b.oscillatory[k];
    EXPECT_LT(std::abs(m.s - n.s), 1e-9 * std::abs(n.s)) << speed << " " << k;
    EXPECT_NEAR(m.whirl, n.whirl, 1e-6) << speed << " " << k;
    EXPECT_GT(std::norm(m.shape.dot(n.shape)),
              (1 - 1e-8) * m.shape.squaredNorm() * n.shape.squaredNorm());
  }
  ASSERT_EQ(a.real.size(), b.real.size()) << speed;
  for (std::size_t k = 0; k < a.real.size(); ++k)
    EXPECT_NEAR(a.real[k] / b.real[k], 1, 1e-8) << speed << " " << k;
}

// From slow to fast, back, in one jump: the neighbours decide nothing but the work.
TEST(WhirlSweep, FindsWhatEachSpeedAloneHas) {
  for (const double c : {4e3, 6e4}) {  // the second one overdamps a motion: real poles
    const BeamRotor beam = BuildBeam(ShaftOnTable(c));
    const Eigen::MatrixXd shapes = ShapesOf(Assemble(beam, 400), 20, SupportColumns(beam));
    WhirlSweep sweep(beam, shapes, 6);
    for (const double speed : {0.0, 20.0, 40.0, 60.0, 300.0, 320.0, 40.0, 2000.0, 0.0})
      ExpectSame(sweep.At(speed), FindWhirlModes(Assemble(beam, speed), shapes, speed, 6), speed);
  }
}

TEST(WhirlSweep, FollowsTablesOfSupports) {
  BeamDefinition d = ShaftOnTable(4e3);
  SpringSupport& s = d.supports[1];
  s.speed = {0, 300, 900};
  s.table.resize(3);
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = static_cast<double>(k);
    s.table[k].kxx = 1e7 + 8e6 * x;
    s.table[k].kyy = 2e7 - 4e6 * x;
    s.table[k].cxx = s.table[k].cyy = 4e3 + 1e4 * x;
  }
  const BeamRotor beam = BuildBeam(d);
  const Eigen::MatrixXd shapes = ShapesOf(Assemble(beam, 400), 24, SupportColumns(beam));
  WhirlSweep sweep(beam, shapes, 6);
  for (double speed = 0; speed < 1000; speed += 40) {
    const WholeBeamModes found = sweep.At(speed);
    ExpectSame(found, FindWhirlModes(Assemble(beam, speed), shapes, speed, 6), speed);
    const std::vector<WhirlMode> dense = WhirlModes(Assemble(beam, speed), speed, 6);
    for (std::size_t k = 0; k < dense.size(); ++k)
      EXPECT_LT(std::abs(found.oscillatory[k].s - dense[k].s), 1e-8 * std::abs(dense[k].s));
  }
}

// Nothing holds the shaft: its rigid motions have no shape to start from; turning, it precesses at
// Omega Ip/It.
TEST(WhirlSweep, FreeShaft) {
  BeamDefinition d = ShaftOnTable(0);
  d.supports.clear();
  const BeamRotor beam = BuildBeam(d);
  const Eigen::MatrixXd shapes = ShapesOf(Assemble(beam), 24, SupportColumns(beam));
  WhirlSweep sweep(beam, shapes, 4);
  const RotorTotals totals = Totals(beam);
  for (const double speed : {0.0, 100.0, 150.0}) {
    const WholeBeamModes found = sweep.At(speed);
    ExpectSame(found, FindWhirlModes(Assemble(beam, speed), shapes, speed, 4), speed);
    if (speed == 0) continue;
    EXPECT_NEAR(found.oscillatory[0].omega_d,
                speed * totals.inertia_polar / totals.inertia_transverse, 1e-4 * speed);
  }
}

// Housings, and a support between shafts, put unknowns far from the diagonal: the solution stays
// one of the whole equation, whatever solver takes it.
TEST(WhirlSweep, DynamicMatrixWithHousings) {
  BeamDefinition d = ShaftOnTable(4e3);
  for (const char* name : {"left", "right"}) {
    Housing h;
    h.name = name;
    h.mass_x = h.mass_y = 30;
    d.housings.push_back(h);
  }
  d.supports[0].on = "left";
  d.supports[1].on = "right";
  const LinearRotor r = Assemble(BuildBeam(d));
  const std::complex<double> s(-20, 700);
  DynamicMatrix matrix(r, 300);
  ASSERT_TRUE(matrix.Factorise(s));
  const Eigen::VectorXcd f = Eigen::VectorXcd::Ones(r.M.rows());
  const Eigen::VectorXcd x = matrix.Solve(f);
  const Eigen::MatrixXcd P = s * s * r.M + s * (r.D + 300 * r.G) + r.K;
  EXPECT_LT((P * x - f).norm(), 1e-10 * P.norm() * x.norm());
}

}  // namespace
}  // namespace ambrig
