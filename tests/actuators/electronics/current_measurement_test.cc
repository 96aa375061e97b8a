/// What the ADC hands over of currents that run along a line.
#include "actuators/electronics/current_measurement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "actuators/magnetics/whole_lane_vector.h"
#include "core/math/noise.h"

namespace ambrig {
namespace {

constexpr int kSamples = 18, kCoils = 8;
constexpr double kJitter = 0.01, kSlope = 0.4;  // of the time between samples; [A] per sample

struct Measured {
  Lane adc[kSamples];
  CurrentStatistics statistics;
};

MeasurementSettings Settings(double noise, double jitter) {
  return {kSamples, kCoils, true, true, noise, jitter, Quantiser(24, 20)};
}

/// Coil j rises by (1 + j) kSlope per sample from 1 A.
Measured OfALine(const MeasurementSettings& s, std::uint64_t block) {
  std::vector<float> normals(kSamples * kCoils + kSamples + 7);
  FillNormals(1, 7, block, normals.data(), kSamples * kCoils + kSamples);
  Lane truth[kSamples];
  for (int k = 0; k < kSamples; ++k)
    for (int j = 0; j < kCoils; ++j) truth[k][j] = 1 + kSlope * k * (1 + j) / kCoils;
  const CurrentSensor sensors[kLanes] = {};
  Measured m;
  SampleInstants instants;
  instants.Set(s.samples, s.jitter, normals.data() + kSamples * kCoils);
  MeasureCurrents(s, truth, sensors, true, {normals.data(), instants}, m.adc, &m.statistics);
  return m;
}

double Error(const Measured& m, int k, int j) {
  return m.adc[k][j] - (1 + kSlope * k * (1 + j) / kCoils);
}

// A sample dt late reads slope dt more, at both ends of the period too; one clock serves all coils.
TEST(CurrentMeasurement, JitterOfTheInstantsIsSlopeTimesDelay) {
  constexpr int kBlocks = 400;
  for (const int k : {0, 1, 9, kSamples - 1}) {
    double square = 0;
    for (int block = 0; block < kBlocks; ++block) {
      const Measured m = OfALine(Settings(0, kJitter), static_cast<std::uint64_t>(block));
      const double fast = Error(m, k, kCoils - 1);
      square += fast * fast;
      EXPECT_NEAR(Error(m, k, 3), 0.5 * fast, 5e-6);  // half the slope; codes of 2.4 uA
    }
    EXPECT_NEAR(std::sqrt(square / kBlocks), kJitter * kSlope,
                4 * kJitter * kSlope / std::sqrt(2.0 * kBlocks))
        << k;
  }
}

TEST(CurrentMeasurement, JitterOfOneSampleSaysNothingOfTheNext) {
  double sum = 0, square = 0;
  int pairs = 0;
  for (std::uint64_t block = 0; block < 200; ++block) {
    const Measured m = OfALine(Settings(0, kJitter), block);
    for (int k = 1; k < kSamples; ++k, ++pairs) {
      sum += Error(m, k, 7) * Error(m, k - 1, 7);
      square += Error(m, k, 7) * Error(m, k, 7);
    }
  }
  EXPECT_LT(std::abs(sum / square), 4 / std::sqrt(pairs));
}

// The statistics that are not measured are of the true samples.
TEST(CurrentMeasurement, JitterLeavesTheTrueStatisticsAlone) {
  const Measured exact = OfALine(Settings(0.004, 0), 3),
                 jittery = OfALine(Settings(0.004, kJitter), 3);
  for (int j = 0; j < kCoils; ++j) {
    EXPECT_EQ(exact.statistics.mean_square[j], jittery.statistics.mean_square[j]);
    EXPECT_EQ(exact.statistics.largest[j], jittery.statistics.largest[j]);
    EXPECT_NE(exact.statistics.mean[j], jittery.statistics.mean[j]);
  }
}

// A gain takes currents out of the range that are inside it, an offset below it.
TEST(CurrentMeasurement, ReadingsThatAGainOrAnOffsetTakesOutOfTheRangeAreClipped) {
  Lane truth[kSamples];
  for (Lane& sample : truth) sample[2] = 7, sample[3] = 0.01;
  CurrentSensor sensors[kLanes];
  MeasurementSettings s = Settings(0.004, 1e-3);
  s.quantiser = Quantiser(12, 10);
  const std::vector<float> normals(kSamples * kCoils + kSamples + 7, 0.0F);
  const auto measured = [&] {
    Measured m;
    MeasureCurrents(s, truth, sensors, false, {normals.data(), {}}, m.adc, &m.statistics);
    return m;
  };
  sensors[2].gain = 1.3;
  EXPECT_NEAR(measured().adc[4][2], 9.1, s.quantiser.step);
  sensors[2].gain = 1.6;
  EXPECT_EQ(measured().adc[4][2], s.quantiser.high);
  EXPECT_NEAR(measured().adc[4][3], 0.01, s.quantiser.step);
  sensors[3].offset = -11;
  EXPECT_EQ(measured().adc[4][3], s.quantiser.low);
  sensors[3] = {};
  sensors[3].gain = -2000;
  EXPECT_EQ(measured().adc[4][3], s.quantiser.low);
}

// Close below the end of the range a late sample is clipped as every other.
TEST(CurrentMeasurement, JitterIsClippedAtTheEndOfTheRange) {
  MeasurementSettings s = Settings(0, 0.1);
  s.quantiser = Quantiser(12, 1 + kSlope * (kSamples - 1) * 1.001);
  for (std::uint64_t block = 0; block < 20; ++block) {
    const Measured m = OfALine(s, block);
    EXPECT_LE(m.adc[kSamples - 1][kCoils - 1], s.quantiser.high);
  }
}

Measured Ideally(bool whole, bool plain) {
  Lane truth[kSamples];
  for (int k = 0; k < kSamples; ++k)
    for (int j = 0; j < kCoils; ++j) truth[k][j] = std::sin(1.7 * k + j);
  CurrentSensor sensors[kLanes];
  for (int j = 0; j < kCoils && !plain; ++j) {
    sensors[j].gain = 1 + 0.01 * j;
    sensors[j].offset = -0.1 * j;
  }
  MeasurementSettings s = Settings(0, 0);
  s.noisy = false;
  whole_lanes = whole;
  Measured m;
  MeasureCurrents(s, truth, sensors, plain, {nullptr, {}}, m.adc, &m.statistics);
  whole_lanes = HasWholeLanes();
  return m;
}

// Without noise, too, both ways of the lanes have the same bits.
TEST(CurrentMeasurement, WithoutNoiseHalvesAndWholeLanesAgree) {
  for (const bool plain : {true, false}) {
    const Measured halves = Ideally(false, plain), whole = Ideally(HasWholeLanes(), plain);
    for (int j = 0; j < kCoils; ++j) {
      EXPECT_EQ(halves.statistics.mean[j], whole.statistics.mean[j]);
      EXPECT_EQ(halves.statistics.mean_square[j], whole.statistics.mean_square[j]);
      EXPECT_EQ(halves.statistics.largest[j], whole.statistics.largest[j]);
      const double gain = plain ? 1 : 1 + 0.01 * j, offset = plain ? 0 : -0.1 * j;
      for (int k = 0; k < kSamples; ++k) {
        EXPECT_EQ(halves.adc[k][j], whole.adc[k][j]);
        EXPECT_EQ(whole.adc[k][j], gain * std::sin(1.7 * k + j) + offset);
      }
    }
  }
}

}  // namespace
}  // namespace ambrig
