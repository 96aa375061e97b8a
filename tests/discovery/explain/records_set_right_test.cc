// Commands that came out larger in one record than its scenario says: pulses do not grow in
// proportion, so that they are simulated at the size found. And a voltage that grows with the
// current of one coil.
#include <gmock/gmock.h>

#include <cmath>

#include "discovery/practice/laws/practice_law.h"
#include "tests/discovery/examined_records.h"

namespace ambrig {
namespace {

// whose bus voltage limits the pulses
const char* const kCompressor = "/examples/heavy_compressor/rig.toml";

const std::vector<std::string> kClamped = {"clamped, current pulses", "clamped, current ramps",
                                           "clamped off centre, current ramps"};

TEST(WithInputs, ScalesEveryExcitationOfItsRecord) {
  const Case c = ExaminedRecords(kReferenceFile, kClamped), larger = WithInputs(c, {0, 0.02});
  EXPECT_EQ(larger.records[0].scenario.excitations[0].amplitude,
            c.records[0].scenario.excitations[0].amplitude);
  for (std::size_t k = 0; k < c.records[1].scenario.excitations.size(); ++k)
    EXPECT_DOUBLE_EQ(larger.records[1].scenario.excitations[k].amplitude,
                     1.02 * c.records[1].scenario.excitations[k].amplitude);
}

TEST(InputsOfRecords, AreSimulatedAtTheSizeFound) {
  Case c = ExaminedRecords(kCompressor, kClamped, {.larger = {0.01, -0.025, 0.01}});
  c.nuisances.input_gain = 0.01;
  ExplainOptions by_slope = ShortSearch();
  by_slope.inputs = 0;
  const Explanation e = Explain(c, ShortSearch()), without = Explain(c, by_slope);
  EXPECT_GT(std::max(without.base_ratio_fit, without.base_ratio_validate), 1.05);
  EXPECT_LT(e.base_ratio_fit, 1.02);
  EXPECT_LT(e.base_ratio_validate, 1.02);
  EXPECT_TRUE(e.adopted.empty());
  EXPECT_NE(e.verdict, ExplanationVerdict::kUnknown);
  const NuisanceFound* pulses = nullptr;
  for (const NuisanceFound& f : e.nuisances)
    if (f.name == kInputGain && f.record == c.records[1].data_file) pulses = &f;
  ASSERT_TRUE(pulses);
  EXPECT_NEAR(pulses->value, -0.025, 1e-3);  // of all searches together
}

// A current loop takes up a constant voltage at once; the part that grows with the current is seen.
TEST(VoltageOfOneCoil, ThatGrowsWithItsCurrentIsItsAmplifiers) {
  const Case c =
      ExaminedRecords(kReferenceFile, kClamped,
                      {.law = {FormulaAt("A.coil3", {{"voltage", "-0.5 * (1 + 0.2 * (i - 2))"}})}});
  const Explanation e = Explain(c, ShortSearch());
  ASSERT_EQ(e.adopted.size(), 1U);
  EXPECT_EQ(e.adopted[0].name, "amplifier-offset");
  EXPECT_EQ(e.adopted[0].target, "A.coil3");
  EXPECT_NEAR(e.adopted[0].Value("resistance"), 0.1,
              0.02);  // a smaller voltage at a larger current
  EXPECT_LT(e.final_ratio_fit, 1.03);
}

}  // namespace
}  // namespace ambrig
