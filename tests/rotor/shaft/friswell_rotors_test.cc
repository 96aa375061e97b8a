// Rotors of Friswell, Penny, Garvey, Lees: Dynamics of Rotating Machines, and of a peer program.
// Tolerances are half a unit of the printed digits, or 0.5 % where a note says that the source is
// rougher.
#include "tests/rotor/published_rotors.h"

namespace ambrig {
namespace {

BeamDefinition TwoDiskRotor(int elements, double kxx, double kyy, double c) {
  BeamDefinition d = FriswellShaft(elements);
  d.disks = {FriswellDisk(0.5, 0.28), FriswellDisk(1.0, 0.35)};
  for (double z : {0.0, 1.5}) {
    d.supports.push_back(IsotropicSupport(z, kxx, c));
    d.supports.back().kyy = kyy;
  }
  return d;
}

TEST(Friswell, DisksAndMass) {
  const BeamDefinition d = TwoDiskRotor(6, 1e6, 1e6, 0);
  EXPECT_NEAR(d.disks[0].mass, 32.590, 5e-4);
  EXPECT_NEAR(d.disks[0].inertia_diametral, 0.178089, 5e-7);
  EXPECT_NEAR(d.disks[0].inertia_polar, 0.329564, 5e-7);
  EXPECT_NEAR(d.disks[1].mass, 51.525, 5e-4);
  EXPECT_NEAR(d.disks[1].inertia_diametral, 0.423581, 5e-7);
  EXPECT_NEAR(d.disks[1].inertia_polar, 0.805082, 5e-7);
  EXPECT_NEAR(Totals(BuildBeam(d)).mass, 107.117, 5e-4);
}

// The book's rotor has 6 elements; its 650.41 rad/s is torsion and has no lateral counterpart.
TEST(Friswell, IsotropicSupports591) {
  const BeamDefinition d = TwoDiskRotor(6, 1e6, 1e6, 0);
  // The book's 716.78 and ours 716.786: last digit truncated or rounded, hence one unit.
  ExpectEach(NaturalFrequencies(d, 0, 6), {86.66, 86.66, 274.31, 274.31, 716.78, 716.78}, 0, 0.01);
  ExpectEach(NaturalFrequencies(d, 4000 * kRpm, 6), {85.39, 87.80, 251.78, 294.71, 600.18, 827.08},
             0, 0.01);
  ExpectEach(NaturalFrequencies(d, 4000 * kRpm, 5),
             {85.3895, 87.7959, 251.7846, 294.7133, 600.1794}, 0, 5.1e-5);
}

TEST(Friswell, Overhung599) {
  BeamDefinition d = FriswellShaft(6);
  d.disks = {FriswellDisk(1.5, 0.35)};
  d.supports = {IsotropicSupport(0, 1e7, 0), IsotropicSupport(1.0, 1e7, 0)};
  ExpectEach(NaturalFrequencies(d, 0, 6), {90.14, 90.14, 630.73, 630.73, 830.43, 830.43}, 0, 0.01);
  ExpectEach(NaturalFrequencies(d, 4000 * kRpm, 6), {76.19, 103.91, 565.99, 634.23, 647.75, 1174.2},
             0, 0.05);
}

TEST(Friswell, AnisotropicSupports592) {
  const BeamDefinition d = TwoDiskRotor(48, 1e6, 8e5, 0);
  ExpectEach(NaturalFrequencies(d, 0, 6), {82.65, 86.66, 254.52, 274.31, 679.49, 716.79}, 5e-4);
  ExpectEach(NaturalFrequencies(d, 4000 * kRpm, 6), {82.33, 86.86, 239.64, 287.25, 583.49, 806.89},
             5e-4);
}

TEST(Friswell, DampedSupports595) {
  const LinearRotor r = Assemble(BuildBeam(TwoDiskRotor(6, 1e6, 1e6, 3e3)));
  const auto modes = WhirlModes(r, 0, 6);
  const double wn[] = {13.91, 13.91, 48.18, 48.18, 137.06, 137.06};
  const double wd[] = {13.89, 13.89, 46.54, 46.54, 103.22, 103.22};
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(modes[i].omega_n / (2 * kPi), wn[i], 0.01);
    EXPECT_NEAR(modes[i].omega_d / (2 * kPi), wd[i], 0.01);
  }
  // Identity of the two damping measures.
  const double zeta = modes[2].zeta;
  EXPECT_NEAR(modes[2].log_decrement, 2 * kPi * zeta / std::sqrt(1 - zeta * zeta), 1e-9);
}

TEST(Friswell, UnbalanceResponse) {
  const BeamRotor beam = BuildBeam(TwoDiskRotor(6, 1e6, 1e6, 100));
  const LinearRotor r = Assemble(beam);
  const int disk1 = NodeAt(beam, 0.5), disk2 = NodeAt(beam, 1.0);
  const double table[][3] = {{500, 5.857974e-6, 5.302659e-6},  {800, 1.256553e-4, 1.281298e-4},
                             {828, 1.653196e-3, 1.711213e-3},  {1000, 2.842338e-5, 3.286266e-5},
                             {2000, 3.302180e-6, 2.143391e-5}, {3000, 9.345492e-5, 4.394577e-5},
                             {4000, 3.409566e-5, 5.801955e-6}};
  for (const auto& row : table) {
    const Eigen::VectorXcd q = UnbalanceResponse(r, {{disk1, 1e-3, 0}}, row[0] * kRpm);
    EXPECT_NEAR(std::abs(q(4 * disk1)), row[1], 5.1e-7 * row[1] * 2) << row[0];
    EXPECT_NEAR(std::abs(q(4 * disk2)), row[2], 5.1e-7 * row[2] * 2) << row[0];
    // Isotropic: a forward circle.
    const OrbitAxes orbit = AxesOfOrbit(q(4 * disk1), q(4 * disk1 + 1));
    EXPECT_NEAR(orbit.minor, orbit.major, 1e-9 * orbit.major);
  }
}

// The peer found its critical speeds on a speed grid: 1e-4 between its numbers and the direct
// method.
TEST(Friswell, CriticalSpeeds) {
  const LinearRotor r = Assemble(BuildBeam(TwoDiskRotor(6, 1e6, 1e6, 100)));
  const auto critical = CriticalSpeeds(r, 5);
  const double published[] = {825.14, 829.88, 2487.86, 2756.27, 5379.74};
  ASSERT_EQ(critical.size(), 5u);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(critical[i].speed / kRpm, published[i], 1e-4 * published[i]);
    EXPECT_EQ(critical[i].whirl > 0, i % 2 == 1);
    // Identity: at a critical speed a whirl mode of the undamped rotor has that frequency.
    LinearRotor undamped = r;
    undamped.D.setZero();
    double nearest = 1e9;
    for (const WhirlMode& m : WhirlModes(undamped, critical[i].speed, 12))
      nearest = std::min(nearest, std::abs(m.omega_d - critical[i].speed));
    EXPECT_LT(nearest, 1e-7 * critical[i].speed);
  }
}

}  // namespace
}  // namespace ambrig
