// The page of a campaign where something was not measured or not asked for, and tables with a long
// path.
#include <gmock/gmock.h>

#include "app/pages/campaign_report.h"
#include "tests/app/html_page.h"
#include "tests/campaign/table_rows.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using testing::RowOf;

Row Healthy(std::size_t run, const char* verdict, const char* orbit, const char* load = "0") {
  return RowOf(run, {{"set", "A:healthy"},
                     {"failed", "0"},
                     {"class", "healthy"},
                     {"kind", "none"},
                     {"speed", "0"},
                     {"load_given", load},
                     {"load", load},
                     {"capacity", "60"},
                     {"verdict", verdict},
                     {"judged", "0"},
                     {"detected", "0"},
                     {"right_class", "0"},
                     {"false_alarms", "0"},
                     {"coil_periods", "1000"},
                     {"peak_orbit", orbit}});
}

std::string Page(const Rows& rows) {
  return testing::Written([&](const std::string& path) {
    WriteCampaignReport({"c", "/a/long/path/to/some/campaign.toml", "12", rows.size()}, rows, path);
  });
}

// No run stayed up: there is no largest orbit of those that did.
TEST(CampaignWords, WhatWasNotMeasuredIsADash) {
  const std::string words = testing::Words(Page({{0, Healthy(0, "touchdown", "2.7e-4")}}));
  EXPECT_THAT(words, HasSubstr("largest orbit of runs that stayed up\n–\n"));
  EXPECT_THAT(words, HasSubstr("worst detection delay\n–\n"));
  EXPECT_THAT(words, Not(HasSubstr("– s")));
  EXPECT_THAT(words, Not(HasSubstr("\n0 m\n")));
}

TEST(CampaignWords, WithoutLoadsThereIsNoCapacityToCompare) {
  EXPECT_THAT(testing::Words(Page({{0, Healthy(0, "up", "2e-5")}})),
              Not(HasSubstr("Capacity against theory")));
  EXPECT_THAT(testing::Words(Page({{0, Healthy(0, "up", "2e-5", "10")}})),
              HasSubstr("Capacity against theory"));
}

// The command that repeats a run may break anywhere, the other cells are not squeezed for it.
TEST(CampaignWords, OnlyThePathBreaksAnywhere) {
  const std::string html = Page({{0, Healthy(0, "touchdown", "2.7e-4")}});
  EXPECT_THAT(html, HasSubstr("<td class=\"muted path \">ambrig run --from-campaign"));
  EXPECT_THAT(html, HasSubstr("td.path { width: 24rem; overflow-wrap: anywhere; }"));
  EXPECT_THAT(html, HasSubstr("<td class=\"warn \">touchdown</td>"));
}

TEST(CampaignWords, CountsAreInTheVerdict) {
  const std::string words = testing::Words(Page({{0, Healthy(0, "up", "1e-5")},
                                                 {1, Healthy(1, "up", "3e-5")},
                                                 {2, Healthy(2, "drop", "4e-4")}}));
  EXPECT_THAT(words, HasSubstr("2 of 3 runs stayed up, 0 touched down, 1 dropped."));
  EXPECT_THAT(words, HasSubstr("largest orbit of runs that stayed up\n30\u00a0µm\n"));
  EXPECT_THAT(words, HasSubstr("runs done\n3 of 3\n"));
}

}  // namespace
}  // namespace ambrig
