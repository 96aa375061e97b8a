// Findings against answers: what counts as right, and the counts.
#include "discovery/practice/case_score.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/base/errors.h"

namespace ambrig {
namespace {

const NamedEffect kHum = {"sensor-hum", "A"}, kGain = {"sensor-gain", "B.y"},
                  kBow = {"shaft-bow", "rig"};

TEST(CaseScore, OneEffectMustBeFirstAndAlone) {
  const Answer answer = {{"effect"}, {{kHum}}};
  const CaseScore right = ScoreCase("a", answer, {"effect", kHum, {kHum}});
  EXPECT_TRUE(right.right());
  EXPECT_TRUE(right.first_right);
  const CaseScore more = ScoreCase("a", answer, {"effect", kHum, {kHum, kBow}});
  EXPECT_FALSE(more.right());
  EXPECT_EQ(more.invented, 1U);
  EXPECT_FALSE(ScoreCase("a", answer, {"unknown", kBow, {}}).right());
  // The right name at the wrong place is wrong.
  EXPECT_EQ(ScoreCase("a", answer, {"effect", {"sensor-hum", "B"}, {{"sensor-hum", "B"}}}).found,
            0U);
}

TEST(CaseScore, EitherAnswerOfASlotCountsButOnlyOnce) {
  const Answer answer = {{"effect"}, {{kHum, kBow}, {kGain}}};
  EXPECT_TRUE(ScoreCase("a", answer, {"effect", kGain, {kGain, kBow}}).right());
  EXPECT_EQ(ScoreCase("a", answer, {"effect", kHum, {kHum, kBow}}).found, 1U);
}

TEST(CaseScore, TalliesAndConfusion) {
  std::vector<CaseScore> all = {
      ScoreCase("1", {{"effect"}, {{kHum}}}, {"effect", kHum, {kHum}, 5, 1.1}),
      ScoreCase("2", {{"effect"}, {{kGain}}}, {"effect", kBow, {kBow}, 5, 1.7}),
      ScoreCase("3", {{"none"}, {}}, {"none", {}, {}, 1, 1}),
      ScoreCase("4", {{"unknown"}, {}}, {"effect", kBow, {kBow}, 9, 2}),
      ScoreCase("5", {{"effect"}, {{kHum}, {kGain}}}, {"effect", kHum, {kHum, kGain}, 9, 1})};
  std::map<std::string, std::pair<std::size_t, std::size_t>> counts;  // by the first two words
  for (const Tally& t : Tallies(all))
    counts[t.kind.substr(0, t.kind.find(' ', t.kind.find(' ') + 1))] = {t.right, t.cases};
  using Counts = std::pair<std::size_t, std::size_t>;
  EXPECT_EQ(counts.at("one effect:"), (Counts{1, 2}));
  EXPECT_EQ(counts.at("two effects:"), (Counts{1, 1}));
  EXPECT_EQ(counts.at("no effect:"), (Counts{1, 2}));
  EXPECT_EQ(counts.at("outside the"), (Counts{0, 1}));
  EXPECT_EQ(counts.at("verdict right"), (Counts{4, 5}));
  EXPECT_EQ(counts.at("unseen error"), (Counts{2, 3}));
  const auto confusion = Confusion(all);
  EXPECT_EQ(confusion.at("sensor-hum").at("sensor-hum"), 2);
  EXPECT_EQ(confusion.at("sensor-gain").at("shaft-bow"), 1);
  EXPECT_EQ(confusion.at("sensor-gain").at("sensor-gain"), 1);
  EXPECT_EQ(confusion.at("unknown").at("shaft-bow"), 1);
}

TEST(CaseScore, ReadsAnswersAndNamesWhatIsWrongWithThem) {
  const std::string file = std::filesystem::temp_directory_path() /
                           ("ambrig_answers_" + std::to_string(::getpid()) + ".toml");
  std::ofstream(file)
      << "[\"case-1\"]\nverdict = [\"effect\"]\neffects = [\n [{ effect = \"sensor-hum\", target = "
         "\"A\" }, { effect = \"base-vibration\", target = \"rig\" }],\n]\nseed = 3\n";
  const auto answers = ReadAnswers(file);
  ASSERT_EQ(answers.at("case-1").slots.size(), 1U);
  EXPECT_EQ(answers.at("case-1").slots[0][1], (NamedEffect{"base-vibration", "rig"}));
  std::ofstream(file) << "[\"case-1\"]\nverdict = [\"effect\"]\neffects = [3]\n";
  EXPECT_THROW(ReadAnswers(file), InputError);
}

}  // namespace
}  // namespace ambrig
