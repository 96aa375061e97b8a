// What the windows of one phase tell, against the simulator's own stator.
#include "fdd/examination/phase_window.h"

#include <gtest/gtest.h>

#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

// The voltage of a healthy coil is the flux slope that the others tell, its leakage and its copper:
// v = F + L_l di/dt + R i. Every second coil, all of one winding sense, has 5 ohm: a charge that
// lags by a sample would miss R h di/dt of each of them, 0.2 V, and their sum is what a coil
// between them is told.
TEST(PhaseWindow, TheOthersTellTheFluxOfAHealthyCoil) {
  Bench bench;
  LinkageModel m = MakeLinkageModel(Reference());
  for (int j = 0; j < kLanes; ++j) {
    m.resistance[j] = bench.lanes.resistance[j] = j % 2 ? 5 : 0.5;
    bench.duty[j] = j % 2 ? 0.66 : 0.53;
  }
  bench.lanes.SetStep(kT / kSamples);
  DetectorSettings s;
  s.sampling = bench.Sampling();
  for (int n = 0; n < 4; ++n) {
    KeptPeriod kept;
    kept.Keep(bench.Run(), kSamples);
    for (int j = 0; j < kLanes; ++j) {
      std::vector<PhaseWindow> windows;
      AddWindows(m, s, kept, j, &windows);
      ASSERT_EQ(windows.size(), 2U);
      for (const PhaseWindow& w : windows) {
        EXPECT_NEAR(w.F + w.x_l + w.x_r, w.v, 0.3) << n << " " << j << " " << w.phase;
        EXPECT_NEAR(w.x_r, m.resistance[j] * w.mean, 1e-12);
      }
    }
  }
}

TEST(PhaseWindow, SlopeOfAStraightLine) {
  double y[12];
  for (int k = 0; k < 12; ++k) y[k] = 3 - 0.5 * k;
  EXPECT_NEAR(SlopeOf(y, 2, 9, 1e-3), -500, 1e-9);
  y[6] += 1;  // the middle of 2 .. 10 does not turn the line
  EXPECT_NEAR(SlopeOf(y, 2, 9, 1e-3), -500, 1e-9);
}

}  // namespace
}  // namespace ambrig
