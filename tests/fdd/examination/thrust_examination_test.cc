// Two windings on one core, as thrust bearings have them: which of the two is faulty, and how.
#include <gtest/gtest.h>

#include "fdd/detectors/bearing_detector.h"
#include "rig/rig_file.h"
#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

/// The thrust bearing of the reference rig, held in the middle at its bias.
class ThrustBench {
 public:
  ThrustBench() {
    const RigParameters rig =
        ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/reference/rig.toml");
    geometry_ = GeometryOf(rig.Find("Z")->thrust);
    static_cast<StatorGeometry&>(bench_.lanes) = geometry_;
    bench_.lanes.SetStep(kT / kSamples);
    bench_.x0 = bench_.y0 = 0;
    bench_.noise = 0.004;
    Lane bias;
    for (int j = 0; j < geometry_.coils; ++j) bias[j] = 1.5;
    bench_.lanes.Settle(bias, 0, 0);
    for (int j = 0; j < geometry_.coils; ++j) bench_.duty[j] = 0.527;  // 0.9 V in the mean
  }
  void Short(int coil, double share) { bench_.lanes.ShortTurns(coil, share, kInfinity, 0, 0); }
  void Break(int coil) { bench_.lanes.Break(coil, 0, 0); }
  /// The first diagnosis within so many periods, readings of `coil` times `gain`.
  Diagnosis FirstOf(int periods, int coil = 0, double gain = 1) {
    for (int n = 0; n < periods; ++n) {
      const MeasuredPeriod in = bench_.Run();
      for (Lane& sample : bench_.adc) sample[coil] *= gain;
      const DetectorAlarm alarm = detector().Period(in);
      if (alarm.diagnosis.cls != FaultClass::kNone) return alarm.diagnosis;
    }
    return {};
  }

 private:
  BearingDetector& detector() {
    if (!detector_) {
      DetectorSettings s;
      s.sampling = bench_.Sampling();
      detector_ = std::make_unique<BearingDetector>(LinkageModel{geometry_}, s);
    }
    return *detector_;
  }
  StatorGeometry geometry_;
  Bench bench_;
  std::unique_ptr<BearingDetector> detector_;
};

TEST(ThrustExamination, AHealthyBearingIsLeftAlone) {
  ThrustBench b;
  EXPECT_EQ(b.FirstOf(200).cls, FaultClass::kNone);
}

TEST(ThrustExamination, TheShortedOneOfTwoWindingsIsNamed) {
  for (int coil = 0; coil < 4; ++coil)
    for (const double share : {0.2, 0.4}) {
      ThrustBench b;
      EXPECT_EQ(b.FirstOf(20).cls, FaultClass::kNone);
      b.Short(coil, share);
      const Diagnosis d = b.FirstOf(40);
      EXPECT_EQ(d.coil, coil) << coil << " " << share;
      EXPECT_EQ(d.cls, FaultClass::kPartialShort) << coil << " " << share;
      EXPECT_NEAR(d.fraction, share, 0.05) << coil;
    }
}

TEST(ThrustExamination, TheFalseOneOfTwoReadingsIsNamed) {
  for (int coil = 0; coil < 4; ++coil) {
    ThrustBench b;
    b.FirstOf(20);
    const Diagnosis d = b.FirstOf(40, coil, 0.6);
    EXPECT_EQ(d.coil, coil) << coil;
    EXPECT_EQ(d.cls, FaultClass::kCurrentSensor) << coil;
  }
}

TEST(ThrustExamination, AnOpenWindingIsNamed) {
  for (int coil = 0; coil < 4; ++coil) {
    ThrustBench b;
    b.FirstOf(20);
    b.Break(coil);
    const Diagnosis d = b.FirstOf(40);
    EXPECT_EQ(d.coil, coil);
    EXPECT_EQ(d.cls, FaultClass::kOpen) << coil;
  }
}

}  // namespace
}  // namespace ambrig
