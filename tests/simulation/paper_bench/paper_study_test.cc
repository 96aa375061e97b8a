// The seed paper's bench against the paper's numbers and against the exponentials of one coil.
#include "simulation/paper_bench/paper_study.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/base/errors.h"
#include "rig/rig_file.h"
#include "simulation/simulate.h"

namespace ambrig {
namespace {

constexpr const char* kFolder = AMBRIG_SOURCE_DIR "/examples/paper";

/// Worked once; a converter of 8 and one of 14 bits.
const PaperStudy& Study() {
  static const PaperStudy study = [] {
    PaperStudyOptions options;
    options.bits = {8, 14};
    return RunPaperStudy(kFolder, options);
  }();
  return study;
}

TEST(PaperStudy, TheoryIsThePublishedRange) {
  EXPECT_NEAR(Study().theory.low, 16761, 0.5);
  EXPECT_NEAR(Study().theory.high, 16857, 0.5);
  EXPECT_NEAR(Study().i0, 0.5, 0.005);
}

// i(t) = I + (i0 - I) exp(-t/tau), I = (U - 2 U_s)/R: its mean slope over the first and the last
// of nine sampling intervals, from the current at which the simulated on-phase starts.
TEST(PaperStudy, SimulatedSlopesAreTheExponentialsOfTheCoil) {
  const double tau = 3.5e-3, I = 29.75 / 0.5, Tn = 1 / 450e3;
  const auto slope = [&](double t0) {
    return (Study().i0 - I) * (std::exp(-(t0 + Tn) / tau) - std::exp(-t0 / tau)) / Tn;
  };
  EXPECT_NEAR(Study().simulated.high, slope(0), 0.5);
  EXPECT_NEAR(Study().simulated.low, slope(8 * Tn), 0.5);
  EXPECT_LT(Study().simulated.high, Study().theory.high + 1.5);  // i0 is not 0.5 A to the last mA
  EXPECT_GT(Study().simulated.low, Study().theory.low);
}

// Eq. 10: d k = dU/L; Eq. 21: d k = k dL/L. The steps of 1 A: twice the slope at half L.
TEST(PaperStudy, ErrorsFollowTheEquations) {
  EXPECT_NEAR(Study().errors.analogue, 0.02 / 1.75e-3, 0.2);
  EXPECT_NEAR(Study().errors.bus, 1 / 1.75e-3, 3);
  EXPECT_NEAR(Study().errors.gap, 16810.0 * 1.1e-5 / 1.75e-3, 2);
  EXPECT_NEAR(Study().errors.shift, 0.4e-3 * 1.1e-5 / 1.761e-3, 1e-9);
  const double k2 = Study().steps[0].slopes.increasing.back(),
               k1 = Study().steps[1].slopes.increasing.back();
  EXPECT_NEAR(k2, (29.75 - 0.9 * 0.5) / 2e-3, 60);
  EXPECT_NEAR(k1, (29.75 - 0.9 * 0.2) / 1e-3, 120);
  // The step is followed: means over a switching period before it and at the end.
  const std::vector<double>& i = Study().steps[0].result.record.Find("M.i1")->samples;
  const auto mean = [&](std::size_t period) {
    double sum = 0;
    for (std::size_t k = 0; k < 18; ++k) sum += i[18 * period + k] / 18;
    return sum;
  };
  EXPECT_NEAR(mean(25), 0, 0.02);
  EXPECT_NEAR(mean(490), 1, 0.02);
  EXPECT_NEAR(Study().steps[0].slopes.i0.back(), 1 - 0.5 * 29.75 / 2e-3 * 20e-6, 0.02);
}

TEST(PaperStudy, HealthyPeriodsStayWithinThePapersBudget) {
  EXPECT_EQ(Study().healthy.slopes.t.size(), 2000u);
  EXPECT_LT(Study().half_spread, kPaperMargin);
  EXPECT_GT(Study().half_spread, 50);  // noise and bus pumping are there
  EXPECT_NEAR(Study().bus_peak, 1, 0.3);
  EXPECT_LT(Study().healthy.look.flagged, 0);
}

TEST(PaperStudy, FaultsAreFlaggedWithinACycle) {
  for (const PaperRun* run : {&Study().open, &Study().shorted}) {
    const DiagnosisDelays& d = run->delays;
    EXPECT_EQ(d.runs, 44);
    EXPECT_EQ(d.found, 44);
    EXPECT_EQ(d.named, 44) << run->scenario.name;
    EXPECT_EQ(d.too_early, 0);
    EXPECT_GT(d.least, 0);
    EXPECT_LT(d.most, 2e-3);
    EXPECT_GT(d.most, 1.6e-3);  // a fault just after a look waits for the next one
    EXPECT_NEAR(d.mean, kPaperCycle / 2, 0.2e-3);
  }
}

TEST(PaperStudy, EightBitsAreTooFew) {
  const ConverterRow &coarse = Study().converters[0], &fine = Study().converters[1];
  EXPECT_EQ(coarse.bits, 8);
  EXPECT_DOUBLE_EQ(coarse.step, 5.0 / 256 * 450e3);
  EXPECT_DOUBLE_EQ(fine.step * 64, coarse.step);
  EXPECT_GT(coarse.rms, 2 * fine.rms);
  EXPECT_GT(coarse.largest, kPaperMargin);
  EXPECT_GT(coarse.outside, fine.outside);
  EXPECT_LT(fine.largest, kPaperMargin);
}

TEST(PaperStudy, RefusesWhatIsNoSuchBench) {
  try {
    RunPaperStudy(AMBRIG_SOURCE_DIR "/examples/rub", {});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("examples/rub/step_2mH.toml: no such file"));
  }
  RigParameters rig = Study().healthy.rig;
  rig.bearings[0].opposed.coils = 2;
  EXPECT_THROW(SingleCoil(rig), InputError);
  Record slow = Study().healthy.result.record;
  slow.rate = 25e3;
  EXPECT_THROW(SlopesOf(Study().healthy.rig, slow, 0), InputError);
  Scenario two = Study().open.scenario;
  two.faults.push_back(two.faults[0]);
  EXPECT_THROW(DelaysOverCycle(Study().open.rig, two, kPaperCycle, kPaperMargin), InputError);
}

}  // namespace
}  // namespace ambrig
