// Which detector watches a run, and what becomes of the alarms of one that only flags.
#include "fdd/detectors/run_detector.h"

#include <gtest/gtest.h>

#include "core/base/errors.h"
#include "fdd/detectors/examined_detector.h"
#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

RunDetectorSetup RunSetupOf(const Bench& bench) {
  RunDetectorSetup s;
  s.model = MakeLinkageModel(Reference());
  s.settings.sampling = bench.Sampling();
  s.bearing = "A";
  return s;
}

/// Its statistic is 2 for coil 3 (from 0) in every period.
class AlwaysCoil3 : public CoilDetector {
 public:
  Lane Period(const MeasuredPeriod&) override {
    Lane out;
    out[3] = 2;
    return out;
  }
};

CoilDetectorKind Planted() {
  return {"planted",
          "-",
          "coil 3 always",
          kRequired,
          1,
          [](const CoilDetectorSetup&) -> std::unique_ptr<CoilDetector> {
            return std::make_unique<AlwaysCoil3>();
          }};
}

TEST(RunDetector, AnUnknownNameIsOneLineThatNamesAllDetectors) {
  Bench bench;
  try {
    MakeRunDetector("coupeld", "rig.toml:7: detection.kind", RunSetupOf(bench));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).find("rig.toml:7: detection.kind = \"coupeld\", allowed: "), 0);
    for (const CoilDetectorKind& k : CoilDetectorKinds())
      EXPECT_NE(std::string(e.what()).find(k.name), std::string::npos) << k.name;
  }
}

TEST(RunDetector, EveryDetectorOfTheCatalogueWatchesAHealthyBearingWithoutADiagnosis) {
  for (const CoilDetectorKind& k : CoilDetectorKinds()) {
    if (!k.make) continue;  // commissioned ones need their file
    Bench bench;
    bench.x0 = bench.y0 = 0;
    const auto detector = MakeRunDetector(std::string(k.name), "", RunSetupOf(bench));
    for (int n = 0; n < 40; ++n) {
      MeasuredPeriod in = bench.Run();
      const Lane set_point = bench.adc[0];
      in.set_point = &set_point;
      EXPECT_EQ(detector->Period(in).diagnosis.cls, FaultClass::kNone) << k.name << " " << n;
    }
  }
}

// 8 periods of start, an alarm, 12 of examination with nothing found, 25 of waiting, and again.
TEST(RunDetector, AFlagOfAHealthyCoilIsExaminedClearedAndHeldOff) {
  Bench bench;
  bench.x0 = bench.y0 = 0;
  ExaminedDetector detector(Planted(), RunSetupOf(bench));
  std::vector<int> raised, cleared;
  for (int n = 0; n < 100; ++n) {
    const DetectorAlarm a = detector.Period(bench.Run());
    EXPECT_EQ(a.diagnosis.cls, FaultClass::kNone) << n;
    if (a.raised) {
      EXPECT_EQ(a.coil, 3);
      raised.push_back(n);
    }
    if (a.cleared) cleared.push_back(n);
  }
  ASSERT_GE(raised.size(), 2U);
  ASSERT_GE(cleared.size(), 2U);
  EXPECT_EQ(raised[0], 8);
  EXPECT_EQ(cleared[0] - raised[0], 12);
  EXPECT_EQ(raised[1] - cleared[0], 25);
}

TEST(RunDetector, TheThresholdOfTheRigFileReplacesTheCataloguesOne) {
  Bench bench;
  RunDetectorSetup setup = RunSetupOf(bench);
  EXPECT_EQ(ExaminedDetector(Planted(), setup).threshold(), 1);
  setup.threshold = 2.5;
  ExaminedDetector deaf(Planted(), setup);
  EXPECT_EQ(deaf.threshold(), 2.5);
  for (int n = 0; n < 20; ++n) EXPECT_FALSE(deaf.Period(bench.Run()).raised);
}

// The flag names a neighbour; the examination of the samples finds the coil that is open.
TEST(RunDetector, TheExaminationNamesTheFaultyCoilOfAnAlarmThatNamesAnother) {
  Bench bench;
  bench.x0 = bench.y0 = 0;
  ExaminedDetector detector(Planted(), RunSetupOf(bench));
  for (int n = 0; n < 8; ++n) detector.Period(bench.Run());
  bench.lanes.Break(2, 0, 0);
  Diagnosis found;
  for (int n = 0; n < 12 && found.cls == FaultClass::kNone; ++n)
    found = detector.Period(bench.Run()).diagnosis;
  EXPECT_EQ(found.coil, 2);
  EXPECT_EQ(found.cls, FaultClass::kOpen);
}

}  // namespace
}  // namespace ambrig
