// Bounds of what an unknown motion does to the coils' equations, against the simulator's own
// stator.
#include "fdd/measurement/motion_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

constexpr double kEquationError = 0.15;  // [V] of the equations themselves at these speeds

/// Largest |e| over all coils and phases, and whether every one is within what the uncertainty
/// allows.
struct Seen {
  double largest = 0, largest_bound = 0;
  bool within = true;
};
Seen Evaluate(const MeasuredPeriod& in, const Bench& bench) {
  const LinkageModel model = MakeLinkageModel(Reference());
  PeriodSlopes s;
  ComputePeriodSlopes(model, bench.Sampling(), in, &s);
  Lane bound[2];
  ResidualUncertainty(model, s, in.uncertainty, bound);
  Seen out;
  for (int q = 0; q < 2; ++q)
    for (int j = 0; j < kLanes; ++j) {
      const double e = std::abs(s.phase[q].residual[j]);
      out.largest = std::max(out.largest, e);
      out.largest_bound = std::max(out.largest_bound, bound[q][j]);
      out.within = out.within && e < bound[q][j] + kEquationError;
    }
  return out;
}

// The shaft is thrown back although the positions say that it goes on: no coil is off by more than
// the bound, and the bound is no larger than a few times what happens.
TEST(ResidualUncertainty, HoldsForAnUnseenVelocityInAllDirections) {
  for (int k = 0; k < 12; ++k)
    for (double v : {0.1, 0.4}) {
      Bench bench;
      const double ux = std::cos(k * 0.5236), uy = std::sin(k * 0.5236);
      bench.x0 = 1.5e-4 * ux;
      bench.y0 = 1.5e-4 * uy;
      bench.Run();
      bench.vx = -v * ux;
      bench.vy = -v * uy;
      MeasuredPeriod in = bench.Run();
      in.x1 = in.x0;
      in.y1 = in.y0;
      in.uncertainty = {v, 0.5 * v * kT};  // in the middle of the period half of the way
      const Seen seen = Evaluate(in, bench);
      EXPECT_TRUE(seen.within) << k << " " << v;
      EXPECT_GT(seen.largest, 10 * v) << k;
      EXPECT_LT(seen.largest_bound, 8 * seen.largest) << k;
    }
}

TEST(ResidualUncertainty, HoldsForAPositionThatIsWrong) {
  for (int k = 0; k < 12; ++k) {
    Bench bench;
    const double ux = std::cos(k * 0.5236), uy = std::sin(k * 0.5236), wrong = 1e-5;
    bench.x0 = 1.2e-4 * ux;
    bench.y0 = 1.2e-4 * uy;
    bench.Run();
    MeasuredPeriod in = bench.Run();
    in.x0 = in.x1 += wrong * ux;
    in.y0 = in.y1 += wrong * uy;
    in.uncertainty = {0, 1.2 * wrong};  // the gap that counts is the smaller one
    const Seen seen = Evaluate(in, bench);
    EXPECT_TRUE(seen.within) << k;
    EXPECT_GT(seen.largest, 0.5) << k;
    EXPECT_LT(seen.largest_bound, 8 * seen.largest) << k;
  }
}

TEST(ResidualUncertainty, NothingWithoutUncertainty) {
  Bench bench;
  PeriodSlopes s;
  const LinkageModel model = MakeLinkageModel(Reference());
  ComputePeriodSlopes(model, bench.Sampling(), bench.Run(), &s);
  Lane bound[2];
  ResidualUncertainty(model, s, {}, bound);
  for (int j = 0; j < kLanes; ++j)
    EXPECT_EQ(bound[0][j] + bound[1][j] + LinkageUncertainty(model, s, 0)[j], 0);
}

}  // namespace
}  // namespace ambrig
