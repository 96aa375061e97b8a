// Clocks: of the record, of the columns of one kind, and blocks of rows that are missing, some of
// them beside an effect.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/record/channels.h"
#include "discovery/model/record_traits.h"
#include "discovery/practice/spoil.h"
#include "effects/catalogue.h"
#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

using testing::FaultsOf;
using testing::kStepRecord;
using testing::Measured;
using testing::RecordNamed;
using testing::SamplesOf;

constexpr const char* kMultisine = "multisine at 60 Hz";

std::vector<std::string> ReadingsOf(const CaseRecord& r) {
  std::vector<std::string> out;
  for (const Channel& c : r.data.channels)
    if (IsOfKind(c.name, ChannelKind::kReading)) out.push_back(c.name);
  return out;
}

// Positions of an instrument of its own come late together; the currents beside them are on time.
TEST(GateClocks, TheColumnsOfOneInstrument) {
  Case c = Measured({}, 0, kMultisine);
  const std::size_t record = RecordNamed(c, kMultisine);
  const std::vector<std::string> readings = ReadingsOf(c.records[record]);
  ASSERT_EQ(readings.size(), 4U);
  Spoil(c, record, {"instrument", "", 4e-3}, 1);
  const auto faults = FaultsOf(c);
  ASSERT_EQ(faults.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(faults[k].fault, "lag") << FaultText(faults[k]);
    EXPECT_EQ(faults[k].record, kMultisine);
    EXPECT_EQ(faults[k].channel, readings[k]);
    EXPECT_NEAR(faults[k].seconds, 4e-3, 2e-4);
    EXPECT_NE(faults[k].mend.find("late = 0.00"), std::string::npos) << faults[k].mend;
  }
}

/// Columns as if they came `rows` late: until then their first value is repeated.
void Delay(CaseRecord& r, std::ptrdiff_t rows, const std::function<bool(const ChannelId&)>& which) {
  for (Channel& c : r.data.channels)
    if (const auto id = ParseChannel(c.name); id && which(*id)) {
      std::copy_backward(c.samples.begin(), c.samples.end() - rows, c.samples.end());
      std::fill_n(c.samples.begin(), rows, c.samples[0]);
    }
}

// One column that its logger writes late, by less than is gross: nothing in a rig does that.
TEST(GateClocks, OneColumnThatIsLateAndNothingElse) {
  Case c = Measured({}, 0, kMultisine);
  CaseRecord& r = c.records[RecordNamed(c, kMultisine)];
  const auto rows = static_cast<std::ptrdiff_t>(std::lround(8e-4 * r.data.rate));
  Delay(r, rows, [](const ChannelId& id) { return id.name() == "A.x"; });
  const std::vector<DataFault> faults = FaultsOf(c);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].fault, "lag") << FaultText(faults[0]);
  EXPECT_EQ(faults[0].channel, "A.x");
  EXPECT_NEAR(faults[0].seconds, 8e-4, 1e-4);
}

// One converter module, one bearing's electronics, one amplifier of load cells: all of their
// columns are late, no other is.
TEST(GateClocks, TheColumnsOfOneConverter) {
  struct Group {
    const char* record;
    std::function<bool(const ChannelId&)> holds;
  };
  for (const Group& group : {Group{kMultisine,
                                   [](const ChannelId& id) {
                                     return id.plane == "B" && id.kind == ChannelKind::kCoilCurrent;
                                   }},
                             {kMultisine, [](const ChannelId& id) { return id.plane == "B"; }},
                             {testing::kClampedRecord, [](const ChannelId& id) {
                                return id.kind == ChannelKind::kLoadCell;
                              }}}) {
    Case c = Measured({}, 0, kMultisine);
    CaseRecord& r = c.records[RecordNamed(c, group.record)];
    Delay(r, 62, group.holds);
    std::size_t columns = 0;
    for (const Channel& channel : r.data.channels)
      columns += group.holds(*ParseChannel(channel.name)) && IsPredicted(r, channel.name) ? 1 : 0;
    const auto faults = FaultsOf(c);
    EXPECT_EQ(faults.size(), columns);
    for (const DataFault& f : faults) {
      EXPECT_EQ(f.fault, "lag") << FaultText(f);
      EXPECT_EQ(f.record, group.record);
      EXPECT_TRUE(group.holds(*ParseChannel(f.channel))) << f.channel;
      EXPECT_NEAR(f.seconds, 62 / 12500.0, 2e-4);
    }
  }
}

// Eddy currents delay both forces of a bearing by some ms against its currents.
TEST(GateClocks, ForcesThatAreLateTogetherAreTheIrons) {
  for (const std::ptrdiff_t rows : {23, 31}) {  // 1.8 and 2.5 ms
    Case c = Measured();
    CaseRecord& r = c.records[RecordNamed(c, testing::kClampedRecord)];
    Delay(r, rows,
          [](const ChannelId& id) { return id.plane == "B" && id.kind == ChannelKind::kLoadCell; });
    const auto faults = FaultsOf(c);
    for (const DataFault& f : faults) EXPECT_NE(f.fault, "lag") << FaultText(f);
  }
}

// A rig that answers late does so in all its columns: that is an effect.
TEST(GateClocks, ADelayInTheLoopIsNoClock) {
  EffectInstance e = MakeInstance(EffectNamed("loop-delay"), "rig");
  e.Set("time", 3e-4);
  EXPECT_TRUE(FaultsOf(Measured({e}, 0, kMultisine)).empty());
}

// A block of 0.5 ms is less than what a fit may find as a shift of all rows, but it is missing in
// the middle.
TEST(GateClocks, AShortBlockThatIsMissing) {
  Case c = Measured();
  const std::size_t record = RecordNamed(c, testing::kClampedRecord);
  const Record before = c.records[record].data;
  const double rows = std::max(12.0, std::round(5e-4 * before.rate));
  Spoil(c, record, {"lost", "", (rows + 0.5) / static_cast<double>(before.rows())}, 1);
  ASSERT_EQ(static_cast<double>(before.rows() - c.records[record].data.rows()), rows);
  const auto faults = FaultsOf(c);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].fault, "lost") << FaultText(faults[0]);
  EXPECT_NEAR(faults[0].seconds, rows / before.rate, 2 / before.rate);
}

/// A record whose positions and currents hold another movement, of this share of their own.
/// Set-points would follow it and are not logged.
Case BesideAnotherMovement(double share) {
  Case c = Measured({}, 0, kMultisine);
  CaseRecord& r = c.records[RecordNamed(c, kMultisine)];
  testing::DropChannels(
      r, [](const std::string& name) { return IsOfKind(name, ChannelKind::kSetPoint); });
  for (Channel& ch : r.data.channels) {
    if (!IsOfKind(ch.name, ChannelKind::kReading) && !IsOfKind(ch.name, ChannelKind::kCoilCurrent))
      continue;
    const auto [low, high] = std::minmax_element(ch.samples.begin(), ch.samples.end());
    const double size = share * (*high - *low);
    for (std::size_t k = 0; k < ch.samples.size(); ++k)
      ch.samples[k] += size * std::sin(2 * M_PI * 37 * static_cast<double>(k) / r.data.rate);
  }
  return c;
}

// What the model lacks leaves an error that no shift removes: a clock that is wrong by 12 ms is
// seen all the same.
TEST(GateClocks, ALateRecordBesideAnEffect) {
  for (const bool late : {false, true}) {
    Case c = BesideAnotherMovement(0.1);
    if (late) Spoil(c, RecordNamed(c, kMultisine), {"lag", "", 0.012}, 1);
    std::vector<DataFault> faults = FaultsOf(c);
    if (!late) {
      EXPECT_TRUE(faults.empty()) << FaultText(faults[0]);
      continue;
    }
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].fault, "lag") << FaultText(faults[0]);
    EXPECT_EQ(faults[0].channel, "");
    EXPECT_NEAR(faults[0].seconds, 0.012, 2e-4);
  }
}

// A rig of other parameters answers later or earlier than the model; the controller's program does
// not.
TEST(GateClocks, ALateRecordOfAnotherRigToTheRow) {
  Case c = Measured({testing::CrossCouplingAtA(2e5)}, 2.5, kMultisine);
  Spoil(c, RecordNamed(c, kMultisine), {"lag", "", 0.012}, 1);
  const std::vector<DataFault> faults = FaultsOf(c);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].fault, "lag") << FaultText(faults[0]);
  EXPECT_NEAR(faults[0].seconds, 0.012, 1e-6);
}

// Both axes of two bearings exchanged, beside what the model lacks.
TEST(GateClocks, PlanesExchangedBesideAnEffect) {
  Case c = BesideAnotherMovement(0.1);
  for (const char* axis : {"x", "y"})
    std::swap(SamplesOf(c, kMultisine, std::string("A.") + axis),
              SamplesOf(c, kMultisine, std::string("B.") + axis));
  const auto faults = FaultsOf(c);
  ASSERT_EQ(faults.size(), 2U);
  for (const DataFault& f : faults) {
    EXPECT_EQ(f.fault, "swap") << FaultText(f);
    EXPECT_EQ(f.channel.substr(2), f.with.substr(2));
    EXPECT_NE(f.channel.substr(0, 1), f.with.substr(0, 1));
  }
}

}  // namespace
}  // namespace ambrig
