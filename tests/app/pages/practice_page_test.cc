// Results of practice cases: the journal's line reads back as it was written; the page says what
// was counted.
#include "app/pages/practice_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "app/json/practice_json.h"
#include "core/base/read_file.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;

PracticeResult WrongName() {
  PracticeResult r;
  r.name = "case-0001";
  r.kind = "one";
  r.rig = "reference, other size";
  r.noise = "not stated";
  r.nuisances = "declared";
  r.laws = {"eddy-order@A"};
  r.families = {"diffusion of another order"};
  r.for_fit = true;
  r.worst_ratio = 12.5;
  r.answer = {{"effect"}, {{{"eddy-currents", "A"}, {"eddy-impedance", "A"}}}};
  r.finding.verdict = "effect";
  r.finding.first = {"hysteresis", "A"};
  r.finding.adopted = {{"hysteresis", "A"}};
  r.finding.nominal_ratio = 4;
  r.finding.final_ratio = INFINITY;
  r.finding.seconds = 31;
  r.stated.members = {
      {"hysteresis", "A", 0.8}, {"unknown", "", 0.2}, {"quiet", "", 0}, {"data", "", 0}};
  r.stated.features = {0.1, 0.2, 0.3, 0.4, 1};
  r.set = {{"hysteresis", "A", 0.8}, {"unknown", "", 0.2}};
  return r;
}

TEST(PracticeJournalLine, ReadsBack) {
  const auto line = PracticeResultJson(WrongName());
  const PracticeResult r = PracticeResultOf(nlohmann::ordered_json::parse(line.dump()));
  EXPECT_EQ(PracticeResultJson(r).dump(), line.dump());
  EXPECT_EQ(r.answer.slots, WrongName().answer.slots);
  EXPECT_EQ(r.finding.adopted, WrongName().finding.adopted);
  EXPECT_TRUE(std::isinf(r.finding.final_ratio));
  EXPECT_EQ(r.stated.features, WrongName().stated.features);
  EXPECT_TRUE(r.for_fit);
}

TEST(PracticeJournalLine, OfAnotherFormIsRefused) {
  EXPECT_THROW(PracticeResultOf(nlohmann::ordered_json::parse("{\"case\": 1}")),
               nlohmann::json::exception);
}

TEST(PracticePage, SaysWhatWasCounted) {
  PracticeResult right = WrongName(), data = WrongName();
  right.name = "case-0002";
  right.finding.adopted = right.answer.slots[0];
  right.finding.adopted.resize(1);
  right.stated.members[0].effect = right.set[0].effect = "eddy-currents";
  data.name = "case-0003";
  data.kind = "data";
  data.mistake = "sign: record-1: sign of A.x";
  data.answer = {{"data"}, {}};
  const std::vector<PracticeResult> all = {WrongName(), right, data};
  const PracticeSummary s = Summarise(all, nullptr);
  const std::string file = std::filesystem::temp_directory_path() /
                           ("ambrig_practice_" + std::to_string(::getpid()) + ".html");
  WritePracticeReport(all, s, &s, file);
  const std::string page = ReadFile(file);
  std::filesystem::remove(file);
  EXPECT_THAT(page, HasSubstr("case-0003"));
  EXPECT_THAT(page, HasSubstr("1 of 3"));              // all right
  EXPECT_THAT(page, HasSubstr("0 of 1"));              // data recognised
  EXPECT_THAT(page, HasSubstr("eddy-currents at A"));  // hidden
  EXPECT_THAT(page, HasSubstr("diffusion of another order"));
  EXPECT_THAT(page, HasSubstr("Reliability of the most probable answer, calibrated"));
  const auto json = PracticeJson(all, s, nullptr);
  EXPECT_EQ(json.at("as_computed").at("data_recognised").at("of"), 1);
  EXPECT_EQ(json.at("as_computed").at("named_from_wrong_data"), 1);
  EXPECT_EQ(json.at("cases").at(1).at("right"), true);
  EXPECT_FALSE(json.contains("calibrated_on_other_families"));
}

}  // namespace
}  // namespace ambrig
