// Signatures of probes of a linear reading and their products, in closed form, however many are
// asked for at once.
#include "discovery/search/signature_bank.h"

#include <gtest/gtest.h>

#include "discovery/experiment/examination.h"
#include "discovery/experiment/measured_case.h"
#include "discovery/model/jacobian.h"
#include "rig/rig_file.h"
#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

// One group of 30 probes is more than a chunk holds, and is simulated all the same; five smaller
// ones follow. signature = (gain - 1) x/floor in every row of A.x, so that the products are sums of
// squares of x.
TEST(SignatureBank, AGroupLargerThanAChunkIsSimulated) {
  const LinearCase c({2e-5, 4e-5, 6e-5, 5e-5}, 1.08, 0);
  std::vector<ProbeGroup> groups(6);
  std::vector<double> gains;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (int k = 0; k < (g == 0 ? 30 : 7); ++k) {
      gains.push_back(1.01 + 0.001 * static_cast<double>(gains.size()));
      groups[g].probes.push_back(LinearCase::Gain(gains.back()));
      groups[g].rows.push_back(0);
    }
  SignatureBank bank;
  bank.Simulate(c.model, c.Base(), groups, nullptr);
  ASSERT_EQ(bank.entries().size(), groups.size());
  EXPECT_EQ(bank.entries()[0].count(), 30);
  for (std::size_t g = 1; g < groups.size(); ++g) {
    EXPECT_EQ(bank.entries()[g].count(), 7);
    EXPECT_EQ(bank.entries()[g].first, 30 + 7 * (static_cast<Eigen::Index>(g) - 1));
  }
  double fitted = 0;
  for (std::size_t r = 0; r < c.fit_records(); ++r)
    fitted += LinearCase::kRows * c.x[r] * c.x[r] / LinearCase::kFloor / LinearCase::kFloor;
  const double unseen =
      LinearCase::kRows * c.x.back() * c.x.back() / LinearCase::kFloor / LinearCase::kFloor;
  const Gram& products = bank.Products(c.model);
  const auto n = static_cast<Eigen::Index>(gains.size());
  ASSERT_EQ(products.fit.rows(), n);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b) {
      const double both =
          (gains[static_cast<std::size_t>(a)] - 1) * (gains[static_cast<std::size_t>(b)] - 1);
      EXPECT_NEAR(products.fit(a, b), both * fitted, 1e-4 * both * fitted);
      EXPECT_NEAR(products.validate(a, b), both * unseen, 1e-4 * both * unseen);
    }
}

// A pull of a motor that its bearings cannot hold throws a small rotor off: less of it tells its
// signature all the same, and so do smaller steps its slope.
TEST(SignatureBank, WhatThrowsASmallRotorOffIsTakenSmaller) {
  const RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/small_spindle/rig.toml");
  std::vector<ExaminationRecord> chosen;
  for (const ExaminationRecord& r : Examination(rig, 4))
    if (r.title == "multisine at rest") chosen.push_back(r);
  Case c = EmptyCase(rig, chosen);
  const Case commanded = c;
  FitResult base;
  base.hypothesis = Hypothesis::Base(rig);
  MeasureRecord(CaseModel(commanded), base.hypothesis, 0, 31, 0.1, c);
  const CaseModel model(c);
  ProbeGroup strong;
  strong.probes = {MakeInstance(EffectNamed("side-pull"), "B")};
  strong.probes[0].Set("stiffness", 3e6);
  strong.rows = {0};
  Hypothesis lost = base.hypothesis;
  lost.AddEffect(strong.probes[0]);
  ASSERT_FALSE(model.Predict(lost));
  SignatureBank bank;
  bank.Simulate(model, base, {strong}, nullptr);
  ASSERT_EQ(bank.entries().size(), 1U);
  const double stiffness = bank.entries()[0].group.probes[0].Value("stiffness");
  EXPECT_GT(stiffness, 0);
  EXPECT_LE(stiffness, 3e5);
  Hypothesis little = base.hypothesis;
  little.AddEffect(bank.entries()[0].group.probes[0]);
  EXPECT_GT(Jacobian(model, little, {base.hypothesis.free.size()}).norm(), 0);
}

TEST(SignatureBank, LacksTheRecordsThatItHasNotLookedAt) {
  const LinearCase c({2e-5, 4e-5, 6e-5, 5e-5}, 1.08, 0);
  const FitResult base = c.Base();
  SignatureBank bank;
  bank.LookAt(c.model, {{1, 1, 0, 0}, base.predicted});
  ProbeGroup gain;
  gain.probes = {LinearCase::Gain(1.05)};
  gain.rows = {0};
  bank.Simulate(c.model, base, {gain}, nullptr);
  EXPECT_FALSE(bank.LacksHalfOf({{1, 1, 0, 0}, {}}));
  EXPECT_FALSE(bank.LacksHalfOf({{1, 1, 1, 0}, {}}));
  EXPECT_TRUE(bank.LacksHalfOf({{1, 1, 1, 1}, {}}));
  bank.LookAt(c.model, {{0, 0, 1, 0}, base.predicted});
  EXPECT_FALSE(bank.LacksHalfOf({{1, 1, 1, 1}, {}}));
}

// A zero of A.x in each record, taken off afterwards or while the probes are simulated.
TEST(SignatureBank, NuisancesComeOffAfterwardsAsWhileSimulated) {
  LinearCase c({2e-5, 4e-5, 6e-5, 5e-5}, 1.08, 0);
  const FitResult base = c.Base();
  std::vector<ProbeGroup> groups(2);
  groups[0].probes = {LinearCase::Gain(1.05)};
  groups[1].probes = {LinearCase::Offset(3e-6)};
  for (ProbeGroup& g : groups) g.rows = {0};
  SignatureBank later, at_once;
  later.Simulate(c.model, base, groups, nullptr);
  const Gram bare = later.Products(c.model);
  NuisanceKind zero{"zero of A.x", NuisanceGroup::kSensorZero, "m", 1e-6, StretchColumn()};
  zero.column = StretchColumn(static_cast<Eigen::Index>(c.model.size()));
  for (const Target& t : c.model.targets())
    if (t.channel == 0)
      zero.column.Append(static_cast<Eigen::Index>(t.first),
                         Eigen::VectorXd::Ones(static_cast<Eigen::Index>(t.count)));
  c.model.nuisances.Use(c.model, {zero}, 1);
  later.TakeOffNuisances(c.model);
  at_once.Simulate(c.model, base, groups, nullptr);
  const Gram &a = later.Products(c.model), &b = at_once.Products(c.model);
  EXPECT_LT((a.fit - b.fit).norm(), 1e-5 * b.fit.norm());
  EXPECT_LT((a.validate - b.validate).norm(), 1e-5 * b.validate.norm());
  EXPECT_LT(a.fit(1, 1), 0.1 * bare.fit(1, 1));  // an offset is what a zero explains
}

}  // namespace
}  // namespace ambrig
