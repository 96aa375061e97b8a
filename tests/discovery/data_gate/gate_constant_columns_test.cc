// Columns that hold nothing in a whole record are named as such, with the line that leaves out the
// column alone.
#include <gmock/gmock.h>

#include <algorithm>

#include "discovery/case/data_quality.h"
#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

using ::testing::EndsWith;
using testing::ExpectOnly;
using testing::FaultsOf;
using ::testing::HasSubstr;
using testing::kClampedRecord;
using testing::kStepRecord;
using testing::Measured;
using testing::RecordNamed;

/// The measured case with this value throughout in a column of a record, as a case file would read
/// it.
Case Holding(const std::string& channel, double value, const char* record = kStepRecord) {
  Case c = Measured();
  CaseRecord& r = c.records[RecordNamed(c, record)];
  const bool clamped = r.scenario.start == StartState::kClamped;
  for (std::size_t k = 0; k < r.data.channels.size(); ++k) {
    if (r.data.channels[k].name != channel) continue;
    std::ranges::fill(r.data.channels[k].samples, value);
    r.quality[k] = InspectChannel(r.data.channels[k], clamped || channel == "bus");
  }
  return c;
}

void ExpectUseless(const std::string& channel, double value, const std::string& text) {
  const auto faults = FaultsOf(Holding(channel, value));
  ExpectOnly(faults, value == 0 || std::isnan(value) ? "lost" : "freeze", channel);
  EXPECT_THAT(FaultText(faults[0]), HasSubstr(text));
  EXPECT_THAT(faults[0].mend, EndsWith("\"" + channel + "\" = { use = false }"));
}

TEST(GateConstantColumns, AColumnAtOneValueIsLeftOutAlone) {
  ExpectUseless("A.x", 0, "A.x holds 0 in the whole record");
  ExpectUseless("A.x", 5e-6, "A.x holds one value in the whole record");
  ExpectUseless("A.i1", 0, "A.i1 holds 0 in the whole record");
}

TEST(GateConstantColumns, AnEmptyColumnIsNamed) {
  ExpectUseless("A.x", std::nan(""), "A.x is empty in the whole record");
}

// A stiff bus may hold one value, but not 0 V.
TEST(GateConstantColumns, ABusOfZeroVoltsIsNamed) {
  ExpectUseless("bus", 0, "bus holds 0 in the whole record");
  EXPECT_TRUE(FaultsOf(Holding("bus", testing::RadialRig().amplifier.bus_voltage)).empty());
}

// A held shaft stands still, but its readings have the noise of the sensors. The true place may be
// told without noise.
TEST(GateConstantColumns, AReadingOfAHeldShaftThatStoodAtALimitIsNamed) {
  const auto faults = FaultsOf(Holding("A.y", 6e-5, kClampedRecord));
  ExpectOnly(faults, "freeze", "A.y");
  EXPECT_THAT(faults[0].mend, EndsWith("\"A.y\" = { use = false }"));

  const Case measured = Measured();
  const CaseRecord& clamped = measured.records[RecordNamed(measured, kClampedRecord)];
  const Channel* reading = clamped.data.Find("A.y");
  double mean = 0;
  for (const double v : reading->samples) mean += v / static_cast<double>(reading->samples.size());
  EXPECT_TRUE(FaultsOf(Holding("A.y", mean, kClampedRecord)).empty());
}

}  // namespace
}  // namespace ambrig
