// Shares of the turns of all coils, on the simulator's own stator whose gaps are not those that the
// detector believes.
#include "fdd/examination/joint_turns.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "fdd/learning/commissioned_model.h"
#include "rig/rig_file.h"
#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

/// A stator with 2 % of iron beside its gaps, and what the nominal equations say of it.
class JointTurnsBench {
 public:
  JointTurnsBench() {
    bench_.noise = 0.004;
    bench_.x0 = bench_.y0 = 0;
    bench_.lanes.reluctance.iron_path = 0.02 * Reference().gap;
    Run(6);
  }
  Bench& bench() { return bench_; }
  /// Periods with the readings as they are, or one of them times `gain`.
  void Run(int periods, int coil = 0, double gain = 1) {
    for (int n = 0; n < periods; ++n) {
      const MeasuredPeriod in = bench_.Run();
      for (Lane& sample : bench_.adc) sample[coil] *= gain;
      joint_.Keep(in, kSamples, filter_.state());
      filter_.Period(in, &period_);
    }
  }
  void Short(int coil, double share) {
    bench_.lanes.ShortTurns(coil, share, kInfinity, bench_.x0, bench_.y0);
  }
  std::optional<JointShares> Solve(const Lane& dead = {}) const {
    const CommissionedBearing nominal = NominalBearing("A", filter_.nominal());
    Lane all;
    for (double& v : all.v) v = 1;
    return joint_.Solve(filter_, nominal.coils, {}, all, dead);
  }
  JointTurns& joint() { return joint_; }

 private:
  Bench bench_;
  FluxFilter filter_{MakeLinkageModel(Reference()), bench_.Sampling(), {}};
  FluxPeriod period_;
  JointTurns joint_;
};

TEST(JointTurns, EverySetOfShortedCoilsIsSolvedWithItsShares) {
  for (unsigned set = 0; set < 256; set += 3) {
    JointTurnsBench b;
    const double lost[] = {0.5, 0.2, 0.3, 0.6, 0.15, 0.5, 0.4, 0.25};
    for (int j = 0; j < kLanes; ++j)
      if (set >> j & 1) b.Short(j, lost[j]);
    b.Run(JointTurns::kKept);
    const auto found = b.Solve();
    ASSERT_TRUE(found) << set;
    // A healthy coil stays well inside the tenth of its turns from which a coil is named.
    for (int j = 0; j < kLanes; ++j)
      EXPECT_NEAR(found->left[j], set >> j & 1 ? 1 - lost[j] : 1, 0.05) << set << " " << j;
  }
}

// What is left of a coil follows from its own c, but for its pull on the rotor's potential. With
// one polarity shorted the other hangs on that potential alone: an error of c moves its shares by
// several times as much.
TEST(JointTurns, SharesSayHowFarAnErrorMovesThem) {
  JointTurnsBench one, polarity;
  one.Short(0, 0.5);
  for (const int coil : {0, 2, 4, 6}) polarity.Short(coil, 0.5);
  one.Run(JointTurns::kKept);
  polarity.Run(JointTurns::kKept);
  const auto alone = one.Solve(), many = polarity.Solve();
  ASSERT_TRUE(alone && many);
  for (int j = 0; j < kLanes; ++j) {
    EXPECT_GT(alone->per_excess[j], 0.2) << j;
    EXPECT_LT(alone->per_excess[j], 1.3) << j;
  }
  for (const int j : {0, 2, 4, 6}) EXPECT_LT(many->per_excess[j], 0.5) << j;
  for (const int j : {1, 3, 5, 7}) EXPECT_GT(many->per_excess[j], 2) << j;
}

TEST(JointTurns, ACoilWithoutCurrentIsNoUnknown) {
  JointTurnsBench b;
  b.bench().lanes.Break(1, 0, 0);
  b.Short(4, 0.5);
  b.Run(JointTurns::kKept);
  Lane dead;
  dead[1] = 1;
  const auto found = b.Solve(dead);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->left[1], 1);
  EXPECT_NEAR(found->left[4], 0.5, 0.03);
  EXPECT_NEAR(found->left[0], 1, 0.04);
  EXPECT_NEAR(found->left[2], 1, 0.04);
}

// A reading that is too small asks for more turns than the coil was ever given.
TEST(JointTurns, AFalseReadingIsNotExplained) {
  for (int coil = 0; coil < kLanes; ++coil) {
    JointTurnsBench b;
    b.Run(JointTurns::kKept, coil, 0.7);
    EXPECT_FALSE(b.Solve()) << coil;
  }
}

/// The thrust bearing of the reference rig at its bias, with its nominal equations.
std::optional<JointShares> SharesOfThrust(const std::array<double, 4>& lost) {
  const RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/reference/rig.toml");
  const StatorGeometry geometry = GeometryOf(rig.Find("Z")->thrust);
  Bench bench;
  static_cast<StatorGeometry&>(bench.lanes) = geometry;
  bench.lanes.SetStep(kT / kSamples);
  bench.x0 = bench.y0 = 0;
  bench.noise = 0.004;
  Lane bias, all;
  for (int j = 0; j < geometry.coils; ++j) {
    bias[j] = 1.5;
    all[j] = 1;
    bench.duty[j] = 0.527;  // 0.9 V in the mean
  }
  bench.lanes.Settle(bias, 0, 0);
  FluxFilter filter{LinkageModel{geometry}, bench.Sampling(), {}};
  FluxPeriod period;
  JointTurns joint;
  for (int n = 0; n < 6 + JointTurns::kKept; ++n) {
    if (n == 6)
      for (int j = 0; j < geometry.coils; ++j)
        if (lost[static_cast<std::size_t>(j)] > 0)
          bench.lanes.ShortTurns(j, lost[static_cast<std::size_t>(j)], kInfinity, 0, 0);
    const MeasuredPeriod in = bench.Run();
    joint.Keep(in, kSamples, filter.state());
    filter.Period(in, &period);
  }
  return joint.Solve(filter, NominalBearing("Z", filter.nominal()).coils, {}, all, {});
}

// One winding that has lost turns is told from two that have, whichever it is and on both sides
// (0.7 would drive its current beyond the converter's range in these periods). Noise of a reading
// moves a share by some percent: the windings of a side differ in their leakage alone.
TEST(JointTurns, OfTheWindingsOfAThrustSideTheOneThatFailed) {
  const std::array<double, 4> sets[] = {{0.5, 0, 0, 0},  {0, 0.5, 0, 0},   {0, 0, 0.3, 0},
                                        {0, 0, 0, 0.6},  {0.5, 0, 0, 0.3}, {0.5, 0.5, 0, 0},
                                        {0, 0, 0.4, 0.4}};
  for (const auto& lost : sets) {
    const auto found = SharesOfThrust(lost);
    ASSERT_TRUE(found) << lost[0] << " " << lost[1] << " " << lost[2] << " " << lost[3];
    for (int j = 0; j < 4; ++j)
      EXPECT_NEAR(found->left[j], 1 - lost[static_cast<std::size_t>(j)], 0.05)
          << lost[0] << " " << lost[1] << " " << lost[2] << " " << lost[3] << ": " << j;
  }
}

TEST(JointTurns, NothingIsSolvedFromFewerPeriodsThanItKeeps) {
  JointTurnsBench b;
  b.joint().Clear();
  b.Run(JointTurns::kKept - 1);
  EXPECT_FALSE(b.Solve());
  b.Run(1);
  EXPECT_TRUE(b.Solve());
}

}  // namespace
}  // namespace ambrig
