// Closed forms of the standards, of modes and of the bearings' stiffness.
#include "analysis/rig_analysis.h"

#include <gtest/gtest.h>

#include "analysis/iso14839.h"
#include "core/math/constants.h"
#include "rig/rig_file.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

RigParameters AnalysedRig() { return ReadRigText(ReferenceRigText(), "rig.toml"); }

TEST(Standards, Zones) {
  EXPECT_EQ(SensitivityZone(3.0), 'A');
  EXPECT_EQ(SensitivityZone(3.01), 'B');
  EXPECT_EQ(SensitivityZone(4.5), 'C');
  EXPECT_EQ(SensitivityZone(5.01), 'D');
  EXPECT_EQ(DisplacementZone(0.31), 'B');
  EXPECT_EQ(DisplacementZone(0.6), 'D');
  EXPECT_EQ(SensitivityRange(100), 2000);
  EXPECT_EQ(SensitivityRange(1000), 3000);
}

TEST(Standards, SeparationMargins) {
  // AF 5: 17 (1 - 1/3.5) = 12.14 below, 22.14 above.
  const SeparationMargin below = AssessSeparation(850, 5, 1000, 2000),
                         above = AssessSeparation(2400, 5, 1000, 2000);
  EXPECT_NEAR(below.required, 17 * (1 - 1 / 3.5), 1e-12);
  EXPECT_NEAR(below.actual, 15, 1e-9);
  EXPECT_TRUE(below.met);
  EXPECT_NEAR(above.required, 10 + 17 * (1 - 1 / 3.5), 1e-12);
  EXPECT_NEAR(above.actual, 20, 1e-9);
  EXPECT_FALSE(above.met);
  EXPECT_TRUE(AssessSeparation(1500, 2.4, 1000, 2000).met);   // critically damped
  EXPECT_FALSE(AssessSeparation(1500, 2.6, 1000, 2000).met);  // inside the range
}

// k at low frequency: k_p - k_s and the integrator's -i k_i/ω; every piece known in closed form.
TEST(Stiffness, OfTheBearingWhenSlow) {
  const RigParameters rig = AnalysedRig();
  const OperatingPoint point = FindOperatingPoint(rig);
  const ClosedLoop loop(point, 0);
  const TransferFunction transfer(point, loop);
  const double f = 8, omega = 2 * kPi * f;
  const DynamicStiffness s = FindStiffness(point, transfer, {f});
  const PidParameters& pid = rig.controller.pid;
  const AxisCapacity c = FindCapacity(point)[0];
  // Nominal force per command is k c0 of the centred bearing; at the operating point k_i differs.
  const double gain = c.k_i / (point.control()[0].map.k * point.control()[0].map.c0);
  const std::complex<double> expected =
      gain * std::complex<double>(pid.kp, omega * pid.kd - pid.ki / omega) - c.k_s;
  // Delay of 1.5 controller periods and the current loop turns the command by about 1 %.
  EXPECT_LT(std::abs(s.axes[0].bearing[0] - expected), 0.03 * std::abs(expected));
}

// One axis as mass on its bearing: rotor stiffness = K - m ω² for a pure translation. The thrust
// axis is exactly that.
TEST(Stiffness, LevitatedRotorIsBearingAndMass) {
  const RigParameters rig = AnalysedRig();
  const OperatingPoint point = FindOperatingPoint(rig);
  const ClosedLoop loop(point, 0);
  const TransferFunction transfer(point, loop);
  const std::vector<double> f = {10, 40, 80, 160};
  const DynamicStiffness s = FindStiffness(point, transfer, f);
  for (std::size_t k = 0; k < f.size(); ++k) {
    const double omega = 2 * kPi * f[k];
    const std::complex<double> expected = s.axes[4].bearing[k] - rig.rotor.mass * omega * omega;
    // The force is a smooth one between ticks: sampled force and motion agree to (ω Ts)².
    EXPECT_LT(std::abs(s.axes[4].rotor[k] - expected), 0.02 * std::abs(expected)) << f[k];
  }
}

// A rigid rotor on the net springs: f = sqrt(k Σ/m)/2π for translation; both bearings alike.
TEST(Supports, RigidRotorOnSprings) {
  RigParameters rig = AnalysedRig();
  rig.gravity = {0, 0, 0};
  const OperatingPoint point = FindOperatingPoint(rig);
  const RotorOnSupports s = AnalyseSupports(point, 4);
  EXPECT_TRUE(s.free.empty());
  ASSERT_EQ(s.supported.size(), 2u);
  const double k = s.supports[0].net(), za = -0.12, zb = 0.13, m = rig.rotor.mass,
               It = rig.rotor.inertia_transverse;
  // 2 x 2: translation and tilt.
  const double a = 2 * k / m, b = k * (za + zb) / std::sqrt(m * It),
               c = k * (za * za + zb * zb) / It;
  const double root = std::sqrt(0.25 * (a - c) * (a - c) + b * b);
  EXPECT_NEAR(s.supported[0].frequency, std::sqrt(0.5 * (a + c) - root) / (2 * kPi),
              1e-6 * s.supported[0].frequency);
  EXPECT_NEAR(s.supported[1].frequency, std::sqrt(0.5 * (a + c) + root) / (2 * kPi),
              1e-6 * s.supported[1].frequency);
  // Undamped critical speeds lie on both sides of them: Ip lowers the backward, raises the forward
  // tilt.
  ASSERT_GE(s.critical.size(), 3u);
  EXPECT_FALSE(s.map.empty());
}

TEST(Capacity, OfTheReferenceRig) {
  RigParameters rig = AnalysedRig();
  rig.gravity = {0, 0, 0};
  const auto c = FindCapacity(FindOperatingPoint(rig));
  const RadialStatorParameters& p = rig.bearings[0].radial;
  const double k = 4 * kMu0 * p.turns * p.turns * p.pole_area / (p.gap * p.gap), c0 = 2;
  const double cosine = std::cos(22.5 * kPi / 180);
  EXPECT_NEAR(c[0].k_i, k * c0, 1e-9 * c[0].k_i);
  // the coil opposite reaches 0 A
  EXPECT_NEAR(c[0].linear, k * c0 * c0 / cosine, 1e-9 * c[0].linear);
  EXPECT_NEAR(c[0].usable(), std::min(c[0].linear, 60.0), 1e-9);
  EXPECT_GE(c[0].largest, c[0].linear);
  // Slew: every coil needs L_eff w v', the carrying patterns see N²P + L_l = 1.95 mH; voltage left
  // about 30 V: k c0 30/(1.95e-3 cos 22.5).
  EXPECT_NEAR(c[0].slew, k * c0 * 29 / (1.95e-3 * cosine), 0.06 * c[0].slew);
}

// A bridge that drives both ways has its whole voltage to change a current either way; one that
// does not, only what the resting current drops in the winding: 0.5 A times 1 ohm of 24 V. One file
// after the other is read: the magnets and currents are the same.
TEST(Capacity, SlewIsThatOfTheDutiesAllowed) {
  const std::string text = ReadText(AMBRIG_SOURCE_DIR "/examples/validation/mbc500.toml");
  const auto slew = [](const std::string& rig) {
    return FindCapacity(FindOperatingPoint(ReadRigText(rig, "rig.toml"))).at(0).slew;
  };
  const double both = slew(text),
               one = slew(Replaced(text, "duty_limits = [-1.0, 1.0]", "duty_limits = [0.0, 1.0]"));
  EXPECT_NEAR(both / one, (24 - 0.5) / 0.5, 1e-6 * both / one);
}

TEST(Analysis, OfTheReferenceRig) {
  AnalysisOptions o;
  o.lowest = 300;
  o.highest = 600;
  o.fastest = 900;
  o.responses = {{"A.x.load", "A.x"}, {"A.x.force", "A.i1"}};
  const RigAnalysis a = Analyse(AnalysedRig(), o);
  EXPECT_TRUE(a.stable());
  ASSERT_EQ(a.sensitivity.size(), 3u);
  for (const Sensitivity& s : a.sensitivity)
    for (const AxisSensitivity& x : s.axes) {
      EXPECT_GT(x.peak, 1);
      EXPECT_LT(x.gain_down, 1);
      EXPECT_GT(x.gain_up, 1);
      EXPECT_GT(x.phase_margin, 0);
    }
  EXPECT_EQ(a.displacement.size(), 6u);
  EXPECT_EQ(a.responses.size(), 2u);
  EXPECT_FALSE(a.tracks.empty());
  // API's residual unbalance: 6350 W/N g mm a plane, in kg m.
  double sum = 0;
  for (const PlaneUnbalance& p : a.unbalance[0].unbalance.planes) sum += p.magnitude;
  EXPECT_NEAR(sum, 6350e-6 * 4.2 / (600 * 30 / kPi), 1e-6 * sum);
}

// A gain beyond its margins is unstable, within them stable: the controller's gains multiplied.
/// Gain margins of the thrust axis, which moves alone, beside the gains at which the loop is truly
/// unstable. `ki`: times the rig's.
void ExpectMarginsAreWhereStabilityEnds(double ki) {
  RigParameters rig = AnalysedRig();
  rig.gravity = {0, 0, 0};
  rig.bearings[2].controller->ki *= ki;
  const OperatingPoint point = FindOperatingPoint(rig);
  const ClosedLoop loop(point, 0);
  const Sensitivity s = FindSensitivity(point, TransferFunction(point, loop), 600);
  const AxisSensitivity& z = s.axes[4];
  const auto stable = [&](double factor) {
    RigParameters changed = rig;
    PidParameters& pid = *changed.bearings[2].controller;
    for (double* g : {&pid.kp, &pid.kd, &pid.ki}) *g *= factor;
    const OperatingPoint at = FindOperatingPoint(changed);
    return FindModes(at, ClosedLoop(at, 0)).stable();
  };
  ASSERT_GT(z.gain_down, 0) << "an open loop is unstable: the magnets pull away";
  EXPECT_TRUE(stable(0.99 * z.gain_up));
  EXPECT_FALSE(stable(1.01 * z.gain_up));
  EXPECT_TRUE(stable(1.01 * z.gain_down));
  EXPECT_FALSE(stable(0.99 * z.gain_down));
}

TEST(Margins, GainMarginsAreWhereStabilityEnds) { ExpectMarginsAreWhereStabilityEnds(1); }

// Without an integrator the stiffness decides at standstill how far the gain may fall: k_p = k_s.
TEST(Margins, WithoutAnIntegratorTheGainMayFallToTheNegativeStiffness) {
  ExpectMarginsAreWhereStabilityEnds(0);
  ExpectMarginsAreWhereStabilityEnds(1e-4);
  RigParameters rig = AnalysedRig();
  rig.gravity = {0, 0, 0};
  rig.controller.pid.ki = 0;
  const OperatingPoint point = FindOperatingPoint(rig);
  const Sensitivity s = FindSensitivity(point, TransferFunction(point, ClosedLoop(point, 0)), 600);
  for (const std::size_t a : {0u, 1u, 2u, 3u}) {  // coupled with the other end: near it only
    EXPECT_GT(s.axes[a].gain_down, 0.3) << s.axes[a].axis;
    EXPECT_LT(s.axes[a].gain_down, 0.6) << s.axes[a].axis;
  }
}

class AnalyzeCommand : public CliFolder {};

TEST_F(AnalyzeCommand, BadInputIsOneLine) {
  Write("rig.toml", ReferenceRigText());
  for (const char* arguments :
       {"analyze rig.toml --speed fast", "analyze rig.toml --speed 900:300", "analyze none.toml",
        "analyze rig.toml --response A.x.force:Q.x", "analyze rig.toml --response A.x.push:A.x",
        "analyze rig.toml --speed 3000 --max-speed 2000", "analyze rig.toml --measure 0",
        "analyze rig.toml --measure 1 --sine 1e4"}) {
    const Outcome o = Ambrig(arguments);
    EXPECT_EQ(o.exit, 2) << arguments;
    EXPECT_EQ(o.lines(), 1) << o.text;
  }
}

TEST_F(AnalyzeCommand, WritesSummaryJsonAndPage) {
  Write("rig.toml", ReferenceRigText());
  const Outcome o = Ambrig("analyze rig.toml --speed 3000 -o out");
  EXPECT_EQ(o.exit, 0) << o.text;
  EXPECT_NE(o.text.find("ISO 14839-3"), std::string::npos);
  const auto json =
      ReadText(folder_ / "out" / (folder_.filename().string() + ".rig.analysis.json"));
  EXPECT_NE(json.find("\"zone\": \"A\""), std::string::npos);
  EXPECT_NE(json.find("\"worst_gain\""), std::string::npos);
  EXPECT_NE(o.text.find("simultaneous-loop disk margin"), std::string::npos);
  EXPECT_NE(ReadText(folder_ / "out" / (folder_.filename().string() + ".rig.analysis.html"))
                .find("Campbell diagram"),
            std::string::npos);
  EXPECT_NE(ReadText(folder_ / "out" / (folder_.filename().string() + ".rig.analysis.html"))
                .find("joint disk margin"),
            std::string::npos);
  EXPECT_EQ(Ambrig("analyze rig.toml --speed 3000 -o out").exit,
            0);  // the same command, the same bytes
  EXPECT_EQ(json, ReadText(folder_ / "out" / (folder_.filename().string() + ".rig.analysis.json")));
}

}  // namespace
}  // namespace ambrig
