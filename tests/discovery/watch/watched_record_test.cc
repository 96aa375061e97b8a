// Which record of the case a new file repeats, and the case that it makes.
#include "discovery/watch/watched_record.h"

#include <gtest/gtest.h>

#include "core/base/toml.h"

namespace ambrig {
namespace {

const char* const kText = R"(rig = "rig.toml"  # mine
noise = { "A.x" = 1e-7 }

[[record]]  # at rest
scenario = "s-1.toml"
data = "d/step-1.csv"
use = "validate"
[record.channels]
"A.x" = { column = "pos", unit = "um" }

[[record]]
scenario = "s-10.toml"
data = "d/step-10.csv"

[[record]]
kind = "frf"
data = "step.csv"
)";

TEST(WatchedRecord, RepeatsTheOneWhoseNameItsOwnBeginsWith) {
  const auto stems = RecordStems(kText, "case.toml");
  EXPECT_EQ(stems, (std::vector<std::string>{"step-1", "step-10", ""}));
  EXPECT_EQ(RepeatedRecord(stems, "logger/step-1.csv"), 0);
  EXPECT_EQ(RepeatedRecord(stems, "step-1-may.h5"), 0);
  EXPECT_EQ(RepeatedRecord(stems, "step-10-may.h5"), 1);
  EXPECT_EQ(RepeatedRecord(stems, "step-12.csv"), -1);
  EXPECT_EQ(RepeatedRecord(stems, "other.csv"), -1);
  EXPECT_EQ(RepeatedRecord({"hover"}, "any.csv"), 0);
  EXPECT_EQ(RepeatedRecord({""}, "any.csv"), -1);  // the only record is a frequency response
}

TEST(WatchedRecord, MakesACaseOfItsOwnWithTheSameLines) {
  const std::string text = CaseOfOneRecord(kText, "case.toml", 0, "/logs/step-1-may.csv");
  const TomlTable t = TomlTable::FromText(text, "case.toml");
  EXPECT_EQ(t.String("rig"), "rig.toml");
  const auto records = t.Tables("record");
  ASSERT_EQ(records.size(), 1u);
  EXPECT_EQ(records[0].String("data"), "/logs/step-1-may.csv");
  EXPECT_EQ(records[0].String("scenario"), "s-1.toml");
  EXPECT_EQ(records[0].String("use"), "fit");
  EXPECT_TRUE(records[0].Table("channels")->Has("A.x"));
  EXPECT_NE(text.find("# mine"), std::string::npos);
  const TomlTable second =
      TomlTable::FromText(CaseOfOneRecord(kText, "case.toml", 1, "/x.csv"), "case.toml");
  EXPECT_EQ(second.Tables("record")[0].String("scenario"), "s-10.toml");
  EXPECT_FALSE(second.Tables("record")[0].Has("channels"));
}

}  // namespace
}  // namespace ambrig
