// The resistance of a coil while it runs, on the simulator's stator: the weighted mean of what it
// shows and of the drawing's.
#include "fdd/detectors/resistance_estimate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

/// Two amperes in every coil, 1.4 A at 0.7 ohm.
void SetDuty(Bench& bench) {
  for (double& d : bench.duty.v) d = 0.53;
}

double SquareOf(const Bench& bench, int coil) {
  double mean = 0;
  for (const Lane& one : bench.adc) mean += one[coil] / kSamples;
  return mean * mean;
}

// In a settled period the linkage comes back to where it was: mean voltage = R mean current. With
// the memory of 0.1 s the estimate is (i² n R + 4000 R0)/(i² n + 4000), n = 2500 (1 - e^(-t/0.1 s))
// periods.
TEST(ResistanceEstimate, WeighsTheRunAgainstTheDrawing) {
  Bench bench;
  SetDuty(bench);
  bench.lanes.resistance[2] = 0.7;
  bench.lanes.SetStep(kT / kSamples);
  for (int k = 0; k < 5000; ++k) bench.Run();  // 0.2 s: the currents settle
  ResistanceEstimate estimate(SetupOf(bench));
  EXPECT_EQ(estimate.Value(2), 0.5);
  for (const int periods : {1000, 4000, 20000}) {
    ResistanceEstimate fresh(SetupOf(bench));
    for (int k = 0; k < periods; ++k) fresh.Add(bench.Run());
    const double n = 2500 * (1 - std::pow(1 - kT / 0.1, periods));
    for (const int coil : {2, 5}) {
      const double weight = n * SquareOf(bench, coil), R = coil == 2 ? 0.7 : 0.5;
      EXPECT_NEAR(fresh.Value(coil), (weight * R + 4000 * 0.5) / (weight + 4000), 2e-4)
          << coil << " " << periods;
    }
  }
}

TEST(ResistanceEstimate, StaysBetweenHalfAndTwiceTheDrawing) {
  for (const double share : {0.1, 8.0}) {
    Bench bench;
    SetDuty(bench);
    CoilDetectorSetup setup = SetupOf(bench);
    for (int j = 0; j < kLanes; ++j) setup.model.resistance[j] = 0.5 / share;
    ResistanceEstimate estimate(setup);
    for (int k = 0; k < 30000; ++k) estimate.Add(bench.Run());
    EXPECT_DOUBLE_EQ(estimate.Value(0), (share < 1 ? 0.5 : 2) * 0.5 / share);
  }
}

// Small currents tell nothing of a resistance.
TEST(ResistanceEstimate, WithoutCurrentTheDrawingStands) {
  Bench bench;
  for (double& d : bench.duty.v) d = 0.02;
  for (int k = 0; k < 3000; ++k) bench.Run();
  ResistanceEstimate estimate(SetupOf(bench));
  for (int k = 0; k < 3000; ++k) estimate.Add(bench.Run());
  for (int j = 0; j < kLanes; ++j) EXPECT_EQ(estimate.Value(j), 0.5);
}

}  // namespace
}  // namespace ambrig
