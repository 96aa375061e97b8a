// Practice cases: in turn of every kind, the same again, with answers that score reads.
#include "discovery/practice/practice_case.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "core/base/read_file.h"
#include "core/base/toml_edit.h"
#include "discovery/model/floor.h"
#include "discovery/model/residual.h"
#include "discovery/practice/practice_surroundings.h"
#include "rig/rig_file.h"

namespace ambrig {
namespace {

std::vector<PracticeRig> RadialReference() {
  const std::string file = std::string(AMBRIG_SOURCE_DIR) + "/examples/reference/rig.toml";
  return {{"reference", file, WithoutTomlTable(ReadFile(file), file, "bearings.Z")}};
}

TEST(PracticeCases, TwentyHaveEveryKind) {
  std::map<std::string, int> count;
  for (std::size_t k = 40; k < 60; ++k) ++count[KindOfPracticeCase(k)];
  EXPECT_EQ(
      count,
      (std::map<std::string, int>{
          {"one", 9}, {"two", 2}, {"three", 1}, {"unknown", 2}, {"nothing", 2}, {"data", 4}}));
  EXPECT_EQ(NameOfPracticeCase(6), "case-0007");
}

// Number 0 has one effect: its records show it, its answer reads back, and it is made again bit by
// bit; another seed gives another case.
TEST(PracticeCases, OneEffectAgainTheSame) {
  const auto rigs = RadialReference();
  const PracticeCase c = MakePracticeCase(rigs, 1, 0), again = MakePracticeCase(rigs, 1, 0);
  EXPECT_EQ(c.kind, "one");
  ASSERT_EQ(c.answer.slots.size(), 1U);
  EXPECT_GE(c.worst_ratio, 5);
  EXPECT_LE(c.worst_ratio, 60);
  ASSERT_EQ(again.data.records.size(), c.data.records.size());
  for (std::size_t r = 0; r < c.data.records.size(); ++r)
    for (std::size_t k = 0; k < c.data.records[r].data.channels.size(); ++k)
      ASSERT_EQ(c.data.records[r].data.channels[k].samples,
                again.data.records[r].data.channels[k].samples);
  const std::string file = std::filesystem::temp_directory_path() /
                           ("ambrig_practice_" + std::to_string(::getpid()) + ".toml");
  std::ofstream(file) << c.answer_text;
  const Answer answer = ReadAnswers(file).at(c.name);
  EXPECT_EQ(answer.verdicts, c.answer.verdicts);
  EXPECT_EQ(answer.slots, c.answer.slots);
  std::filesystem::remove(file);
  EXPECT_NE(MakePracticeCase(rigs, 2, 0).answer_text, c.answer_text);
}

// Of 20 cases two have two effects. The laws go round: late ones are no repetition of the first.
TEST(PracticeCases, TwoEffectsAreOfTwoLawsWhichChange) {
  std::set<std::string> second;
  std::size_t number = 60;
  for (int cases = 0; cases < 2; ++number) {
    if (KindOfPracticeCase(number) != "two") continue;
    const PracticeCase c = MakePracticeCase(RadialReference(), 3, number);
    ASSERT_EQ(c.laws.size(), 2U);
    EXPECT_NE(c.laws[0], c.laws[1]);
    EXPECT_EQ(c.answer.slots.size(), 2U);
    second.insert(c.laws[1]);
    ++cases;
  }
  EXPECT_EQ(second.size(), 2U);
}

// The true rig leaves the noise and nothing else where the records have no nuisances; the rig
// file's leaves more.
TEST(PracticeCases, OnlyTheTruthExplainsTheData) {
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    const PracticeCase c = MakePracticeCase(RadialReference(), seed, 0);
    if (c.nuisances != "none") continue;
    CaseModel model(c.data);
    Hypothesis truth, believed = Hypothesis::Base(c.data.rig);
    truth.rig = c.truth;
    const NoiseFloor floor = FindFloor(model, truth);
    EXPECT_NEAR(Ratio(model, Residual(model, floor.clean), Which::kAll), 1.0, 0.05);
    EXPECT_GT(Ratio(model, Residual(model, *model.Predict(believed)), Which::kAll), 1.5);
    return;
  }
  FAIL() << "every case has nuisances";
}

// Number 2 has wrong data: "data" is the one right verdict and the mistake is named.
TEST(PracticeCases, WrongDataSaysWhatIsWrong) {
  const PracticeCase c = MakePracticeCase(RadialReference(), 1, 2);
  EXPECT_EQ(c.answer.verdicts, std::vector<std::string>{"data"});
  EXPECT_TRUE(c.answer.slots.empty());
  EXPECT_NE(c.mistake.find("unit"), std::string::npos) << c.mistake;
}

// Mistakes come in turn: the second case of wrong data (number 9) has a wrong sign, the third (15)
// a lag.
TEST(PracticeCases, WrongDataAreOfEveryKindInTurn) {
  EXPECT_NE(MakePracticeCase(RadialReference(), 1, 9).mistake.find("sign"), std::string::npos);
  EXPECT_NE(MakePracticeCase(RadialReference(), 1, 15).mistake.find("lag"), std::string::npos);
}

// A clock that is one row off: the record is that of the right clock, one row later or earlier.
TEST(PracticeSurroundings, AClockThatIsOffShiftsRowsByOne) {
  const PracticeRig rig = RadialReference()[0];
  Hypothesis truth;
  truth.rig = ReadRigText(rig.text, rig.file);
  const ExaminationRecord one = {
      "clamped",
      "name = \"clamped\"\nrig = \"rig.toml\"\nduration = 0.01\nrecord_rate = 12500.0\n\n"
      "[start]\nstate = \"clamped\"\nposition = { A = [3e-5, 0.0], B = [0.0, -2e-5] }\n"};
  const std::vector<ExaminationRecord> records(200, one);
  Surroundings s;
  Case right = EmptyCase(truth.rig, records), off = right;
  FillRecords(s, truth, 11, nullptr, right);
  s.time_shift = 1e-4;
  FillRecords(s, truth, 11, nullptr, off);
  int late = 0, early = 0;
  for (std::size_t r = 0; r < records.size(); ++r) {
    const std::vector<double>&a = right.records[r].data.Find("A.i1")->samples,
          &b = off.records[r].data.Find("A.i1")->samples;
    ASSERT_EQ(a.size(), b.size());
    if (a == b) continue;
    const bool is_late =
                   std::equal(a.begin(), a.end() - 1, b.begin() + 1) && b.front() == a.front(),
               is_early = std::equal(a.begin() + 1, a.end(), b.begin()) && b.back() == a.back();
    EXPECT_NE(is_late, is_early) << r;
    (is_late ? late : early) += 1;
  }
  EXPECT_NEAR(late, 0.15 * 200, 15);  // of 30 % of the records, three sd
  EXPECT_NEAR(early, 0.15 * 200, 15);
  EXPECT_NEAR(late + early, 0.3 * 200, 20);
}

// Another size is still a rig, and its gains follow the mass.
TEST(PracticeSurroundings, OtherSizesReadBack) {
  const PracticeRig rig = RadialReference()[0];
  const RigParameters before = ReadRigText(rig.text, rig.file),
                      after = ReadRigText(WithOtherSizes(rig.text, rig.file, 4), rig.file);
  EXPECT_NE(after.rotor.mass, before.rotor.mass);
  // four digits are kept of each number
  const std::string text = WithOtherSizes(rig.text, rig.file, 4);
  const auto factor = [&](const char* path) {
    return TomlNumberAt(text, rig.file, path) / TomlNumberAt(rig.text, rig.file, path);
  };
  EXPECT_NEAR(factor("controller.kp"), factor("rotor.mass"), 1e-3);
  EXPECT_NEAR(factor("bearings.A.pole_area"), factor("rotor.mass") * factor("bearings.A.gap"),
              2e-3);
}

// What is stated wrongly is off by a factor of 2 to 20; what is not stated is left out.
TEST(PracticeSurroundings, NoiseIsStatedAsTheModeSays) {
  const PracticeRig rig = RadialReference()[0];
  const RigParameters believed = ReadRigText(rig.text, rig.file);
  std::map<std::string, int> modes;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Surroundings s = DrawSurroundings(believed, seed);
    ++modes[s.noise_mode];
    const std::string text = PracticeCaseText(s, {});
    EXPECT_EQ(text.find("noise =") == std::string::npos, s.noise_mode == "not stated");
    EXPECT_EQ(text.find("[nuisance]") != std::string::npos, s.nuisance_mode == "declared");
    EXPECT_EQ(s.zero.empty(), s.nuisance_mode == "none");
    for (const auto& [channel, rms] : s.stated) {
      const double factor = std::max(rms / s.noise.at(channel), s.noise.at(channel) / rms);
      if (s.noise_mode == "stated") {
        EXPECT_EQ(factor, 1) << channel;
      } else {
        EXPECT_GE(factor, 2 - 1e-9) << channel;
      }
    }
  }
  EXPECT_EQ(modes.size(), 3U);
}

TEST(PracticeSurroundings, ABowIsAlsoAPairOfUnbalances) {
  EXPECT_EQ(RightNames("shaft-bow", "rig").size(), 3U);
  EXPECT_EQ(RightNames("saturation", "A"), (std::vector<NamedEffect>{{"saturation", "A"}}));
}

// The copper of another rig is thinner or thicker than drawn, within a quarter either way.
TEST(PracticeSurroundings, ResistancesOfOtherSizesLieAroundTheDrawing) {
  const PracticeRig rig = RadialReference()[0];
  int less = 0, more = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const std::string text = WithOtherSizes(rig.text, rig.file, seed);
    const double factor = TomlNumberAt(text, rig.file, "bearings.A.resistance") /
                          TomlNumberAt(rig.text, rig.file, "bearings.A.resistance");
    EXPECT_GE(factor, 0.799);
    EXPECT_LE(factor, 1.251);
    (factor < 1 ? less : more) += 1;
  }
  EXPECT_GT(less, 4);
  EXPECT_GT(more, 4);
}

}  // namespace
}  // namespace ambrig
