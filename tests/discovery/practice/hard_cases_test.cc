// Practice cases that the search once got wrong, each a minute or two of computing.
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/base/read_file.h"
#include "discovery/decision/explain.h"
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
    if (std::getenv("AMBRIG_DEAR") == nullptr)
      GTEST_SKIP() << "minutes of computing: AMBRIG_DEAR=1 runs it";
  }
};

// Eddy currents beside an unbalance, with zeros and clocks that nobody declared: each of the two explains little of
// what the other leaves.
TEST_F(HardCases, AnEffectAndNuisancesThatHideEachOther) { EXPECT_TRUE(ScoreOf(16, 35).right()); }

// Eddy currents of two sheets, which the free shapes of both laws do not tell from hysteresis, beside two other effects.
TEST_F(HardCases, ANameThatFreeShapesCompared) { EXPECT_TRUE(ScoreOf(16, 29).right()); }

}  // namespace
}  // namespace ambrig
