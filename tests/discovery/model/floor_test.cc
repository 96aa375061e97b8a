// What noise alone makes of every channel, on held rotors whose noise is written down.
#include "discovery/model/floor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/record/channels.h"
#include "tests/discovery/data_gate/gate_case.h"
#include "tests/discovery/measured_case.h"

namespace ambrig {
namespace {

constexpr double kSensorNoise = 2e-7;  // [m], of the rig file

Case HeldReadings() { return MeasuredCase({{2e-5, 3e-5}, {-6e-5, 1e-5}, {5e-5, -4e-5}}); }

TEST(Floor, OfAReadingIsItsNoise) {
  const Case c = HeldReadings();
  CaseModel model(c);
  const NoiseFloor floor = FindFloor(model, Hypothesis::Base(c.rig));
  ASSERT_EQ(model.targets().size(), 12u);
  for (const Target& t : model.targets()) {
    EXPECT_GE(t.floor, kSensorNoise);         // never below what the file states
    EXPECT_LT(t.floor, 1.12 * kSensorNoise);  // 800 draws: 2.5 % each, the largest of 12
  }
  ASSERT_EQ(floor.clean.size(), model.size());
  EXPECT_NEAR(floor.clean[0], 2e-5, 1e-12);  // A.x of the first record, without noise
}

// White noise in channels that know nothing of each other: as many numbers as there are rows, but
// for what the squares of chance correlations take (1 + 2 Σ 1/n over the lags: a third).
TEST(Floor, WhiteRowsAreIndependent) {
  const Case c = HeldReadings();
  CaseModel model(c);
  const NoiseFloor floor = FindFloor(model, Hypothesis::Base(c.rig));
  const auto rows = static_cast<double>(model.size());
  EXPECT_GT(floor.effective_sample_size, 0.5 * rows);
  EXPECT_LT(floor.effective_sample_size, 0.75 * rows);
}

// A sine of 20 rows has the autocorrelation cos(pi lag/10) at every lag: of 200 rows one is
// independent.
TEST(RowsPerIndependentOne, OfASineAreAsManyAsTheLags) {
  std::vector<double> v(2010, 1e6);
  for (std::size_t k = 10; k < v.size(); ++k) v[k] = std::sin(M_PI * static_cast<double>(k) / 10);
  double sum = 1;
  for (int lag = 1; lag < 200; ++lag) sum += 2 * std::pow(std::cos(M_PI * lag / 10), 2);
  EXPECT_NEAR(RowsPerIndependentOne(v, 10, 2000), sum, 0.01 * sum);
  EXPECT_EQ(RowsPerIndependentOne(std::vector<double>(50, 0.0), 0, 50), 1);
}

TEST(Floor, NoiseThatIsStatedCountsWhereItIsLarger) {
  Case c = HeldReadings();
  c.noise["A.x"] = 1e-6;
  CaseModel model(c);
  FindFloor(model, Hypothesis::Base(c.rig));
  for (const Target& t : model.targets()) {
    const std::string& name = c.records[t.record].data.channels[t.channel].name;
    if (name == "A.x") {
      EXPECT_NEAR(t.floor, 1e-6, 0.12e-6);
    }
  }
}

// A speed sensor is taken to resolve a part of its signal, unless its noise is stated.
TEST(Floor, AStatedNoiseOfTheSpeedHoldsHoweverSmall) {
  std::vector<ExaminationRecord> chosen;
  for (const ExaminationRecord& r : Examination(testing::RadialRig(), 4, {.free_speed = true}))
    if (r.title == "coast-down from 900 rad/s") chosen.push_back(r);
  ASSERT_EQ(chosen.size(), 1U);
  for (const double stated : {0.0, 1e-3}) {
    Case c = EmptyCase(testing::RadialRig(), chosen);
    if (stated > 0) c.noise["omega"] = stated;
    CaseModel model(c);
    FindFloor(model, Hypothesis::Base(c.rig));
    for (const Target& t : model.targets()) {
      if (c.records[t.record].data.channels[t.channel].name != "omega") continue;
      if (stated > 0)
        EXPECT_DOUBLE_EQ(t.floor, stated);
      else
        EXPECT_GE(t.floor, 1e-3);
    }
  }
}

TEST(Floor, WithoutNoiseItIsTheResolution) {
  Case c = HeldReadings();
  for (BearingParameters& b : c.rig.bearings) b.sensor.noise = 0;
  CaseModel model(c);
  FindFloor(model, Hypothesis::Base(c.rig));
  const ChannelResolution& r = RowOf(ChannelKind::kReading).resolution;
  for (const Target& t : model.targets()) {
    EXPECT_GE(t.floor, r.least);
    EXPECT_LT(t.floor, 0.1 * kSensorNoise);
  }
}

TEST(Floor, RowsThatDoNotCountDoNotMakeIt) {
  Case c = HeldReadings();
  for (CaseRecord& r : c.records)
    for (auto& q : r.quality) std::fill(q.ok.begin() + 100, q.ok.end(), 0);
  CaseModel model(c);
  FindFloor(model, Hypothesis::Base(c.rig));
  for (const Target& t : model.targets()) EXPECT_NEAR(t.floor, kSensorNoise, 0.25 * kSensorNoise);
}

}  // namespace
}  // namespace ambrig
