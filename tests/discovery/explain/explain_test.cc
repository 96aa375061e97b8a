// The whole search on measurements whose cause is written down: nothing, an effect, wrong data.
#include "discovery/explain/explain.h"

#include <gmock/gmock.h>

#include <atomic>
#include <cmath>

#include "core/base/errors.h"
#include "discovery/calibration/calibration.h"
#include "tests/discovery/examined_records.h"
#include "tests/discovery/measured_case.h"

namespace ambrig {
namespace {

std::vector<MeasuredPlace> Places(double gain, double offset = 0) {
  return {{2e-5, 3e-5, gain, offset},
          {-6e-5, 1e-5, gain, offset},
          {5e-5, -4e-5, gain, offset},
          {-3e-5, -5e-5, gain, offset}};
}

TEST(Explain, MeasurementsOfTheRigAsDrawnNeedNothing) {
  const Case c = MeasuredCase(Places(1));
  const Explanation e = Explain(c, ShortSearch());
  EXPECT_EQ(e.verdict, ExplanationVerdict::kNone);
  EXPECT_TRUE(e.adopted.empty());
  EXPECT_NEAR(e.nominal_ratio_validate, 1, 0.1);
  ASSERT_FALSE(e.set.empty());
  EXPECT_EQ(e.set[0].effect, "none");
  if (StoredCalibration().cases < kCasesForCalibration) {
    EXPECT_EQ(e.set.size(), 1u);
  }
  EXPECT_EQ(e.remainder.kind, RemainderKind::kNone);
  EXPECT_GT(e.runs, 0);
}

TEST(Explain, AnOffsetOfASensorIsFoundWithItsSize) {
  const Case c = MeasuredCase(Places(1, 3e-6));
  std::vector<double> fractions;
  ExplainOptions o = ShortSearch();
  o.progress = [&](double f, const std::string&) { fractions.push_back(f); };
  int checkpoints = 0;
  o.checkpoint = [&](const Explanation& so_far) {
    ++checkpoints;
    EXPECT_EQ(so_far.adopted.size(), 1u);
  };
  const Explanation e = Explain(c, o);
  ASSERT_EQ(e.verdict, ExplanationVerdict::kEffect);
  ASSERT_EQ(e.adopted.size(), 1u);
  EXPECT_EQ(e.adopted[0].name, "sensor-offset");
  if (StoredCalibration().cases < kCasesForCalibration) {
    EXPECT_EQ(e.set.size(), 1u);  // a calibration from few cases would leave every name in
  }
  EXPECT_EQ(e.adopted[0].target, "A.x");
  EXPECT_NEAR(e.adopted[0].Value("offset"), 3e-6, 2e-7);
  EXPECT_GT(e.nominal_ratio_validate, 3);
  EXPECT_NEAR(e.final_ratio_validate, 1, 0.15);
  EXPECT_GT(e.closure.explained, 0.95);
  ASSERT_GE(e.ladder.size(), 3u);
  EXPECT_EQ(e.ladder[1].added, "parameters");
  EXPECT_EQ(e.ladder.back().added, "sensor-offset at A.x");
  double sum = 0;
  for (const RankedEffect& r : e.ranking) sum += r.probability;
  EXPECT_LE(sum, 1 + 1e-9);
  EXPECT_EQ(checkpoints, 1);
  EXPECT_EQ(fractions.back(), 1);
}

// Held at one place per record, a gain is another zero in every record: one number that explains
// them all is preferred to as many as there are records.
TEST(Explain, OneEffectIsPreferredToAsManyZerosAsRecords) {
  const Case c = MeasuredCase(Places(1.08));
  const Explanation e = Explain(c, ShortSearch());
  EXPECT_EQ(e.verdict, ExplanationVerdict::kEffect);
  ASSERT_EQ(e.adopted.size(), 1u);
  EXPECT_EQ(e.adopted[0].name, "sensor-gain");
  EXPECT_EQ(e.adopted[0].target, "A.x");
  EXPECT_NEAR(e.adopted[0].Value("gain"), 1.08, 5e-3);
  EXPECT_TRUE(e.nuisances.empty());
}

// A gain that differs between the two directions is none of the catalogue's, but explains most of
// what as many zeros as there are records do; the zeros take what it leaves.
TEST(Explain, AnEffectWithALawOfAnotherFormIsPreferredToZeros) {
  std::vector<MeasuredPlace> places = Places(1), more = Places(1);
  for (MeasuredPlace& p : more) p.x *= 0.7, p.y *= -1.2;
  places.insert(places.begin(), more.begin(), more.end());
  for (MeasuredPlace& p : places) p.gain = p.x > 0 ? 1.08 : 1.06;
  const Explanation e = Explain(MeasuredCase(places), ShortSearch());
  EXPECT_EQ(e.verdict, ExplanationVerdict::kEffect);
  ASSERT_EQ(e.adopted.size(), 1u);
  EXPECT_EQ(Named(e.adopted[0]), "sensor-gain at A.x");
  EXPECT_NEAR(e.adopted[0].Value("gain"), 1.07, 0.01);
}

// A second effect hides nothing of the first any more: both have a set of their own.
TEST(Explain, TwoEffectsAreNamedBesideEachOther) {
  Case c = MeasuredCase(Places(1.08));
  for (CaseRecord& r : c.records)
    for (double& v : r.data.channels[3].samples) v += 4e-6;  // B.y
  ExplainOptions o = ShortSearch();
  o.candidates = 3;
  o.rounds = 2;
  const Explanation e = Explain(c, o);
  ASSERT_EQ(e.verdict, ExplanationVerdict::kEffect);
  ASSERT_EQ(e.adopted.size(), 2u);
  for (const EffectInstance& a : e.adopted)
    EXPECT_TRUE(Named(a) == "sensor-gain at A.x" || Named(a) == "sensor-offset at B.y") << Named(a);
  ASSERT_EQ(e.judged_beside.size(), 1u);
  EXPECT_EQ(e.judged_beside[0], Named(e.adopted[1]));
  ASSERT_FALSE(e.set.empty());
  EXPECT_EQ(e.set[0].effect, e.adopted[0].name);
  EXPECT_GT(e.set[0].probability, 0.9);
  EXPECT_NEAR(e.ranking[0].fit.ratio_validate, 1, 0.15);  // with both
  for (const auto& [name, set] : e.further_sets) {
    EXPECT_EQ(name, Named(e.adopted[1]));
    EXPECT_EQ(set[0].effect, e.adopted[1].name);
  }
}

// The sign of a reading at a level shows only where it is known how large it is: beside a gain of
// 1.3 it looks like no mistake.
TEST(Explain, WrongDataThatAnEffectHidAreFoundBesideIt) {
  std::vector<MeasuredPlace> places{{1.5e-5, 2e-5, 1.3}};
  for (int r = 0; r < 9; ++r) places.push_back({(r % 2 ? -1e-5 : 1e-5) * (5 + r), 3e-5, 1.3});
  for (const bool wrong : {false, true}) {
    Case c = MeasuredCase(places);
    c.nuisances.sensor_zero["B.y"] =
        1e-9;  // declared: no zeros are sought that would take the gain's place
    if (wrong)
      for (double& v : c.records[0].data.channels[0].samples) v = -v;
    const Explanation e = Explain(c, ShortSearch());
    if (!wrong) {
      EXPECT_EQ(e.verdict, ExplanationVerdict::kEffect);
      EXPECT_TRUE(e.data.empty());
      continue;
    }
    EXPECT_EQ(e.verdict, ExplanationVerdict::kData);
    ASSERT_EQ(e.data.size(), 1u);
    EXPECT_EQ(e.data[0].record, c.records[0].data_file);
    EXPECT_EQ(e.data[0].channel, "A.x");
    EXPECT_EQ(e.data[0].fault, "sign");
    EXPECT_TRUE(e.adopted.empty() && e.ranking.empty());
    EXPECT_EQ(e.set[0].effect, "data");
    EXPECT_THAT(e.warnings,
                ::testing::Contains(::testing::HasSubstr("show beside sensor-gain at A.x")));
  }
}

// Zeros that follow no law are nuisances, not an effect.
TEST(Explain, WhatDiffersFromRecordToRecordIsANuisance) {
  std::vector<MeasuredPlace> places = Places(1);
  const double zeros[] = {3e-6, -5e-6, 4e-6, -2e-6};
  for (std::size_t r = 0; r < places.size(); ++r) places[r].offset = zeros[r % 4];
  const Explanation e = Explain(MeasuredCase(places), ShortSearch());
  EXPECT_EQ(e.verdict, ExplanationVerdict::kParameters);
  EXPECT_TRUE(e.adopted.empty());
  ASSERT_EQ(e.nuisances.size(), 4u);
  for (std::size_t r = 0; r < 4; ++r) {
    EXPECT_EQ(e.nuisances[r].name, "zero of A.x");
    EXPECT_NEAR(e.nuisances[r].value, zeros[r], 3e-7) << r;
  }
  EXPECT_NEAR(e.final_ratio_validate, 1, 0.15);
}

// A column in µm in a file said to be in m: nothing is fitted to it.
TEST(Explain, WrongDataEndTheSearch) {
  Case c = MeasuredCase(Places(1));
  for (CaseRecord& r : c.records)
    for (double& v : r.data.channels[0].samples) v *= 1000;
  const Explanation e = Explain(c, ShortSearch());
  EXPECT_EQ(e.verdict, ExplanationVerdict::kData);
  ASSERT_FALSE(e.data.empty());
  EXPECT_EQ(e.data[0].channel, "A.x");
  EXPECT_TRUE(e.ranking.empty());
  EXPECT_TRUE(e.adopted.empty());
  EXPECT_EQ(e.final_ratio_validate, e.nominal_ratio_validate);
}

TEST(Explain, StopsWhenAsked) {
  const Case c = MeasuredCase(Places(1.08));
  std::atomic<bool> stop{true};
  ExplainOptions o = ShortSearch();
  o.stop = &stop;
  EXPECT_THROW(Explain(c, o), Interrupted);
}

}  // namespace
}  // namespace ambrig
