// The noise of a current sensor, found from records whose rig file states another one, and the
// floors that it makes.
#include <gtest/gtest.h>

#include "discovery/model/floor.h"
#include "discovery/model/noise_model.h"
#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

constexpr double kTrue = 0.0048;  // A, a quarter of a code of the ADC

/// Clamped ramps and pulses of the reference rig with an ADC of 20 A, whose file states `stated`
/// [A].
Case ClampedRecords(double stated) {
  RigParameters rig = testing::RadialRig();
  rig.amplifier.adc_range = 20;
  rig.amplifier.adc_bits = 11;
  rig.amplifier.current_noise = kTrue;
  rig.amplifier.edge_jitter = 0;  // it moves the currents themselves
  std::vector<ExaminationRecord> chosen;
  for (const ExaminationRecord& r : Examination(rig, 4))
    if (r.title.starts_with("clamped")) chosen.push_back(r);
  Hypothesis truth;
  truth.rig = rig;
  Case c = testing::MeasuredBy(truth, EmptyCase(rig, chosen));
  c.rig.amplifier.current_noise = stated;
  return c;
}

// Readings without noise stand on one code or jump between two: that is no noise which could be
// taken off.
TEST(EstimateNoise, OfCurrentsThatAreReadInCoarseCodes) {
  for (const double stated : {0.008, 0.016}) {
    const Case c = ClampedRecords(stated);
    const CaseModel model(c);
    const NoiseModel noise = EstimateNoise(model, Hypothesis::Base(c.rig));
    EXPECT_NEAR(noise.current_sample, kTrue, 0.15 * kTrue) << stated;
    for (const auto& [name, channel] : noise.channels)
      if (name.find(".i") != std::string::npos) {
        EXPECT_NEAR(channel.estimated / channel.stated, kTrue / stated, 0.25 * kTrue / stated)
            << name;
      }
  }
}

/// Floor of A.i1 in the records with single readings and in those with the means of a period's [A].
std::pair<double, double> FloorsOfACurrent(const Case& c) {
  CaseModel model(c);
  const Hypothesis h = Hypothesis::Base(c.rig);
  model.noise_model = EstimateNoise(model, h);
  FindFloor(model, h);
  double single = 0, mean = 0;
  for (const Target& t : model.targets()) {
    const CaseRecord& r = model.data().records[t.record];
    if (r.data.channels[t.channel].name != "A.i1") continue;
    (r.data_file == "clamped, current pulses" ? single : mean) = t.floor;
  }
  return {single, mean};
}

// 18 readings have a mean whose noise is a quarter of theirs: one number a channel would be too
// large for the means.
TEST(Floor, OfACurrentIsThatOfItsRecord) {
  Case c = ClampedRecords(kTrue);
  std::erase_if(c.records, [](const CaseRecord& r) {
    return r.data_file.find("off centre") != std::string::npos;
  });
  ASSERT_EQ(c.records.size(), 2U);
  const auto [single, mean] = FloorsOfACurrent(c);
  EXPECT_GT(single, kTrue);
  EXPECT_LT(mean, 0.3 * single);
}

}  // namespace
}  // namespace ambrig
