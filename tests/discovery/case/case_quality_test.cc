// Data from outside with something wrong in it: said in one line, left out, or refused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "discovery/data_gate/gate_checks.h"
#include "discovery/decision/compare.h"

namespace ambrig {
namespace {

namespace fs = std::filesystem;

class CaseQuality : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("ambrig_quality_" + std::to_string(::getpid()) + "_" +
               std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder_);
    fs::copy(fs::path(AMBRIG_SOURCE_DIR) / "examples/mls2em", folder_, fs::copy_options::recursive);
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Rewrites cells of the first record: (row, column, text) -> text.
  void Edit(const std::function<std::string(int, int, const std::string&)>& change) const {
    const fs::path file = folder_ / "data/inductance_em1_01.csv";
    std::ifstream in(file);
    std::ostringstream out;
    std::string line;
    for (int row = -1; std::getline(in, line); ++row) {
      std::istringstream cells(line);
      std::string cell;
      for (int column = 0; std::getline(cells, cell, ','); ++column)
        out << (column ? "," : "") << (row < 0 ? cell : change(row, column, cell));
      out << "\n";
    }
    in.close();
    std::ofstream(file) << out.str();
  }
  void EditCase(const std::string& from, const std::string& to) const {
    std::ifstream in(folder_ / "case.toml");
    std::ostringstream text;
    text << in.rdbuf();
    std::string s = text.str();
    const auto at = s.find(from);
    ASSERT_NE(at, std::string::npos);
    s.replace(at, from.size(), to);
    std::ofstream(folder_ / "case.toml") << s;
  }
  Case Read() const { return ReadCase((folder_ / "case.toml").string()); }
  std::string Complaint() const {
    try {
      Read();
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }
  bool Noted(const std::string& part) const {
    const Case c = Read();
    return std::any_of(c.notes.begin(), c.notes.end(),
                       [&](const std::string& n) { return n.find(part) != std::string::npos; });
  }
  fs::path folder_;
};

constexpr int kTime = 0, kCurrent = 3, kDuty = 5;

TEST_F(CaseQuality, MissingSamplesAreLeftOutAndTheRestCounts) {
  Edit([](int row, int column, const std::string& cell) {
    return column == kCurrent && row >= 1000 && row < 1099 ? "nan" : cell;
  });
  EXPECT_TRUE(Noted("M.i1: 99 samples missing, left out"));
  const Case c = Read();
  CaseModel model(c);
  const Comparison compared = Compare(model, Hypothesis::Base(c.rig), false);
  EXPECT_TRUE(std::isfinite(compared.ratio));
  EXPECT_NEAR(compared.records[0].ratio, 8.9, 0.3);
}

TEST_F(CaseQuality, AStuckCurrentIsNoData) {
  Edit([](int, int column, const std::string& cell) { return column == kCurrent ? "0.5" : cell; });
  EXPECT_TRUE(Noted("M.i1: stuck at 0.5: left out"));
  EXPECT_FALSE(Read().records[0].quality[0].use);
}

TEST_F(CaseQuality, AHoleInWhatWasCommandedIsRefused) {
  Edit([](int row, int column, const std::string& cell) {
    return column == kDuty && row == 998 ? "nan" : cell;
  });
  const std::string text = Complaint();
  EXPECT_NE(text.find("steps-01.toml:"), std::string::npos) << text;
  EXPECT_NE(text.find("4.99 s"), std::string::npos) << text;
}

// 12 s of a scenario, and 24 s of which nothing is known: of another scenario, or a logger that was
// stopped late.
TEST_F(CaseQuality, ARecordLongerThanItsScenario) {
  Edit([](int, int column, const std::string& cell) {
    return column == kTime ? std::to_string(3 * std::stod(cell)) : cell;
  });
  const auto lengths = [](const Case& c) {
    const CaseModel model(c);
    std::vector<DataFault> out;
    for (std::size_t r = 0; r < c.records.size(); ++r) CheckLength(model, r, out);
    return out;
  };
  const std::vector<DataFault> told = lengths(Read());
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].fault, "scenario");
  EXPECT_TRUE(told[0].record.ends_with("inductance_em1_01.csv")) << told[0].record;
  EXPECT_NEAR(told[0].seconds, 24, 0.02);
  EXPECT_NE(FaultText(told[0]).find("s longer than its scenario"), std::string::npos);
  EditCase("use = \"fit\"", "use = \"fit\"\n" + told[0].mend);
  EXPECT_TRUE(lengths(Read()).empty()) << told[0].mend;
}

// A logger with a trigger writes what was before it, and one that is stopped by hand what comes
// after.
TEST_F(CaseQuality, ALittleBeforeAndAfterAScenarioIsLeftOut) {
  Edit([](int, int column, const std::string& cell) {
    return column == kTime ? std::to_string(1.08 * std::stod(cell) - 0.5) : cell;
  });
  const Case c = Read();
  EXPECT_GE(c.records[0].data.start, 0);
  EXPECT_LT(c.records[0].data.start * c.records[0].data.rate, 1);
  EXPECT_LE(c.records[0].data.TimeAt(c.records[0].data.rows() - 1), 12);
  EXPECT_EQ(c.records[0].behind, 0);  // no other scenario's
  EXPECT_TRUE(Noted("the first 0.5"));
  EXPECT_TRUE(Noted("s, after the scenario, are left out"));
}

TEST_F(CaseQuality, ARecordAfterItsScenarioIsRefused) {
  Edit([](int, int column, const std::string& cell) {
    return column == kTime ? std::to_string(100 + std::stod(cell)) : cell;
  });
  EXPECT_NE(Complaint().find("allowed: times of the excitation, 0 s to 12 s"), std::string::npos)
      << Complaint();
}

TEST_F(CaseQuality, WrongUnitColumnAndUse) {
  EditCase("unit = \"A\"", "unit = \"V\"");
  EXPECT_NE(Complaint().find("unit V, allowed A, mA, uA"), std::string::npos) << Complaint();
  EditCase("unit = \"V\"", "unit = \"A\"");
  EditCase("column = \"i1_A\"", "column = \"i9_A\"");
  EXPECT_NE(Complaint().find("column \"i9_A\""), std::string::npos) << Complaint();
  EditCase("column = \"i9_A\"", "column = \"i1_A\"");
  for (int k = 0; k < 5; ++k) EditCase("\"fit\"", "\"validate\"");
  EXPECT_NE(Complaint().find("no record with use = \"fit\""), std::string::npos) << Complaint();
}

}  // namespace
}  // namespace ambrig
