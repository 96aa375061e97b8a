#include "core/record/channels.h"

#include <gmock/gmock.h>

#include <set>

#include "core/record/units.h"

namespace ambrig {
namespace {

struct Named {
  const char* name;
  ChannelId id;
};

// The names that docs/guide/channel_names.md gives to the channels of a record.
const Named kNamed[] = {
    {"A.x", {ChannelKind::kReading, "A", 0}},
    {"motor.y", {ChannelKind::kReading, "motor", 1}},
    {"z", {ChannelKind::kReading, "", 2}},
    {"A.r.x", {ChannelKind::kTruePosition, "A", 0}},
    {"disk-2.r.y", {ChannelKind::kTruePosition, "disk-2", 1}},
    {"r.z", {ChannelKind::kTruePosition, "", 2}},
    {"A.fx", {ChannelKind::kLoadCell, "A", 0}},
    {"Z.fz", {ChannelKind::kLoadCell, "Z", 2}},
    {"A.i1", {ChannelKind::kCoilCurrent, "A", 0}},
    {"B.s8", {ChannelKind::kSetPoint, "B", 7}},
    {"A.d12", {ChannelKind::kDuty, "A", 11}},
    {"omega", {ChannelKind::kSpeed}},
    {"theta", {ChannelKind::kAngle}},
    {"bus", {ChannelKind::kBus}},
};

TEST(Channels, NamesBothWays) {
  for (const Named& n : kNamed) {
    EXPECT_EQ(n.id.name(), n.name);
    const auto id = ParseChannel(n.name);
    ASSERT_TRUE(id) << n.name;
    EXPECT_EQ(*id, n.id) << n.name;
  }
}

TEST(Channels, EveryRowReadsBackItsOwnNames) {
  for (const ChannelRow& row : kChannels) {
    const int last = row.scope == ChannelScope::kRig    ? 0
                     : row.scope == ChannelScope::kCoil ? 31
                                                        : 1;
    const std::string plane = row.scope == ChannelScope::kRig ? "" : "A";
    for (int index = 0; index <= last; ++index) {
      const ChannelId id{row.kind, plane, index};
      EXPECT_EQ(ParseChannel(id.name()), id) << id.name();
    }
    if (row.scope != ChannelScope::kDirection) continue;
    const ChannelId along{row.kind, row.axial.empty() ? "Z" : "", 2};
    EXPECT_EQ(ParseChannel(along.name()), along) << along.name();
  }
}

TEST(Channels, OfABearingThatIsCalledAsAMark) {
  EXPECT_EQ(ParseChannel("r.x"), (ChannelId{ChannelKind::kReading, "r", 0}));
  EXPECT_EQ(ParseChannel("r.r.x"), (ChannelId{ChannelKind::kTruePosition, "r", 0}));
  EXPECT_EQ(ParseChannel("i1.i2"), (ChannelId{ChannelKind::kCoilCurrent, "i1", 1}));
}

TEST(Channels, OtherNamesAreNone) {
  for (const char* name : {"",        "t",     "x",
                           "i1",      ".x",    ".i1",
                           "A.",      "A.i",   "A.i0",
                           "A.i01",   "A.i1b", "A.i-1",
                           "A.speed", "A.z",   "A.temperature",
                           "A.f",     "A.fxx", "Bus",
                           "omega2",  "A.x.1", "A.i99999999999"})
    EXPECT_FALSE(ParseChannel(name)) << name;
}

TEST(Channels, OneRowForAKindAndAKnownUnit) {
  std::set<ChannelKind> kinds;
  std::set<std::string_view> words;
  for (const ChannelRow& row : kChannels) {
    EXPECT_TRUE(kinds.insert(row.kind).second) << row.words;
    EXPECT_TRUE(words.insert(row.words).second) << row.words;
    EXPECT_EQ(&RowOf(row.kind), &row);
    EXPECT_EQ(SiUnit(row.unit), row.unit);
    EXPECT_TRUE(row.resolution.least > 0 || row.resolution.part > 0) << row.words;
  }
}

TEST(Channels, FoundInARecord) {
  const Record record{.rate = 1, .channels = {{"A.x", "m", {1}}, {"A.i2", "A", {2}}}};
  EXPECT_EQ(Find(record, {ChannelKind::kCoilCurrent, "A", 1}), &record.channels[1]);
  EXPECT_EQ(Find(record, {ChannelKind::kCoilCurrent, "A", 0}), nullptr);
  EXPECT_EQ(ChannelWords("A.i2"), "current");
  EXPECT_EQ(ChannelWords("A.fx"), "load cell");
  EXPECT_EQ(ChannelWords("oil"), "unknown");
}

}  // namespace
}  // namespace ambrig
