#include "fdd/commissioned/excess_windows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/noise.h"
#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

LinkageModel Radial() { return MakeLinkageModel(testing_bench::Reference()); }

SlopeExcess PeriodOf(const Lane& c, double weight) {
  SlopeExcess p;
  for (int j = 0; j < kLanes; ++j)
    for (int q = 0; q < 2; ++q) {
      p.bottom[q][j] = weight;
      p.top[q][j] = weight * c[j];
    }
  return p;
}

TEST(ExcessWindows, WhatIsCommonOrShiftsTheShaftDropsOut) {
  ExcessWindows windows(Radial());
  const LinkageModel m = Radial();
  Lane c;
  for (int j = 0; j < kLanes; ++j) c[j] = 0.3 + 0.2 * m.direction_x[j] - 0.1 * m.direction_y[j];
  windows.Add(PeriodOf(c, 1000), {});
  for (int j = 0; j < kLanes; ++j) EXPECT_NEAR(windows.Used(0, 1)[j], 0, 1e-12);
  EXPECT_NEAR(windows.Pattern(0), 0.3, 1e-12);
}

// Ampere-turns of one coil that are not what they are taken for are in all coils, with the sense of
// their windings: where that is taken off, too, a single coil's fault is left as large as it is.
TEST(ExcessWindows, TheSenseOfTheWindingsDropsOutWhereItIsTaken) {
  ExcessWindows windows(Radial());
  windows.TakeSense(true);
  const LinkageModel m = Radial();
  Lane c, alone;
  for (int j = 0; j < kLanes; ++j) c[j] = 0.1 + (m.n[j] < 0 ? -0.3 : 0.3);
  windows.Add(PeriodOf(c, 1000), {});
  for (int j = 0; j < kLanes; ++j) EXPECT_NEAR(windows.Used(0, 1)[j], 0, 1e-12);
  alone[3] = 0.4;
  windows.Add(PeriodOf(alone, 1000), {});
  for (int j = 0; j < kLanes; ++j) EXPECT_NEAR(windows.Used(0, 1)[j], alone[j], 1e-12);
  // With five coils left the faults of single ones would be taken off: the sense is not.
  for (const int coil : {0, 1, 6}) windows.Leave(coil);
  windows.Add(PeriodOf(alone, 1000), {});
  EXPECT_NEAR(windows.Used(0, 1)[3], 0.4, 1e-12);
  windows.TakeSense(false);
  windows.Add(PeriodOf(c, 1000), {});
  EXPECT_GT(std::abs(windows.Used(0, 1)[3]), 0.1);
}

// What is called calm has no used value beyond its band and no pattern beyond its limit, and a coil
// or a pattern that is beyond is never called calm.
TEST(ExcessWindows, CalmIsWhatNoUsedValueNorPatternDenies) {
  constexpr int kTen = 2;
  constexpr double kPattern = 0.02;
  ExcessWindows windows(Radial());
  Lane band[kExcessWindows];
  for (int w = 0; w < kExcessWindows; ++w)
    for (int j = 0; j < kLanes; ++j) band[w][j] = 2.5 * 0.1 / std::sqrt(kExcessWindow[w]);
  int calm = 0, denied = 0;
  for (std::uint64_t n = 0; n < 2000; ++n) {
    Lane c;
    for (int j = 0; j < kLanes; ++j) c[j] = 0.1 * Normal(5, static_cast<std::uint32_t>(j), n);
    windows.Add(PeriodOf(c, 1000), {});
    Lane used[kExcessWindows];
    windows.UsedOfAll(6, used);
    bool beyond = windows.Pattern(kTen) > kPattern;
    for (int w = 0; w < kExcessWindows; ++w)
      for (int j = 0; j < kLanes; ++j) beyond = beyond || std::abs(used[w][j]) > band[w][j];
    const bool said = windows.Calm(band, kTen, kPattern);
    EXPECT_FALSE(said && beyond) << n;
    calm += said;
    denied += beyond;
  }
  EXPECT_GT(calm, 50);
  EXPECT_GT(denied, 50);
}

TEST(ExcessWindows, OneCoilKeepsItsExcess) {
  ExcessWindows windows(Radial());
  Lane c;
  c[2] = 0.22;
  windows.Add(PeriodOf(c, 1000), {});
  EXPECT_NEAR(windows.Used(0, 1)[2], 0.22, 1e-12);
  for (int j = 0; j < kLanes; ++j)
    if (j != 2) {
      EXPECT_EQ(windows.Used(0, 1)[j], 0) << j;  // their raw value is zero
    }
}

// Two coils were given up: of the six that are left, too, what is common drops out and one alone
// keeps its excess.
TEST(ExcessWindows, TheCoilsThatAreLeftHaveAPatternOfTheirOwn) {
  const LinkageModel m = Radial();
  Lane common, alone;
  for (int j = 0; j < kLanes; ++j)
    common[j] = j == 0 || j == 3 ? 0 : 0.3 + 0.2 * m.direction_x[j] - 0.1 * m.direction_y[j];
  alone[4] = 0.22;
  ExcessWindows windows(m);
  windows.Leave(0);
  windows.Leave(3);
  windows.Add(PeriodOf(common, 1000), {});
  for (int j = 0; j < kLanes; ++j) {
    EXPECT_NEAR(windows.Used(0, 1)[j], 0, 1e-12) << j;
    if (j != 0 && j != 3) {
      EXPECT_NEAR(windows.Common(windows.Raw(0))[j], common[j], 1e-12) << j;
    }
  }
  windows.Add(PeriodOf(alone, 1000), {});
  EXPECT_NEAR(windows.Used(0, 1)[4], 0.22, 1e-12);
  // As if they had never been away.
  windows.Return(3);
  windows.Return(0);
  for (int j = 0; j < kLanes; ++j) common[j] = 0.3;
  windows.Add(PeriodOf(common, 1000), {});
  for (int j = 0; j < kLanes; ++j) EXPECT_NEAR(windows.Used(0, 1)[j], 0, 1e-12) << j;
}

TEST(ExcessWindows, WindowsAreRatiosOfSumsForEver) {
  ExcessWindows windows(Radial());
  std::vector<double> top, bottom;
  for (int n = 0; n < 1200; ++n) {
    Lane c;
    c[5] = Normal(3, 1, static_cast<std::uint64_t>(n));
    const double weight = 500 + 400 * std::sin(0.1 * n);
    windows.Add(PeriodOf(c, weight), {});
    top.push_back(2 * weight * c[5]);
    bottom.push_back(2 * weight);
    for (int w = 0; w < kExcessWindows; ++w) {
      if (n + 1 < kExcessWindow[w]) continue;
      double a = 0, b = 0;
      for (int k = 0; k < kExcessWindow[w]; ++k) {
        a += top[top.size() - 1 - static_cast<std::size_t>(k)];
        b += bottom[bottom.size() - 1 - static_cast<std::size_t>(k)];
      }
      ASSERT_NEAR(windows.Raw(w)[5], a / b, 1e-9) << n << " " << w;
    }
  }
}

TEST(ExcessWindows, AWindowNoisierThanAskedForSaysNothing) {
  ExcessWindows windows(Radial());
  Lane c;
  c[0] = 1;
  windows.Add(PeriodOf(c, 50), {});  // sd of c: 1/sqrt(100)
  EXPECT_EQ(windows.Used(0, 0.09)[0], 0);
  EXPECT_NEAR(windows.Used(0, 0.11)[0], 1, 1e-12);
}

// Of one phase: the ratio of its sums over the last periods, whatever the other phase says; nothing
// without weight.
TEST(ExcessWindows, OnePhaseIsTheRatioOfItsOwnSums) {
  ExcessWindows windows(Radial());
  double top = 0, bottom = 0;
  for (int n = 0; n < 7; ++n) {
    SlopeExcess p;
    for (int j = 0; j < kLanes; ++j) {
      p.top[0][j] = 0.1 * (n + 1) * (j + 1);
      p.bottom[0][j] = n + 1;
      p.top[1][j] = -3;
      p.bottom[1][j] = n < 4 ? 5 : 0;
    }
    windows.Add(p, {});
    if (n < 4) continue;
    top += 0.1 * (n + 1) * 3;
    bottom += n + 1;
  }
  EXPECT_NEAR(windows.OfPhase(2, 0, 3), top / bottom, 1e-12);
  EXPECT_NEAR(windows.OfPhase(5, 0, 40), 0.6, 1e-12);  // all seven
  EXPECT_EQ(windows.OfPhase(2, 1, 3), 0);
  EXPECT_NEAR(windows.OfPhase(2, 1, 4), -3.0 * 4 / 5, 1e-12);  // three of them without weight
}

}  // namespace
}  // namespace ambrig
