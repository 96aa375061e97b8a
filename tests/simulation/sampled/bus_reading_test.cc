/// The measured bus: what detection is given is what the record holds (files.md "Record"), noise
/// included.
#include <gtest/gtest.h>

#include "simulation/continuous/reference_engine.h"
#include "simulation/switching/switching_engine.h"
#include "tests/simulation/witness.h"

namespace ambrig {
namespace {

constexpr double kNoise = 0.03;  // [V rms]

class Listener : public Supervisor {
 public:
  void AfterPeriod(const PeriodMeasurement& m, const std::vector<BearingControl>&,
                   SupervisorOutput&) override {
    for (const BearingMeasurement& b : m.bearings) EXPECT_EQ(b.bus, m.bearings.front().bus);
    if (m.period >= 0) bus.push_back(m.bearings.front().bus);
  }
  std::vector<double> bus;
};

struct Heard {
  std::vector<double> recorded, given;  // at the start of each period; at its end [V]
};

Heard Listen(bool reference, bool noise, double rms, double rate) {
  RigParameters rig = BaseRig();
  rig.amplifier.bus_noise = rms;
  Scenario s = BaseScenario("steps", rig);
  s.duration = reference ? 0.004 : 0.02;
  s.record_rate = rate;
  s.noise = noise;
  Listener listener;
  Heard out;
  if (reference) {
    ReferenceOptions o;
    o.sampled.warm_up = 0.002;
    o.sampled.noise = true;
    o.sampled.supervisor = &listener;
    out.recorded = RunReference(rig, s, o).record.Find("bus")->samples;
  } else {
    EngineOptions o;
    o.warm_up = 0.002;
    o.supervisor = &listener;
    out.recorded = SwitchingEngine(rig, s, o).Run().record.Find("bus")->samples;
  }
  out.given = listener.bus;
  return out;
}

void ExpectTheSameReadings(const Heard& h, std::size_t rows_a_period) {
  ASSERT_GT(h.given.size(), 50u);
  for (std::size_t n = 0; (n + 1) * rows_a_period < h.recorded.size() && n < h.given.size(); ++n)
    EXPECT_EQ(h.given[n], h.recorded[(n + 1) * rows_a_period]) << "period " << n;
}

TEST(BusReading, DetectionAndRecordHoldTheSameNoisyValue) {
  const Heard h = Listen(false, true, kNoise, 25000);
  ExpectTheSameReadings(h, 1);
  double sum = 0, square = 0, next = 0;
  const double n = static_cast<double>(h.given.size());
  for (std::size_t k = 0; k < h.given.size(); ++k) {
    const double e = h.given[k] - 30;
    sum += e;
    square += e * e;
    if (k > 0) next += e * (h.given[k - 1] - 30);
  }
  // 500 readings: within four standard errors.
  EXPECT_LT(std::abs(sum / n), 4 * kNoise / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(square / n), kNoise, 4 * kNoise / std::sqrt(2 * n));
  EXPECT_LT(std::abs(next / square), 4 / std::sqrt(n));
}

TEST(BusReading, InABurstTheFirstSampleOfAPeriodIsTheOneGiven) {
  ExpectTheSameReadings(Listen(false, true, kNoise, 450000), 18);
}

TEST(BusReading, TheReferenceGivesTheSameNumbers) {
  const Heard slow = Listen(true, true, kNoise, 25000), fast = Listen(false, true, kNoise, 25000);
  ExpectTheSameReadings(slow, 1);
  for (std::size_t n = 0; n < slow.given.size(); ++n)
    EXPECT_DOUBLE_EQ(slow.given[n], fast.given[n]);
}

TEST(BusReading, WithoutNoiseItIsTheBus) {
  for (double v : Listen(false, false, kNoise, 25000).given) EXPECT_EQ(v, 30.0);
  for (double v : Listen(false, true, 0, 25000).given) EXPECT_EQ(v, 30.0);
}

}  // namespace
}  // namespace ambrig
