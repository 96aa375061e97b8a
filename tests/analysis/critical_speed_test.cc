// Modes followed over the speed, critical speeds, narrow peaks and the unbalance response against
// the run.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/rig_analysis.h"
#include "core/math/constants.h"
#include "rig/rig_file.h"
#include "simulation/switching/switching_engine.h"
#include "tests/cli/cli_run.h"
#include "tests/rig/exact_coils.h"

namespace ambrig {
namespace {

using Complex = std::complex<double>;

const std::string kTum = AMBRIG_SOURCE_DIR "/examples/tum_mbtr/";

RigParameters Tum(const std::string& damping, const std::string& gravity) {
  std::string text =
      Replaced(ReadText(kTum + "rig.toml"), "modal_damping = 0.002", "modal_damping = " + damping);
  return WithExactCoils(ReadRigText(
      Replaced(text, "gravity = [0.0, -9.81, 0.0]", "gravity = " + gravity), kTum + "rig.toml"));
}

ClosedLoopMode Made(Complex s, const Eigen::Vector2cd& q) {
  ClosedLoopMode m;
  m.s = s;
  m.zeta = -s.real() / std::abs(s);
  m.q = q;
  m.rotor_share = 0.9;
  m.lateral = true;
  return m;
}

// Two modes that cross: each goes on as itself, and each meets the speed where its own line does.
TEST(Campbell, FollowsThroughACrossingAndFindsWhereItMeetsTheSpeed) {
  std::vector<ClosedLoopModes> rows;
  for (int k = 0; k <= 20; ++k) {
    const double speed = 10.0 * k;
    ClosedLoopModes row;
    row.speed = speed;
    row.modes = {Made({-1, 100 + 0.2 * speed}, {1, Complex(0, -1)}),
                 Made({-2, 130 - 0.2 * speed}, {1, Complex(0, 1)})};
    if (row.modes[0].s.imag() > row.modes[1].s.imag()) std::swap(row.modes[0], row.modes[1]);
    rows.push_back(row);
  }
  const auto tracks = FollowModes(rows);
  ASSERT_EQ(tracks.size(), 2u);
  for (const ModeTrack& t : tracks) {
    ASSERT_EQ(t.modes.size(), 21u);
    for (const ClosedLoopMode& m : t.modes) EXPECT_EQ(m.s.real(), t.modes.front().s.real());
  }
  const auto criticals = FindCriticals(tracks);
  ASSERT_EQ(criticals.size(), 2u);
  EXPECT_NEAR(criticals[0].speed, 130 / 1.2, 1e-9);
  EXPECT_NEAR(criticals[1].speed, 100 / 0.8, 1e-9);
}

// A bending mode of less than 1 %: its peak is narrower than the steps of the sweep, and stands for
// AF = 1/(2 ζ) all the same. Without gravity the bearings are alike in x and y, so only the forward
// mode answers.
TEST(Unbalance, ANarrowPeakHasItsAmplification) {
  AnalysisOptions o;
  o.lowest = 60;
  o.highest = 300;
  o.fastest = 450;
  const RigAnalysis a = Analyse(Tum("0.002", "[0.0, 0.0, 0.0]"), o);
  const DampedCritical* first = nullptr;
  for (const DampedCritical& c : a.criticals)
    if (!first && c.mode.sense() == Whirl::kForward) first = &c;
  ASSERT_NE(first, nullptr);
  EXPECT_LT(first->mode.zeta, 0.01);
  const OrderTrack& middle = a.unbalance[2].tracks[0];
  ASSERT_FALSE(middle.peaks.empty());
  EXPECT_NEAR(middle.peaks[0].speed / first->speed, 1, 2e-3);
  EXPECT_FALSE(middle.peaks[0].bound);
  EXPECT_NEAR(middle.peaks[0].amplification * 2 * first->mode.zeta, 1, 0.06);
  // Modes stand exactly at the operating speeds.
  for (double speed : {0.0, 60.0, 300.0})
    EXPECT_TRUE(std::any_of(a.rows.begin(), a.rows.end(), [&](const ClosedLoopModes& r) {
      return r.speed == speed;
    })) << speed;
}

/// a and b of x = mean + a cos θ + b sin θ as a - i b, by least squares over whole turns.
Complex Order1(const Record& r, const char* channel, double speed, double from) {
  const Channel* c = r.Find(channel);
  Complex sum = 0;
  double mean = 0, n = 0;
  const double span =
      2 * kPi / speed * std::floor((r.TimeAt(r.rows() - 1) - from) * speed / (2 * kPi));
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t k = 0; k < r.rows(); ++k) {
      const double t = r.TimeAt(k);
      if (t < from || t >= from + span) continue;
      if (pass == 0) mean += c->samples[k], n += 1;
      if (pass == 1) sum += 2.0 / n * (c->samples[k] - mean / n) * std::polar(1.0, -speed * t);
    }
  return sum;
}

// Unbalance of the disk in the switching rig, its orbit at the sensors beside the computed one:
// below, between and above the first two critical speeds. Damping of 5 % so that the start has gone
// after a second.
TEST(Unbalance, ResponseIsThatOfTheSwitchingRig) {
  const RigParameters rig = Tum("0.05", "[0.0, -9.81, 0.0]");
  const OperatingPoint point = FindOperatingPoint(rig);
  for (const double speed : {80.0, 200.0, 420.0}) {
    const ClosedLoop loop(point, speed);
    const Eigen::VectorXcd y =
        UnbalanceAt(point, loop, {"", {{rig.FindStation("disk")->z, 1e-5, 0}}});
    const Scenario s = ReadScenarioText(
        "duration = 2.0\nrecord_rate = 12500.0\nnoise = false\n[speed]\nprofile = [[0.0, " +
            std::to_string(speed) + "]]\n",
        kTum + "test.toml", rig);
    const Record r = SwitchingEngine(rig, s, {}).Run().record;
    const char* names[] = {"A.x", "A.y", "B.x", "B.y"};
    for (int a = 0; a < 4; ++a) {
      const Complex run = Order1(r, names[a], speed, 1.2), computed = y(loop.Reading(a));
      EXPECT_LT(std::abs(run - computed), 0.02 * std::abs(computed))
          << names[a] << " at " << speed << ": " << run << " and " << computed;
    }
  }
}

// A force at the middle disk of the flexible rig: reciprocal with a force at a bearing, and at rest
// the first resonance of the disk is the first mode.
TEST(Planes, ResponsesOfNamedPlanesOfTheShaft) {
  const RigParameters rig = Tum("0.002", "[0.0, 0.0, 0.0]");
  const OperatingPoint point = FindOperatingPoint(rig);
  const ClosedLoop loop(point, 0);
  const TransferFunction transfer(point, loop);
  const auto between = [&](const char* in, const char* out, double f) {
    return transfer.Between(transfer.FindInput(in), transfer.FindOutput(out), 2 * kPi * f);
  };
  // At one plane a named station is the bearing: lamination_a sits at A.
  for (double f : {5.0, 40.0, 90.0, 300.0}) {
    EXPECT_LT(std::abs(between("lamination_a.x.load", "lamination_a.x", f) -
                       between("A.x.load", "A.x.shaft", f)),
              1e-9 * std::abs(between("A.x.load", "A.x.shaft", f)));
    // The controllers of A and B are alike and collocated, so force and motion may change places.
    EXPECT_LT(
        std::abs(between("disk.x.load", "A.x.shaft", f) / between("A.x.load", "disk.x", f) - 1.0),
        0.01)
        << f;
  }
  double best = 0, at = 0;
  for (double f = 14; f < 19; f += 0.02)
    if (const double size = std::abs(between("disk.y.load", "disk.y", f)); size > best)
      best = size, at = f;
  double nearest = 1e9;
  for (const ClosedLoopMode& m : FindModes(point, loop).modes)
    nearest = std::min(nearest, std::abs(m.frequency - at));
  EXPECT_LT(nearest, 0.03);
  EXPECT_THROW(transfer.FindInput("wheel.x.load"), InputError);
  EXPECT_THROW(transfer.FindOutput("disk.z"), InputError);
}

}  // namespace
}  // namespace ambrig
