// "Which block is it?": the answer of `compare` for errors of blocks that are written down.
#include <gmock/gmock.h>

#include "app/pages/discovery_parts.h"

namespace ambrig {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

RecordComparison Of(const std::string& data, double ratio, const BlockErrors& blocks) {
  RecordComparison r;
  r.data = data;
  r.ratio = ratio;
  r.blocks = blocks;
  return r;
}

Comparison Of(const std::vector<RecordComparison>& records) {
  Comparison c;
  c.records = records;
  return c;
}

TEST(BlockText, NamesTheWorstBlockItsRecordAndTheNextOne) {
  const std::string text =
      BlockText(Of({Of("data/record-1.h5", 3, {{"coil", 1.1}, {"rotor", 2.0}, {"controller", 1.0}}),
                    Of("data/record-4.h5", 9, {{"coil", 1.7}, {"rotor", 6.25}})}));
  EXPECT_THAT(text, HasSubstr("6.25 times its noise, of the rotor block in record-4"));
  EXPECT_THAT(text, HasSubstr("next comes coil with 1.70"));
  EXPECT_THAT(text, Not(HasSubstr("do not tell")));
}

// Blocks at 1.1 beside a model that is 14.7 floors off are no answer; that is said.
TEST(BlockText, SaysWhenTheBlocksDoNotTell) {
  const std::string text =
      BlockText(Of({Of("record-1.h5", 14.7, {{"coil", 1.10}, {"rotor", 1.15}, {"sensor", 0.53}})}));
  EXPECT_THAT(text, AllOf(HasSubstr("do not tell where the error sits"), HasSubstr("14.70 times"),
                          HasSubstr("rotor at most, 1.15"), HasSubstr("ambrig explain")));
}

// A block somewhat above its noise does not explain a loop that is far off.
TEST(BlockText, ASmallErrorOfABlockDoesNotExplainALargeOne) {
  const std::string text =
      BlockText(Of({Of("record-1.h5", 14.7, {{"coil", 1.6}, {"rotor", 1.2}})}));
  EXPECT_THAT(text, HasSubstr("1.60 times its noise, of the coil block"));
  EXPECT_THAT(text, HasSubstr("The whole model is 14.70 times the noise off, far more"));
  EXPECT_THAT(BlockText(Of({Of("r.h5", 4, {{"coil", 1.6}})})), Not(HasSubstr("far more")));
}

TEST(BlockText, AgreementAndNothingTested) {
  EXPECT_EQ(BlockText(Of({Of("r.h5", 1.0, {{"coil", 1.02}, {"rotor", 0.97}})})),
            "No block stands out: the largest is coil with 1.02 times its noise.");
  EXPECT_EQ(BlockText(Of({Of("r.h5", 5, {})})), "");
  EXPECT_EQ(BlockText({}), "");
}

// A record without block tests does not count as the whole model's error beside those that have
// them.
TEST(BlockText, OnlyRecordsWithBlocksCount) {
  EXPECT_THAT(BlockText(Of({Of("a.h5", 20, {}), Of("b.h5", 1.1, {{"coil", 1.0}})})),
              HasSubstr("No block stands out"));
}

}  // namespace
}  // namespace ambrig
