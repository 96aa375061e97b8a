// The noise of a case: what is stated, by whom, and how it comes into the rig that is simulated.
#include "discovery/model/noise_model.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/math/noise.h"
#include "discovery/model/case_model.h"
#include "tests/discovery/bench_case.h"
#include "tests/discovery/linear_case.h"
#include "tests/discovery/measured_case.h"

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

ChannelNoise EstimatedNoise(const Case& c, const std::string& channel) {
  const CaseModel model(c);
  return EstimateNoise(model, Hypothesis::Base(c.rig)).channels.at(channel);
}

// 2e-7 m are in the rows; a statement that is off by less than differences usually tell is not
// believed where all records say the same.
TEST(EstimateNoise, WhatIsTheSameInEveryRecordIsNoise) {
  Case c = MeasuredCase({{2e-5, 3e-5}, {-6e-5, 1e-5}, {5e-5, -4e-5}, {-3e-5, -5e-5}});
  c.noise["A.x"] = 1.5e-7;
  c.noise["A.y"] = 1.95e-7;
  EXPECT_NEAR(EstimatedNoise(c, "A.x").used, 2e-7, 0.15e-7);
  EXPECT_EQ(EstimatedNoise(c, "A.y").used, 1.95e-7);  // agrees
}

// A record that is faster than the controller repeats every reading: its noise is that of the new
// values. (The equal neighbours gave a sixth of it, and the rest was held to be unexplained.)
TEST(EstimateNoise, OfReadingsThatAreRepeated) {
  for (const std::size_t records : {1u, 4u}) {
    Case c = MeasuredCase({{2e-5, 3e-5}, {-6e-5, 1e-5}, {5e-5, -4e-5}, {-3e-5, -5e-5}});
    c.records.resize(records);
    for (CaseRecord& r : c.records)
      for (Channel& ch : r.data.channels)
        for (std::size_t k = 0; k < ch.samples.size(); ++k) ch.samples[k] = ch.samples[k / 8 * 8];
    for (const char* axis : {"A.x", "A.y", "B.x", "B.y"}) {
      const ChannelNoise noise = EstimatedNoise(c, axis);
      // 46 fourth differences: a median deviation of them has an sd of 0.2 to 0.3 of itself
      EXPECT_GT(noise.estimated, 0.8e-7) << axis;
      EXPECT_LT(noise.estimated, 3.5e-7) << axis;
    }
  }
}

// What acts in one record and not in another is something that the model lacks.
TEST(EstimateNoise, WhatDiffersFromRecordToRecordIsNotBelievedSoFast) {
  Case c = MeasuredCase({{2e-5, 3e-5}, {-6e-5, 1e-5}, {5e-5, -4e-5}, {-3e-5, -5e-5}});
  c.noise["A.x"] = 1.8e-7;
  std::uint32_t seed = 1;
  for (const std::size_t r : {std::size_t{0}, std::size_t{2}})
    for (double& v : c.records[r].data.channels[0].samples) v += 3e-7 * Normal(5, 9, seed++);
  EXPECT_EQ(EstimatedNoise(c, "A.x").used, 1.8e-7);
}

/// Adds noise of some 20 rows' time constant to A.x of all records.
void AddFilteredNoise(Case& c, double rms) {
  const double keep = 0.95, fresh = rms * std::sqrt(1 - keep * keep);
  std::uint32_t seed = 1;
  for (CaseRecord& r : c.records) {
    double filtered = 0;
    for (double& v : r.data.channels[0].samples)
      v += filtered = keep * filtered + fresh * Normal(5, 9, seed++);
  }
}

// Filtered noise shows little of itself from row to row. A statement that is too large is
// contradicted by the errors.
TEST(EstimateNoise, FilteredNoiseIsAsLargeAsStated) {
  Case c = MeasuredCase({{2e-5, 3e-5}, {-6e-5, 1e-5}, {5e-5, -4e-5}, {-3e-5, -5e-5}});
  const double rms = 3e-6;
  AddFilteredNoise(c, rms);
  c.noise["A.x"] = rms;
  const ChannelNoise noise = EstimatedNoise(c, "A.x");
  EXPECT_LT(noise.estimated, 0.5 * rms);
  EXPECT_EQ(noise.used, rms);
  c.noise["A.x"] = 30 * rms;
  EXPECT_LT(EstimatedNoise(c, "A.x").used, rms);
}

// A statement that is far too small says nothing: the whole noise is estimated as without it.
TEST(EstimateNoise, FilteredNoiseFarAboveTheStatedOneIsEstimatedWhole) {
  Case c = MeasuredCase(std::vector<MeasuredPlace>(12, {2e-5, 3e-5}));
  const double rms = 3e-6;
  AddFilteredNoise(c, rms);
  c.noise["A.x"] = rms / 30;
  const double stated = EstimatedNoise(c, "A.x").used;
  c.noise.erase("A.x");
  EXPECT_EQ(stated, EstimatedNoise(c, "A.x").used);
  EXPECT_GT(stated, 0.6 * rms);
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

// Points of a table stand over their own sd: they say nothing of the noise of a channel over time.
TEST(EstimateNoise, OfRecordsOverTimeOnly) {
  const testing::TemporaryFolder folder;
  std::string text = "A.i1 [A],A.fx [N]\n";
  for (int k = 0; k < 40; ++k)
    text +=
        fmt::format("{:.3f},{:.3f}\n", 0.04 * k, 300 * Normal(5, 1, static_cast<std::uint64_t>(k)));
  testing::WriteBytes(folder.File("t.csv"), text);
  const Case c = testing::CaseOf(folder,
                                 "noise = { \"A.fx\" = 0.3 }\n[[record]]\ndata = \"t.csv\"\n"
                                 "kind = \"static\"\nsd = { \"A.fx\" = 1.0 }\n");
  const CaseModel model(c);
  EXPECT_EQ(EstimateNoise(model, Hypothesis::Base(c.rig)).Used("A.fx"), 0.3);
}

}  // namespace
}  // namespace ambrig
