// Practice cases that the search once got wrong, each a minute or two of computing.
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/base/read_file.h"
#include "discovery/explain/explain.h"
#include "discovery/practice/case_score.h"
#include "discovery/practice/practice_case.h"
#include "discovery/practice/practice_result.h"

namespace ambrig {
namespace {

/// Explains case number `number` (1: first) of a seed on the three usual rigs.
CaseScore ScoreOf(std::uint64_t seed, std::size_t number) {
  std::vector<PracticeRig> rigs;
  for (const std::string name : {"reference", "small_spindle", "heavy_compressor"}) {
    const std::string file = std::string(AMBRIG_SOURCE_DIR) + "/examples/" + name + "/rig.toml";
    rigs.push_back({name, file, ReadFile(file)});
  }
  const PracticeCase c = MakePracticeCase(rigs, seed, number - 1);
  const PracticeResult r = ResultOf(c, Explain(c.data, {}));
  return ScoreCase(r.name, r.answer, r.finding);
}

class HardCases : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("AMBRIG_SLOW_TESTS") == nullptr)
      GTEST_SKIP() << "minutes of computing: AMBRIG_SLOW_TESTS=1 runs it";
  }
};

// Eddy currents beside an unbalance, with zeros and clocks that nobody declared: each of the two
// explains little of what the other leaves.
TEST_F(HardCases, AnEffectAndNuisancesThatHideEachOther) { EXPECT_TRUE(ScoreOf(16, 35).right()); }

// Eddy currents of two sheets, which the free shapes of both laws do not tell from hysteresis,
// beside two other effects.
TEST_F(HardCases, ANameThatFreeShapesCompared) { EXPECT_TRUE(ScoreOf(16, 29).right()); }

// A cross-coupling that falls off with the orbit: its free shape explains what the law leaves.
TEST_F(HardCases, ACrossCouplingOfTheOrbit) { EXPECT_TRUE(ScoreOf(16, 46).right()); }

// A coupling of many orders, whose rest looks like a run-out.
TEST_F(HardCases, ACouplingOfManyOrders) { EXPECT_TRUE(ScoreOf(16, 48).right()); }

// Eddy currents of two sheets and a cross-coupling, beside commands that are larger in every
// record.
TEST_F(HardCases, CommandsThatAreLargerInEveryRecord) { EXPECT_TRUE(ScoreOf(16, 22).right()); }

// Eddy currents of a tenth of the smallest usual size, in a closed ring, found in a pair with an
// effect that then goes.
TEST_F(HardCases, WhatAPairLeavesAlone) { EXPECT_TRUE(ScoreOf(17, 4).right()); }

// Commands of another size move the instants at which a limiter lets go: undeclared ones are
// simulated so, too.
TEST_F(HardCases, CommandsOfAnotherSizeThatNobodyDeclared) { EXPECT_TRUE(ScoreOf(17, 14).right()); }

// The details of the coupling's law and of an unbalance that grows hide the pull.
TEST_F(HardCases, APullBesideACouplingOfManyOrders) { EXPECT_TRUE(ScoreOf(13, 49).right()); }

// A sensor gain stood in for zeros and commands that nobody declared; beside these it is needless.
TEST_F(HardCases, WhatNuisancesMakeNeedless) { EXPECT_TRUE(ScoreOf(17, 11).right()); }

}  // namespace
}  // namespace ambrig
