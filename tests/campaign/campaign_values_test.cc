// Numbers of a campaign file: one or a list, in their range, each once.
#include "campaign/campaign_values.h"

#include <gmock/gmock.h>

#include "tests/core/temporary_folder.h"

namespace ambrig::testing {
namespace {

using ::testing::ElementsAre;

TomlTable Table(const std::string& text) { return TomlTable::FromText(text, "c.toml"); }

TEST(CampaignValues, OneNumberIsAListOfOne) {
  EXPECT_THAT(List(Table("loads = 0.5"), "loads", {}, 0, 2, "N"), ElementsAre(0.5));
  EXPECT_THAT(List(Table("loads = 1"), "loads", {}, 0, 2, "N"), ElementsAre(1));
  EXPECT_THAT(List(Table("loads = [1.5, 0.5]"), "loads", {}, 0, 2, "N"), ElementsAre(1.5, 0.5));
}

TEST(CampaignValues, WithoutAKeyTheFallbackHolds) {
  EXPECT_THAT(List(Table(""), "loads", {0.25, 2}, 0, 2, "N"), ElementsAre(0.25, 2));
  EXPECT_EQ(In(Table(""), "time", 0.02, 0, 1, "s"), 0.02);
}

TEST(CampaignValues, BothEndsOfTheRangeBelongToIt) {
  EXPECT_THAT(List(Table("loads = [0, 2]"), "loads", {}, 0, 2, "N"), ElementsAre(0, 2));
  EXPECT_EQ(In(Table("time = 1"), "time", 0, 0, 1, "s"), 1);
}

// Line, key, value and what is allowed, with its unit.
TEST(CampaignValues, MistakesSayWhatIsAllowed) {
  const std::pair<const char*, const char*> lists[] = {
      {"loads = 3", "c.toml:1: loads = 3, allowed: 0 to 2 N"},
      {"\nloads = [1, -1]", "c.toml:2: loads = -1, allowed: 0 to 2 N"},
      {"loads = [1, nan]", "c.toml:1: loads = ["},
      {"loads = []", "c.toml:1: loads = [], allowed: at least one number from 0 to 2 N"},
      {"loads = [1, 2, 1]", "c.toml:1: loads = 1 is given twice, allowed: different values"},
      {"loads = [1, 1.0]", "c.toml:1: loads = 1 is given twice"},
      {"loads = \"all\"", "c.toml:1: loads"},
      {"loads = [\"1\"]", "c.toml:1: loads"},
  };
  for (const auto& [text, said] : lists)
    EXPECT_THAT(ErrorText<InputError>([&] { List(Table(text), "loads", {}, 0, 2, "N"); }),
                ::testing::StartsWith(said))
        << text;
  for (const char* value : {"-1e-9", "1.5", "inf", "nan"})
    EXPECT_THAT(ErrorText<InputError>(
                    [&] { In(Table(std::string("time = ") + value), "time", 0, 0, 1, "s"); }),
                ::testing::StartsWith("c.toml:1: time = "))
        << value;
}

}  // namespace
}  // namespace ambrig::testing
