// Figures of a contact from paths that are written down.
#include "simulation/verdict/drop_figures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/constants.h"
#include "tests/actuators/magnetics/reference_lanes.h"

namespace ambrig {
namespace {

constexpr double kRate = 1e4, kDropClearance = 2e-4;

template <class X, class Y>
CentrePath Path(const std::string& bearing, int rows, const X& x, const Y& y) {
  CentrePath p;
  p.bearing = bearing;
  p.clearance = kDropClearance;
  for (int k = 0; k < rows; ++k) {
    p.x.push_back(x(k / kRate));
    p.y.push_back(y(k / kRate));
  }
  return p;
}

DropPaths Paths(std::vector<CentrePath> bearings, double Omega) {
  DropPaths d;
  d.rate = kRate;
  d.start = 0.5;
  d.bearings = std::move(bearings);
  d.Omega.assign(d.bearings[0].x.size(), Omega);
  return d;
}

double Zero(double) { return 0; }

// A path that reaches the clearance at 30 ms on a straight line of 10 mm/s, in the second bearing.
TEST(DropFigures, TheFirstTouchIsInterpolated) {
  const DropPaths d = Paths({Path("A", 1000, Zero, Zero),
                             Path(
                                 "B", 1000, [](double t) { return (t - 0.01005) * 0.01; }, Zero)},
                            100);
  const DropFigures f = MakeDropFigures(ReferenceLanesRig(), {}, d);
  EXPECT_EQ(f.first, "B");
  EXPECT_NEAR(f.touchdown_time, 0.5 + 0.03005, 1e-9);
  EXPECT_FALSE(f.touchdown);  // the run's own verdict, not the path's
  EXPECT_NEAR(f.severity, 0.01 / (100 * kDropClearance), 1e-6);
  EXPECT_NEAR(f.fall_severity, 0.01 / std::sqrt(2 * 9.81 * kDropClearance), 1e-6);
  EXPECT_NEAR(f.rest[1][0], (0.095 - 0.01005) * 0.01, 1e-6);  // mean of the last tenth
  EXPECT_EQ(f.rest[0][0], 0);
}

TEST(DropFigures, APathInsideTouchesNothing) {
  const DropPaths d = Paths({Path(
                                "A", 500, [](double) { return 1e-4; }, Zero)},
                            100);
  const DropFigures f = MakeDropFigures(ReferenceLanesRig(), {}, d);
  EXPECT_TRUE(f.first.empty());
  EXPECT_EQ(f.touchdown_time, -1);
  EXPECT_EQ(f.peak_orbit, 0);
  EXPECT_EQ(f.whirl, ContactWhirl::kNone);
  EXPECT_NEAR(f.rest[0][0], 1e-4, 1e-15);
}

/// On a circle just beyond the clearance, `turns` round in 0.2 s.
DropPaths Whirling(double turns, double Omega) {
  const double r = 1.05 * kDropClearance, w = 2 * kPi * turns / 0.2;
  return Paths({Path(
                   "A", 2001, [=](double t) { return r * std::cos(w * t); },
                   [=](double t) { return r * std::sin(w * t); })},
               Omega);
}

TEST(DropFigures, WhirlIsCountedWithTheRotation) {
  const RigParameters& rig = ReferenceLanesRig();
  DropFigures f = MakeDropFigures(rig, {}, Whirling(3, 200));
  EXPECT_NEAR(f.turns, 3, 1e-6);
  EXPECT_EQ(f.whirl, ContactWhirl::kForward);
  EXPECT_NEAR(f.peak_orbit, 1.05 * kDropClearance, 1e-12);
  EXPECT_NEAR(f.severity, 2 * kPi * 15 * 1.05 / 200, 1e-4);  // speed over Omega c
  f = MakeDropFigures(rig, {}, Whirling(3, -200));
  EXPECT_NEAR(f.turns, -3, 1e-6);
  EXPECT_EQ(f.whirl, ContactWhirl::kBackward);
  f = MakeDropFigures(rig, {}, Whirling(-0.3, 200));
  EXPECT_EQ(f.whirl, ContactWhirl::kNone);  // less than half a turn
  f = MakeDropFigures(rig, {}, Whirling(2, 0));
  EXPECT_EQ(f.severity, 0);  // at standstill only the fall's
  EXPECT_GT(f.fall_severity, 0);
}

// Down to the stop at 20 ms, back up to a radius of 0.05 mm, and down again.
TEST(DropFigures, TheReboundIsTheClearanceRegained) {
  const auto y = [](double t) {
    if (t < 0.02) return -t / 0.02 * kDropClearance;
    if (t < 0.021) return -1.02 * kDropClearance;
    const double u = (t - 0.041) / 0.02;
    return -(0.25 + 0.77 * std::min(1.0, u * u)) * kDropClearance;
  };
  const DropFigures f =
      MakeDropFigures(ReferenceLanesRig(), {}, Paths({Path("A", 1000, Zero, y)}, 100));
  EXPECT_NEAR(f.touchdown_time, 0.52, 2e-4);
  EXPECT_NEAR(f.rebound, 0.75 * kDropClearance, 0.01 * kDropClearance);
}

TEST(DropFigures, RunsPartWhereTheirCentresDo) {
  const DropPaths a = Paths({Path("A", 500, Zero, Zero), Path("B", 500, Zero, Zero)}, 1);
  DropPaths b = a;
  EXPECT_EQ(PartingTime(a, b, 0.05), -1);
  b.bearings[1].x[200] = 0.04 * kDropClearance;  // not yet
  b.bearings[1].x[300] = 0.06 * kDropClearance;
  b.bearings[0].y[350] = 0.06 * kDropClearance;
  EXPECT_NEAR(PartingTime(a, b, 0.05), 0.5 + 0.03, 1e-12);
  b.rate = 1;
  EXPECT_THROW(PartingTime(a, b, 0.05), std::logic_error);
}

TEST(DropFigures, PathsAreThoseOfBearingsWithAStop) {
  Record r;
  r.rate = kRate;
  for (const char* name : {"A.r.x", "A.r.y", "B.r.x", "B.r.y", "omega"})
    r.channels.push_back({name, "m", {1, 2, 3}});
  const DropPaths d = CentrePaths(ReferenceLanesRig(), r);
  ASSERT_EQ(d.bearings.size(), 2u);
  EXPECT_EQ(d.bearings[1].bearing, "B");
  EXPECT_EQ(d.bearings[0].clearance, kDropClearance);
  EXPECT_EQ(d.Omega.size(), 3u);
  r.channels.erase(r.channels.begin());
  EXPECT_THROW(CentrePaths(ReferenceLanesRig(), r), std::logic_error);
}

}  // namespace
}  // namespace ambrig
