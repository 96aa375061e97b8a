// Records of another scenario are named with it, at any rate of the logger.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "discovery/model/record_rows.h"
#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

using testing::FaultsOf;
using testing::kStepRecord;
using testing::Measured;
using testing::RecordNamed;

/// Each record at most once.
void ExpectExchanged(const std::vector<DataFault>& faults, const std::string& other) {
  std::vector<std::string> named;
  for (const DataFault& f : faults) {
    if (f.fault != "scenario") continue;
    EXPECT_EQ(std::ranges::count(named, f.record), 0) << f.record;
    named.push_back(f.record);
    EXPECT_TRUE(f.record == kStepRecord || f.record == other) << f.record;
    EXPECT_EQ(f.with, f.record == kStepRecord ? other : kStepRecord);
    EXPECT_EQ(f.mend, "scenario = \"" + f.with + "\"");
    EXPECT_GT(f.probability, 0.8);
  }
  EXPECT_GE(named.size(), 1U);
}

// The data of two scenarios exchanged: each record is said to be of the other's scenario, whether
// its speed shows it or not.
TEST(GateScenario, DataOfAnotherScenarioAreNamedWithIt) {
  const char* kOther = "multisine at 60 Hz";
  Case c = Measured({}, 0, kOther);
  const std::size_t a = RecordNamed(c, kStepRecord), b = RecordNamed(c, kOther);
  ASSERT_NE(b, 99U);
  std::swap(c.records[a].data, c.records[b].data);
  std::swap(c.records[a].quality, c.records[b].quality);
  for (const bool speed : {true, false}) {
    if (!speed)
      for (CaseRecord* r : {&c.records[a], &c.records[b]})
        for (Channel& ch : r->data.channels)
          if (ch.name == "omega" || ch.name == "theta")
            std::fill(ch.samples.begin(), ch.samples.end(), std::nan(""));
    ExpectExchanged(FaultsOf(c), kOther);
  }
  // the line to paste names the file as the case file does
  c.file = "bench/case.toml";
  for (CaseRecord& r : c.records) r.scenario_file = "bench/" + r.scenario_file;
  for (const DataFault& f : FaultsOf(c))
    EXPECT_EQ(f.mend, "scenario = \"" + f.with.substr(6) + "\"");
}

/// Steps at rest twice, the second time with loads that are a fifth larger, measured on a rotor
/// that is 1 % heavier than the file states, and a third record.
Case TwoSimilarRecords() {
  Case c = Measured({}, 0, "multisine at 60 Hz");
  CaseRecord more = c.records[RecordNamed(c, kStepRecord)];
  more.data_file = more.scenario_file = "steps with larger loads";
  for (LoadSpec& l : more.scenario.loads) l.fx *= 1.2, l.fy *= 1.2;
  c.records.push_back(more);
  Hypothesis truth;
  truth.rig = testing::RadialRig();
  truth.rig.rotor.mass *= 1.01;
  return testing::MeasuredBy(truth, std::move(c));
}

// Files of two records that command the same steps, and whose loads differ little.
TEST(GateScenario, ExchangedRecordsThatDifferLittle) {
  Case c = TwoSimilarRecords();
  for (const DataFault& f : FaultsOf(c)) ADD_FAILURE() << FaultText(f);
  CaseRecord &a = c.records[RecordNamed(c, kStepRecord)], &b = c.records.back();
  std::swap(a.data, b.data);
  std::swap(a.quality, b.quality);
  const std::vector<DataFault> faults = FaultsOf(c);
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].with, b.scenario_file);
  EXPECT_EQ(faults[1].with, a.scenario_file);
  for (const DataFault& f : faults) EXPECT_EQ(f.fault, "scenario") << FaultText(f);
}

/// The record as a logger of another rate would have it, straight between its rows.
void WithRate(CaseRecord& r, double rate) {
  const Record old = r.data;
  const auto rows =
      static_cast<std::size_t>(std::floor(static_cast<double>(old.rows() - 1) * rate / old.rate)) +
      1;
  r.data.rate = rate;
  for (std::size_t ch = 0; ch < old.channels.size(); ++ch) {
    r.data.channels[ch].samples.assign(rows, 0);
    for (std::size_t k = 0; k < rows; ++k)
      r.data.channels[ch].samples[k] = AtRow(old.channels[ch].samples, old.rate, r.data, k);
    r.quality[ch].ok.assign(rows, 1);
  }
}

// A logger's rate that is no part of the switching frequency: the other scenario is simulated at
// one that is.
TEST(GateScenario, DataOfAnotherScenarioAreNamedAtAnyRate) {
  const char* kOther = "multisine at 60 Hz";
  Case c = Measured({}, 0, kOther);
  CaseRecord &a = c.records[RecordNamed(c, kStepRecord)], &b = c.records[RecordNamed(c, kOther)];
  std::swap(a.data, b.data);
  std::swap(a.quality, b.quality);
  for (CaseRecord* r : {&a, &b}) {
    WithRate(*r, 10000);
    for (Channel& ch : r->data.channels)
      if (ch.name == "omega" || ch.name == "theta")
        std::fill(ch.samples.begin(), ch.samples.end(), std::nan(""));
  }
  ExpectExchanged(FaultsOf(c), kOther);
}

}  // namespace
}  // namespace ambrig
