// The corridor between a set-point and the follower that the bus allows.
#include "fdd/detectors/current_error.h"

#include <gtest/gtest.h>

#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

/// Readings and set-points as given; the voltage does not count here.
class ErrorBench {
 public:
  explicit ErrorBench(double kp = Bridge().kp) : bench_(WithGain(kp)), detector_(SetupOf(bench_)) {}
  Lane Period(double current, double set_point) {
    for (Lane& sample : adc_)
      for (double& i : sample.v) i = current;
    for (double& i : set_point_.v) i = set_point;
    MeasuredPeriod in;
    in.adc = adc_;
    in.duty = &bench_.duty;
    in.set_point = &set_point_;
    in.bus = 30;
    return detector_.Period(in);
  }
  Lane Without() {
    MeasuredPeriod in;
    in.adc = adc_;
    in.duty = &bench_.duty;
    return detector_.Period(in);
  }

 private:
  static Bench WithGain(double kp) {
    Bench bench;
    bench.amplifier.kp = kp;
    return bench;
  }
  Bench bench_;
  CurrentErrorDetector detector_;
  Lane adc_[kSamples], set_point_;
};

TEST(CurrentError, IsTheLeastOfTheLastFivePeriods) {
  ErrorBench b;
  for (int n = 0; n < 6; ++n) b.Period(2, 2);
  for (int n = 0; n < CurrentErrorDetector::kPeriods - 1; ++n)
    EXPECT_EQ(b.Period(1.5, 2)[3], 0) << n;
  EXPECT_NEAR(b.Period(1.5, 2)[3], 0.5, 1e-12);
  EXPECT_EQ(b.Period(2, 2)[3], 0);  // one good period clears it
}

TEST(CurrentError, ACurrentOnItsWayIsNoError) {
  ErrorBench b;
  for (int n = 0; n < 6; ++n) b.Period(1, 1);
  // The set-point jumps by 2 A, the current comes at a tenth of what the bus allows each period.
  double current = 1;
  for (int n = 0; n < 8; ++n) {
    current += 0.05;
    EXPECT_LT(b.Period(current, 3)[0], 2 - 0.05 * n) << n;
  }
  // Beyond the set-point it is one.
  double last = 0;
  for (int n = 0; n < CurrentErrorDetector::kPeriods; ++n) last = b.Period(3.4, 3)[0];
  EXPECT_NEAR(last, 0.4, 1e-12);
}

TEST(CurrentError, SaysNothingWithoutASetPoint) {
  ErrorBench b;
  for (int n = 0; n < 10; ++n)
    for (double v : b.Without().v) EXPECT_EQ(v, 0);
}

// A regulator that asks for more voltage than one period can use: the follower is at the set-point
// after one period and does not pass it, so that what is beyond by 0.1 A is wrong by 0.1 A from the
// first period on.
TEST(CurrentError, AFastLoopsFollowerEndsAtItsSetPoint) {
  ErrorBench b(400);
  for (int n = 0; n < 6; ++n) b.Period(2, 2);
  double last = 0;
  for (int n = 0; n < CurrentErrorDetector::kPeriods; ++n) last = b.Period(2.3, 2.2)[6];
  EXPECT_NEAR(last, 0.1, 1e-12);
}

}  // namespace
}  // namespace ambrig
