// What the detector of a run makes of conclusions that are not acted on, on the simulator's own
// stator under given duties.
#include "fdd/commissioned/commissioned_run.h"

#include <gtest/gtest.h>

#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

class WatchedBench {
 public:
  WatchedBench() {
    bench.noise = 0.004;
    bench.x0 = bench.y0 = 0;
    const CoilDetectorSetup setup = testing_bench::SetupOf(bench);
    CommissionedBearing learnt = NominalBearing("A", setup.model);
    learnt.learnt = true;
    for (double& v : learnt.largest_flux.v) v = 1e9;
    run = std::make_unique<CommissionedRun>(setup, learnt);
  }
  /// The first alarm within some periods.
  DetectorAlarm First(int periods) {
    DetectorAlarm alarm;
    for (int n = 0; n < periods && alarm.coil < 0; ++n) alarm = run->Period(bench.Run());
    return alarm;
  }
  testing_bench::Bench bench;
  std::unique_ptr<CommissionedRun> run;
};

// The coil goes on with all of its turns as far as the detector knows, and it says in doubt what it
// would conclude again; a coil that has no current at all is still named.
TEST(CommissionedRun, WhatIsNotActedOnIsTakenBackAndNotToldAgain) {
  WatchedBench b;
  EXPECT_LT(b.First(60).coil, 0);
  b.bench.lanes.ShortTurns(4, 0.3, kInfinity, 0, 0);
  const DetectorAlarm first = b.First(30);
  ASSERT_EQ(first.coil, 4);
  EXPECT_EQ(first.diagnosis.cls, FaultClass::kPartialShort);
  b.run->SetTurns(4, 1);
  EXPECT_LT(b.First(300).coil, 0);
  EXPECT_TRUE(b.run->doubtful());
  b.bench.lanes.Break(4, 0, 0);
  const DetectorAlarm open = b.First(60);
  ASSERT_EQ(open.coil, 4);
  EXPECT_EQ(open.diagnosis.cls, FaultClass::kOpen);
}

// Acted on, its share is that of the diagnosis: nothing is concluded and nothing is in doubt.
TEST(CommissionedRun, WhatIsActedOnIsBelieved) {
  WatchedBench b;
  EXPECT_LT(b.First(60).coil, 0);
  b.bench.lanes.ShortTurns(4, 0.3, kInfinity, 0, 0);
  ASSERT_EQ(b.First(30).coil, 4);
  EXPECT_LT(b.First(300).coil, 0);
  EXPECT_FALSE(b.run->doubtful());
}

}  // namespace
}  // namespace ambrig
