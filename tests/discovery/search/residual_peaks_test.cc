// Tones that a residual holds are found at their frequency; of fixed phase in all records, or not.
#include "discovery/search/residual_peaks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "core/math/noise.h"
#include "discovery/experiment/examination.h"
#include "rig/rig_file.h"

namespace ambrig {
namespace {

Case LevitatedRecords() {
  const RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  Case c = EmptyCase(rig, Examination(rig, 1));
  std::erase_if(c.records,
                [](const CaseRecord& r) { return r.scenario.start == StartState::kClamped; });
  return c;
}

TEST(ResidualPeaks, FindsATone) {
  const Case c = LevitatedRecords();
  const CaseModel model(c);
  std::vector<double> residual(model.size());
  for (const Target& t : model.targets()) {
    const CaseRecord& r = c.records[t.record];
    for (std::size_t k = 0; k < t.count; ++k) {
      const double time = r.data.start + static_cast<double>(k) / r.data.rate;
      residual[t.first + k] = Normal(3, 1, t.first + k);
      if (r.data.channels[t.channel].name == "A.x")
        residual[t.first + k] += std::sin(2 * kPi * 60 * time + 0.4);
      if (r.data.channels[t.channel].name == "B.y")
        residual[t.first + k] +=
            2 * std::sin(2 * kPi * 400 * time + 2.1 * static_cast<double>(t.record));
    }
  }
  const ResidualPeaks peaks = FindPeaks(model, residual);
  ASSERT_FALSE(peaks.coherent.at("A").empty());
  EXPECT_NEAR(peaks.coherent.at("A")[0], 60, 0.5);
  ASSERT_FALSE(peaks.coherent.at("rig").empty());  // of all bearings together
  EXPECT_NEAR(peaks.coherent.at("rig")[0], 60, 0.5);
  ASSERT_FALSE(peaks.spectrum.empty());
  EXPECT_NEAR(peaks.spectrum[0], 400, 6);
  EXPECT_EQ(peaks.tones.at("A"), (std::vector<double>{peaks.coherent.at("A")[0]}));
  EXPECT_FALSE(peaks.ShowsNoTone("A"));
}

// Beyond the grid, and in records whose lines are finer than it: between two of its frequencies a
// line of 5 s is not seen.
TEST(ResidualPeaks, FindsTonesThatNoGridReaches) {
  Case c = LevitatedRecords();
  for (const double tone : {431.3, 1503.7}) {
    const CaseModel model(c);
    std::vector<double> residual(model.size());
    for (const Target& t : model.targets()) {
      const CaseRecord& r = c.records[t.record];
      const bool hums = r.data.channels[t.channel].name == "A.x";
      for (std::size_t k = 0; k < t.count; ++k) {
        const double time = r.data.start + static_cast<double>(k) / r.data.rate;
        residual[t.first + k] =
            Normal(3, 1, t.first + k) + (hums ? std::sin(2 * kPi * tone * time + 0.4) : 0);
      }
    }
    const std::vector<double> tones = FindPeaks(model, residual).tones.at("A");
    ASSERT_FALSE(tones.empty()) << tone;
    EXPECT_NEAR(tones[0], tone, 0.5);
  }
}

// Noise, and an error of all frequencies, leave no tone that would be worth a simulation; what the
// third harmonic holds speaks for its fundamental.
TEST(ResidualPeaks, TriesOnlyTonesThatHoldAShare) {
  const Case c = LevitatedRecords();
  const CaseModel model(c);
  std::vector<double> noise(model.size()), transient(model.size()), third(model.size());
  for (const Target& t : model.targets()) {
    const CaseRecord& r = c.records[t.record];
    for (std::size_t k = 0; k < t.count; ++k) {
      const std::size_t row = t.first + k;
      const double time = r.data.start + static_cast<double>(k) / r.data.rate;
      noise[row] = Normal(3, 1, row);
      transient[row] = noise[row] + 30 * std::exp(-static_cast<double>(k) / r.data.rate / 0.0003);
      third[row] = noise[row];
      if (r.data.channels[t.channel].name == "B.x")
        third[row] += std::sin(2 * kPi * 3 * 50 * time + 0.4);
    }
  }
  for (const std::vector<double>* residual : {&noise, &transient})
    for (const char* plane : {"A", "B", "rig"})
      EXPECT_TRUE(FindPeaks(model, *residual).ShowsNoTone(plane)) << plane;
  const std::vector<double> found = FindPeaks(model, third).tones.at("B");
  EXPECT_TRUE(std::ranges::any_of(found, [](double f) { return std::abs(f - 50) < 0.5; }));
}

// A thinned model keeps rows of every phase, so that nothing periodic hides.
TEST(ThinModel, KeepsEveryPhase) {
  RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  const Case c = EmptyCase(rig, Examination(rig, 1));
  const CaseModel all(c), thin(c, 5);
  EXPECT_NEAR(static_cast<double>(thin.size()), static_cast<double>(all.size()) / 5,
              0.01 * static_cast<double>(all.size()));
  std::vector<int> phase(5);
  const Target& t = thin.targets()[0];
  for (std::size_t k = t.first; k < t.first + t.count; ++k) ++phase[thin.sample(k) % 5];
  for (int n : phase) EXPECT_NEAR(n, static_cast<double>(t.count) / 5, 2);
}

// A transient that only decays has a spectrum that only falls: no frequency stands out of it.
TEST(ResidualPeaks, AFallingSpectrumHasNone) {
  const Case c = LevitatedRecords();
  const CaseModel model(c);
  std::vector<double> residual(model.size());
  for (const Target& t : model.targets()) {
    const CaseRecord& r = c.records[t.record];
    if (r.data.channels[t.channel].name != "A.x") continue;
    for (std::size_t k = 0; k < t.count; ++k)  // time constant of 4 ms, the record is over 200 ms
      residual[t.first + k] = std::exp(-static_cast<double>(k) / r.data.rate / 0.004);
  }
  const ResidualPeaks peaks = FindPeaks(model, residual);
  EXPECT_TRUE(peaks.coherent.at("A").empty());
  EXPECT_TRUE(peaks.spectrum.empty());
}

}  // namespace
}  // namespace ambrig
