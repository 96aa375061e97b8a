// Rotors of the literature and of peer programs (docs/theory/rotor.md has the table). Tolerances
// are half a unit of the printed digits, or 0.5 % where a note says that the source is rougher.
#include <algorithm>

#include "tests/rotor/published_rotors.h"

namespace ambrig {
namespace {

// An 8 to 13 % gap between two programs, explained by one modelling choice.
TEST(Rappid, LumpedAgainstConsistentMass) {
  BeamDefinition d = FriswellShaft(6);
  d.disks = {FriswellDisk(0.5, 0.28), FriswellDisk(1.0, 0.28)};
  for (double z : {0.0, 1.5}) {
    d.supports.push_back(IsotropicSupport(z, 1e6, 0));
    d.supports.back().kyy = 8e5;
  }
  const auto hz = [&] {
    std::vector<double> out = NaturalFrequencies(d, 500 * kRpm, 8);
    for (double& f : out) f /= 2 * kPi;
    return out;
  };
  ExpectEach(hz(), {14.609, 15.325, 43.676, 47.211, 114.790, 122.001, 170.229, 175.656}, 0, 5.1e-4);
  d.theory.mass = MassKind::kLumped;
  ExpectEach(hz(), {14.617, 15.330, 43.356, 46.938, 105.911, 112.770, 151.032, 155.932}, 0, 5.5e-4);
  ExpectEach(hz(), {14.6152, 15.3284, 43.3459, 46.9251, 105.902, 112.760, 150.907, 155.810}, 1e-3);
}

BeamDefinition TumRotor() {
  const Material steel{211e9, 7860, 0.3};
  BeamDefinition d;
  const double ends[] = {0, 0.094, 0.132, 0.350, 0.376, 0.604, 0.642, 0.702};
  for (int i = 0; i < 7; ++i)
    d.sections.push_back(Uniform(ends[i], ends[i + 1] - ends[i], i % 2 ? 0.0096 : 0.008, steel));
  d.disks = {{0.113, 0.85074, 4.840066e-4, 4.036839e-4, "A"},
             {0.623, 0.85074, 4.840066e-4, 4.036839e-4, "B"},
             {0.363, 1.276499, 1.487212e-3, 2.832751e-3, "centre"}};
  d.elements_per_section = 6;
  return d;
}

TEST(TumMbtr, FreeFree) {
  BeamDefinition d = TumRotor();
  d.elements_per_section = 24;  // 607 and 662 Hz bend the thin ends within one section
  const BeamRotor r = BuildBeam(d);
  const RotorTotals t = Totals(r);
  EXPECT_NEAR(t.mass, 3.2731, 5e-5);
  EXPECT_NEAR(t.z_com, 0.36460, 5e-6);
  EXPECT_NEAR(t.inertia_transverse, 0.12543, 1e-4 * 0.12543);  // theirs from a 2 mm mesh: 0.01 %
  // The facts' 3.6401e-3 counts disks only.
  double disks = 0;
  for (const Disk& disk : r.disks) disks += disk.inertia_polar;
  EXPECT_NEAR(disks, 3.6401e-3, 5e-8);
  ExpectEach(Hz(FreeModes(r, 6).omega), {22.378, 105.575, 176.527, 212.873, 607.44, 662.26}, 0,
             0.0052);
}

TEST(TumMbtr, PinnedAtTheBearings) {
  const BeamRotor r = BuildBeam(TumRotor());
  const PlaneModes held = HeldModes(r, {2 * NodeAt(r, 0.113), 2 * NodeAt(r, 0.623)}, 3);
  ExpectEach(Hz(held.omega), {17.17, 105.49, 173.36}, 0, 0.006);
}

TEST(TumMbtr, SpringsAndProportionalDerivative) {
  BeamDefinition d = TumRotor();
  d.supports = {IsotropicSupport(0.113, 3.5e4, 0), IsotropicSupport(0.623, 3.5e4, 0)};
  const LinearRotor soft = Assemble(BuildBeam(d));
  const auto rest = WhirlModes(soft, 0, 8);
  const double undamped[] = {15.08, 30.29, 34.54, 105.58};
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(rest[2 * i].omega_n / (2 * kPi), undamped[i], 0.006);
  for (SpringSupport& s : d.supports) s.cxx = s.cyy = 90;
  const auto spinning = WhirlModes(Assemble(BuildBeam(d)), 3000 * kRpm, 12);
  EXPECT_NEAR(spinning[0].omega_d / (2 * kPi), 14.87, 0.006);
  EXPECT_NEAR(spinning[1].omega_d / (2 * kPi), 15.47, 0.006);
  EXPECT_EQ(spinning[0].sense(), Whirl::kBackward);
  EXPECT_EQ(spinning[1].sense(), Whirl::kForward);
  bool backward = false, forward = false;
  for (const WhirlMode& m : spinning) {
    backward |= m.sense() == Whirl::kBackward && std::abs(m.omega_n / (2 * kPi) - 79.9) < 0.06;
    forward |= m.sense() == Whirl::kForward && std::abs(m.omega_n / (2 * kPi) - 136.3) < 0.06;
  }
  EXPECT_TRUE(backward);
  EXPECT_TRUE(forward);

  // k = P ki - kx = 5000 * 50 - 1e5, c = D ki = 250: peer program's run without Rayleigh damping.
  d.supports = {IsotropicSupport(0.113, 1.5e5, 250), IsotropicSupport(0.623, 1.5e5, 250)};
  auto pd = WhirlModes(Assemble(BuildBeam(d)), 0, 10);
  std::sort(pd.begin(), pd.end(),
            [](const auto& a, const auto& b) { return a.omega_n < b.omega_n; });
  const double f[] = {16.722, 59.232, 61.114, 105.586, 176.749};
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(pd[2 * i].omega_d / (2 * kPi), f[i], 2e-4 * f[i]);
  EXPECT_NEAR(pd[0].zeta, 0.0048, 5e-5);
  EXPECT_NEAR(pd[2].zeta, 0.3245, 5e-5);
  EXPECT_NEAR(pd[4].zeta, 0.3188, 5e-5);
}

// Node planes and diameters of the UFU rig as in its ROSS example (doi 10.14393/ufu.di.2015.186).
BeamDefinition UfuRotor(double sleeve_density) {
  const double z[] = {0,      0.012,  0.032,  0.052,  0.072,  0.092,  0.112,  0.1208, 0.1272,
                      0.1348, 0.1405, 0.1469, 0.153,  0.1592, 0.1653, 0.1804, 0.1905, 0.2063,
                      0.2221, 0.2379, 0.2537, 0.2695, 0.2853, 0.3011, 0.3169, 0.3243, 0.3363,
                      0.358,  0.364,  0.3705, 0.3825, 0.3986, 0.4147, 0.4308, 0.4469, 0.463,
                      0.4791, 0.4952, 0.5113, 0.5274, 0.5356, 0.5457, 0.5607, 0.5669, 0.5731,
                      0.5792, 0.5856, 0.5913, 0.5989, 0.6053, 0.6141, 0.6341, 0.6461};
  const auto diameter = [](int i) {
    if (i == 0 || i == 51) return 6.35e-3;
    if (i < 5) return 32e-3;
    if (i < 14 || i >= 42) return 34.8e-3;
    if (i < 16 || (i >= 40 && i < 42)) return 49.9e-3;
    return i == 27 || i == 28 ? 54e-3 : 19.05e-3;
  };
  BeamDefinition d;
  for (int i = 0; i < 52; ++i)
    d.sections.push_back(Uniform(z[i], z[i + 1] - z[i], diameter(i), {1.9e11, 7850, 0.3}));
  d.elements_per_section = 1;
  const double centre[] = {0.004, 0.007, 0.014};
  for (int i = 0; i < 3; ++i)
    d.disks.push_back(DiskFromGeometry(z[27 + i], centre[i], 0.054, 0.12, 7850));
  const double lamination[] = {0.0088, 0.0064, 0.0075, 0.0057, 0.0064, 0.0061, 0.0062, 0.0062};
  for (int i = 0; i < 8; ++i) {
    d.disks.push_back(DiskFromGeometry(z[6 + i], lamination[i], 0.0348, 0.0498, sleeve_density));
    d.disks.push_back(DiskFromGeometry(z[50 - i], lamination[i], 0.0348, 0.0498, sleeve_density));
  }
  return d;
}

TEST(Ufu, TotalsAndFreeModes) {
  const BeamRotor r = BuildBeam(UfuRotor(7600));
  const RotorTotals t = Totals(r);
  EXPECT_NEAR(t.mass, 5.9250, 5e-5);
  EXPECT_NEAR(t.z_com, 0.33759, 5e-6);
  EXPECT_NEAR(t.inertia_polar, 4.7904e-3, 5e-8);
  ExpectEach(Hz(FreeModes(r, 4).omega), {104.273, 400.434, 768.623, 1118.078}, 0, 1e-3);
  const RotorTotals heavier = Totals(BuildBeam(UfuRotor(7700)));
  EXPECT_NEAR(heavier.mass, 5.936, 5e-4);
  EXPECT_NEAR(heavier.inertia_transverse, 0.18586, 5e-6);
}

TEST(Ufu, ReducedRotorKeepsTheGyroscopicSplit) {
  const ReducedRotor r = Reduce(BuildBeam(UfuRotor(7600)), 12, {0.0});
  const double published[] = {102.964, 105.589, 373.459,  426.553,
                              747.615, 790.819, 1074.305, 1170.934};
  std::vector<double> bending;
  for (const WhirlMode& m : WhirlModes(Linear(r), 628.3, 16))
    if (m.omega_d > 2 * kPi * 50) bending.push_back(m.omega_d / (2 * kPi));
  // Speed given to four digits moves the split by 1e-5; 12 modes stand for 52.
  ExpectEach(bending, {published, published + 8}, 1e-4);
}

// Nelson and McVaugh 1976: table of the rotor as public codes have it, isotropic undamped bearings.
TEST(NelsonMcVaugh, CriticalSpeeds) {
  const double z[] = {0,     1.27,  5.08,  7.62,  8.89,  10.16, 10.67, 11.43, 12.70, 13.46,
                      16.51, 19.05, 22.86, 26.67, 28.70, 30.48, 31.50, 34.54, 35.81};
  const double od[] = {1.02, 2.04, 1.52, 4.06, 4.06, 6.60, 6.60, 5.08, 5.08,
                       2.54, 2.54, 3.04, 3.04, 2.54, 2.54, 7.62, 4.06, 4.06};
  BeamDefinition d;
  for (int i = 0; i < 18; ++i) {
    d.sections.push_back(
        Uniform(z[i] / 100, (z[i + 1] - z[i]) / 100, od[i] / 100, {2.078e11, 7806, 0.3}));
    const double id = i == 6 ? 3.04 : i == 7 ? 3.56 : i == 17 ? 3.04 : 0;
    d.sections.back().id = d.sections.back().id_right = id / 100;
  }
  d.elements_per_section = 1;
  d.theory.shear = false;
  d.disks = {{0.0889, 1.401, 0.00136, 0.00203, "disk", ""}};
  d.supports = {IsotropicSupport(0.1651, 4.378e7, 0), IsotropicSupport(0.2870, 4.378e7, 0)};
  const auto critical = CriticalSpeeds(Assemble(BuildBeam(d)), 3);
  const double printed[] = {15474.8, 17156.8, 45953.4};
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(critical[i].speed / kRpm, printed[i], 0.1);
}

// Modelling and Simulation in Engineering 2011, 414286, table 1: rigid rotor, sensors not at the
// bearings.
struct MseLoop {
  ReducedRotor rotor;
  LinearRotor closed;
};
MseLoop MakeMse() {
  MseLoop out;
  out.rotor.mass = 2.3;
  out.rotor.inertia_transverse = 6e-2;
  out.rotor.inertia_polar = 8e-4;
  out.rotor.J = Eigen::MatrixXd::Constant(1, 1, 8e-4);
  out.closed = Linear(out.rotor);
  const double ks = 144000, ki = 38, kp = 7578.9, kd = 14.993;
  for (const auto& [bearing, sensor] : {std::pair{0.241, 0.241}, std::pair{-0.139, -0.119}}) {
    const Eigen::MatrixXd b = StationRows(StationAt(out.rotor, bearing));
    const Eigen::MatrixXd s = StationRows(StationAt(out.rotor, sensor));
    out.closed.K += b.transpose() * (ki * kp * s - ks * b);
    out.closed.D += ki * kd * b.transpose() * s;
  }
  return out;
}

TEST(Mse2011, RigidEigenvalues) {
  const MseLoop loop = MakeMse();
  const auto expect = [&](double speed, const std::vector<std::complex<double>>& published) {
    const auto modes = WhirlModes(loop.closed, speed, 4);
    for (const auto& p : published) {
      double nearest = 1e9;
      for (const WhirlMode& m : modes)
        nearest =
            std::min(nearest, std::abs(m.s - std::complex<double>(p.real(), std::abs(p.imag()))));
      // kd is printed to 3e-5 and kp to 7e-6 of itself; the parts of s move by up to
      // (401.6 * 401.6 * 3.3e-5 + 2e5 * 7e-6) / 198.8 = 0.034, plus half a digit.
      EXPECT_LT(nearest, 0.04) << p;
    }
  };
  expect(0, {{-200.41, 237.74}, {-401.57, 198.83}});
  expect(20000 * kRpm,
         {{-198.08, -233.57}, {-202.73, 241.37}, {-379.11, -191.06}, {-424.04, 211.18}});
}

TEST(Mse2011, OpenLoopPoles) {
  LinearRotor open = Linear(MakeMse().rotor);
  for (double z : {0.241, -0.139})
    AddSupport(MakeMse().rotor, IsotropicSupport(z, -144000, 0), open);
  // Undamped at rest: s² are the eigenvalues of -K with unit-free masses.
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(-open.K, open.M);
  EXPECT_NEAR(std::sqrt(eigen.eigenvalues()(0)), 325.1, 0.05);
  EXPECT_NEAR(std::sqrt(eigen.eigenvalues()(3)), 453.1, 0.05);
}

}  // namespace
}  // namespace ambrig
