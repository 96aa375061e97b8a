// The noise of a case: what is stated, by whom, and how it comes into the rig that is simulated.
#include "discovery/model/noise_model.h"

#include <gmock/gmock.h>

#include <cmath>

#include "discovery/model/model.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

RigParameters Rig() {
  RigParameters rig = LinearCase::Make({2e-5}, 1, 0).rig;
  for (BearingParameters& b : rig.bearings) b.sensor.noise = 0;
  rig.amplifier.bus_noise = 0;
  return rig;
}

TEST(StatedNoise, OfTheCaseBeforeThatOfTheRig) {
  RigParameters rig = Rig();
  rig.bearings[0].sensor.noise = 2e-7;
  rig.amplifier.bus_noise = 0.1;
  const NoiseModel noise = StatedNoise(rig, {{"A.x", 5e-7}, {"A.i3", 0.01}});
  EXPECT_EQ(noise.Used("A.x"), 5e-7);
  EXPECT_EQ(noise.Used("A.y"), 2e-7);
  EXPECT_EQ(noise.Used("A.i3"), 0.01);
  EXPECT_EQ(noise.Used("bus"), 0.1);
  EXPECT_TRUE(std::isnan(noise.Used("B.x")));
  EXPECT_FALSE(noise.estimated);
}

// Both axes of a sensor have one number: the rms of theirs. What is not known stays.
TEST(WithNoise, PutsTheNoiseIntoSensorsBusAndCurrents) {
  RigParameters rig = Rig();
  rig.bearings[1].sensor.noise = 7e-7;
  NoiseModel noise;
  noise.channels["A.x"].used = 3e-7;
  noise.channels["A.y"].used = 4e-7;
  noise.channels["bus"].used = 0.2;
  const double current = rig.amplifier.current_noise;
  RigParameters out = WithNoise(rig, noise);
  EXPECT_NEAR(out.bearings[0].sensor.noise, std::sqrt(12.5) * 1e-7, 1e-15);
  EXPECT_EQ(out.bearings[1].sensor.noise, 7e-7);
  EXPECT_EQ(out.amplifier.bus_noise, 0.2);
  EXPECT_EQ(out.amplifier.current_noise, current);
  noise.current_sample = 0.03;
  EXPECT_EQ(WithNoise(rig, noise).amplifier.current_noise, 0.03);
}

TEST(NoiseRemarks, NameWhatIsNotBelievedAndWhatWasNotStated) {
  NoiseModel noise;
  noise.estimated = true;
  noise.channels["A.x"] = {1e-7, 1.1e-7, 1e-7};
  noise.channels["A.y"] = {1e-7, 5e-7, 5e-7};
  noise.channels["bus"] = {std::nan(""), 0.3, 0.3};
  const std::vector<std::string> lines = NoiseRemarks(noise);
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  EXPECT_THAT(all, ::testing::HasSubstr("A.y"));
  EXPECT_THAT(all, ::testing::Not(::testing::HasSubstr("A.x")));
  EXPECT_THAT(all, ::testing::HasSubstr("bus"));
}

}  // namespace
}  // namespace ambrig
