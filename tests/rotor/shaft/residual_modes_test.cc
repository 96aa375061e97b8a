// Residual modes against the whole beam: static deflection under forces at the stations,
// frequencies on springs there.
#include "rotor/shaft/residual_modes.h"

#include <gtest/gtest.h>

#include "rotor/shaft/reduction.h"
#include "tests/rotor/shaft/uniform_shaft.h"

namespace ambrig {
namespace {

constexpr double kLeft = 0.13, kMiddle = 0.62, kRight = 0.87;  // stations
const std::vector<double> kStations = {kLeft, kMiddle, kRight};

BeamRotor Shaft() {
  BeamDefinition d = UniformShaft(1.0, 0.03, 11);
  d.disks.push_back({0.4, 6, 0.02, 0.035, "disk"});
  d.stations = kStations;
  return BuildBeam(d);
}

/// On springs and dampers at the stations: one more than holds it, so that forces at them bend the
/// shaft.
LinearRotor Whole(BeamRotor beam, double k, double c) {
  for (const double z : kStations) beam.supports.push_back(IsotropicSupport(z, k, c));
  return Assemble(beam);
}
LinearRotor Few(const ReducedRotor& r, double k, double c) {
  LinearRotor out = Linear(r);
  for (const double z : kStations) AddSupport(r, IsotropicSupport(z, k, c), out);
  return out;
}

/// x at `read` under 1 N in x at `push`.
double WholeDeflection(const BeamRotor& beam, double k, double push, double read) {
  const Eigen::VectorXd f = ShaftRows(beam, push).row(0).transpose();
  return ShaftRows(beam, read).row(0).dot(Whole(beam, k, 0).K.partialPivLu().solve(f));
}
double FewDeflection(const ReducedRotor& r, double k, double push, double read) {
  const Eigen::VectorXd f = StationRows(StationAt(r, push)).row(0).transpose();
  return StationRows(StationAt(r, read)).row(0).dot(Few(r, k, 0).K.partialPivLu().solve(f));
}

// The static shapes of forces at the stations are in the basis, and the springs push nowhere else:
// what a force at a station does is exact at every other plane, by reciprocity a force anywhere at
// the stations; 1e-7 of the largest is the rounding of stiffnesses eight orders apart.
TEST(ResidualModes, StaticDeflectionIsThatOfTheWholeBeam) {
  const BeamRotor beam = Shaft();
  const ReducedRotor plain = Reduce(beam, 1, {0.0}), corrected = Reduce(beam, 1, {0.0}, kStations);
  ASSERT_EQ(corrected.modes(), 4);
  for (const double k : {1e6, 1e8, -2e5})
    for (const double push : kStations) {
      const double most = std::abs(WholeDeflection(beam, k, push, push));
      for (const double read : {kLeft, 0.4, kMiddle, 0.75, kRight}) {
        const double exact = WholeDeflection(beam, k, push, read);
        EXPECT_NEAR(FewDeflection(corrected, k, push, read), exact, 1e-7 * most)
            << k << " " << read;
        EXPECT_NEAR(FewDeflection(corrected, k, read, push), exact, 1e-7 * most)
            << k << " " << read;
      }
    }
  const double exact = WholeDeflection(beam, 1e8, kMiddle, 0.75);
  EXPECT_GT(std::abs(FewDeflection(plain, 1e8, kMiddle, 0.75) / exact - 1), 0.01);
}

// The lowest modes on stiff supports, damped ones too, at speed. The kept modes alone miss the
// compliance of the planes that hold the shaft; a Ritz basis with their static shapes errs by the
// square of that, a few times.
TEST(ResidualModes, FrequenciesOnStiffSupports) {
  const BeamRotor beam = Shaft();
  const double k = 3e7, c = 2e3;
  const auto whole = WhirlModes(Whole(beam, k, c), 500, 4);
  const auto with = WhirlModes(Few(Reduce(beam, 3, {0.0}, kStations), k, c), 500, 4);
  const auto without = WhirlModes(Few(Reduce(beam, 3, {0.0}), k, c), 500, 4);
  for (std::size_t m = 0; m < 4; ++m) {
    const double missed = std::abs(without[m].s / whole[m].s - 1.0);
    EXPECT_GT(missed, 0.02) << m;
    EXPECT_LT(std::abs(with[m].s / whole[m].s - 1.0), 3 * missed * missed) << m;
  }
}

TEST(ResidualModes, AreModesOfTheirOwn) {
  const BeamRotor beam = Shaft();
  const ReducedRotor r = Reduce(beam, 3, {0.001, 0.002, 0.005}, {kLeft, kRight});
  ASSERT_EQ(r.modes(), 5);
  EXPECT_LT((r.shape.transpose() * beam.M * r.shape - Eigen::MatrixXd::Identity(5, 5)).norm(),
            1e-8);
  const Eigen::VectorXd w = Eigen::Map<const Eigen::VectorXd>(r.omega.data(), 5);
  const Eigen::MatrixXd K = r.shape.transpose() * beam.K * r.shape;
  EXPECT_LT((K - Eigen::MatrixXd(w.cwiseAbs2().asDiagonal())).norm(), 1e-6 * K.norm());
  EXPECT_GT(r.omega[3], FreeModes(beam, 4).omega(3) * (1 - 1e-9));  // a Ritz value of those dropped
  EXPECT_EQ(r.zeta[4], 0.005);
  const ReducedRotor plain = Reduce(beam, 3, {0.001, 0.002, 0.005});
  for (int k = 0; k < 3; ++k) EXPECT_EQ(r.omega[k], plain.omega[k]);
}

TEST(ResidualModes, OneForPlanesThatBendAlike) {
  const BeamRotor beam = Shaft();
  EXPECT_EQ(Reduce(beam, 2, {0.0}, {kLeft, kLeft}).modes(), 3);
  const int every = Reduce(beam, static_cast<int>(beam.M.rows()), {0.0}).modes();
  EXPECT_EQ(Reduce(beam, every, {0.0}, {kLeft, kRight}).modes(), every);  // nothing is dropped
}

}  // namespace
}  // namespace ambrig
