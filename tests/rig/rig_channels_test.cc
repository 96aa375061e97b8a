#include "rig/rig_channels.h"

#include <gmock/gmock.h>

#include "rig/parameters/bearing_kind.h"
#include "rig/rig_file.h"

namespace ambrig {
namespace {

using ::testing::ElementsAre;

RigParameters Example(const std::string& folder) {
  return ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/" + folder + "/rig.toml");
}

std::vector<std::string> Names(const std::vector<ChannelId>& channels) {
  std::vector<std::string> out;
  for (const ChannelId& id : channels) out.push_back(id.name());
  return out;
}

BearingParameters Bearing(const std::string& name, const char* kind) {
  BearingParameters b;
  b.name = name;
  b.kind = FindBearingKind(kind);
  return b;
}

TEST(RigChannels, OfTheThreeKindsOfBearings) {
  const BearingParameters a = Bearing("A", "radial"), z = Bearing("Z", "thrust"),
                          m = Bearing("M", "opposed");
  EXPECT_THAT(Names(ChannelsOf(a, ChannelKind::kReading)), ElementsAre("A.x", "A.y"));
  EXPECT_THAT(Names(ChannelsOf(z, ChannelKind::kReading)), ElementsAre("z"));
  EXPECT_THAT(Names(ChannelsOf(m, ChannelKind::kReading)), ElementsAre("M.x"));
  EXPECT_THAT(Names(ChannelsOf(a, ChannelKind::kLoadCell)), ElementsAre("A.fx", "A.fy"));
  EXPECT_THAT(Names(ChannelsOf(z, ChannelKind::kLoadCell)), ElementsAre("Z.fz"));
  EXPECT_THAT(Names(ChannelsOf(z, ChannelKind::kTruePosition)), ElementsAre("r.z"));
  EXPECT_THAT(Names(ChannelsOf(z, ChannelKind::kCoilCurrent)),
              ElementsAre("Z.i1", "Z.i2", "Z.i3", "Z.i4"));
  EXPECT_THAT(Names(ChannelsOf(m, ChannelKind::kDuty)), ElementsAre("M.d1", "M.d2"));
  EXPECT_EQ(ChannelsOf(a, ChannelKind::kSetPoint).size(), 8u);
  EXPECT_TRUE(ChannelsOf(a, ChannelKind::kBus).empty());
}

TEST(RigChannels, ReadingsAreTheAxesOfEveryExample) {
  for (const char* folder : {"reference", "heavy_compressor", "small_spindle", "mls2em"}) {
    const RigParameters rig = Example(folder);
    EXPECT_EQ(Names(ChannelsOf(rig, ChannelKind::kReading)), AxisNames(rig)) << folder;
  }
}

TEST(RigChannels, StationsOfABeamHaveTruePositions) {
  const RigParameters rig = Example("tum_mbtr");
  ASSERT_FALSE(rig.stations.empty());
  const auto names = Names(ChannelsOf(rig, ChannelKind::kTruePosition));
  EXPECT_EQ(names.size(), 2 * (rig.bearings.size() + rig.stations.size()));
  for (const ShaftPlane& s : rig.stations) {
    EXPECT_THAT(names, ::testing::Contains(s.name + ".r.x"));
    EXPECT_THAT(names, ::testing::Contains(s.name + ".r.y"));
  }
  EXPECT_EQ(ChannelsOf(rig, ChannelKind::kReading).size(), AxisNames(rig).size());
}

TEST(RigChannels, OneForTheRig) {
  const RigParameters rig = Example("reference");
  EXPECT_THAT(Names(ChannelsOf(rig, ChannelKind::kSpeed)), ElementsAre("omega"));
  EXPECT_THAT(Names(ChannelsOf(rig, ChannelKind::kBus)), ElementsAre("bus"));
}

}  // namespace
}  // namespace ambrig
