// Records of a rig whose sensors have coloured noise: what the model leaves of them is taken for
// noise, and an error that moves with the rotor is not.
#include "discovery/model/stationary_remainder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/noise.h"
#include "discovery/model/floor.h"
#include "discovery/model/residual.h"
#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

class StationaryRemainderTest : public ::testing::Test {
 protected:
  StationaryRemainderTest() {
    Hypothesis truth;
    truth.rig = rig_;
    std::vector<ExaminationRecord> records;
    for (const ExaminationRecord& r : Examination(rig_, 4))
      if (!r.burst) records.push_back(r);
    case_ = testing::MeasuredBy(truth, EmptyCase(rig_, records));
  }
  std::vector<double>& Samples(std::size_t record, const std::string& channel) {
    for (Channel& c : case_.records[record].data.channels)
      if (c.name == channel) return c.samples;
    throw std::out_of_range(channel);
  }
  bool Levitated(std::size_t record) const {
    return case_.records[record].scenario.start != StartState::kClamped;
  }
  StationaryRemainder Remainder() {
    CaseModel model(case_);
    const Hypothesis nominal = Hypothesis::Base(rig_);
    const NoiseFloor floor = FindFloor(model, nominal);
    return StationaryRemainderOf(model, floor.clean, Residual(model, floor.clean));
  }

  RigParameters rig_ = testing::RadialRig();
  Case case_;
};

TEST_F(StationaryRemainderTest, NothingIsSaidOfTheNoiseThatIsStated) {
  EXPECT_TRUE(Remainder().channels.empty());
}

TEST_F(StationaryRemainderTest, SlowNoiseOfASensorIsNoise) {
  for (std::size_t r = 0; r < case_.records.size(); ++r) {
    if (!Levitated(r)) continue;
    double slow = 0;
    std::vector<double>& x = Samples(r, "A.x");
    for (std::size_t k = 0; k < x.size(); ++k)
      x[k] += slow += 0.1 * (2e-6 * Normal(7 + r, 1, k) - slow);
  }
  const StationaryRemainder noise = Remainder();
  ASSERT_EQ(noise.channels.size(), 1u);
  EXPECT_EQ(noise.channels[0].channel, "A.x");
  EXPECT_NEAR(noise.channels[0].rms,
              std::hypot(2e-6 * std::sqrt(0.1 / 1.9), noise.channels[0].expected), 0.1e-6);
  EXPECT_EQ(RemainderRemarks(noise).size(), 1u);
}

TEST_F(StationaryRemainderTest, AGainIsNoNoise) {
  for (std::size_t r = 0; r < case_.records.size(); ++r)
    if (Levitated(r))
      for (double& v : Samples(r, "A.x")) v *= 1.1;
  EXPECT_TRUE(Remainder().channels.empty());
}

}  // namespace
}  // namespace ambrig
