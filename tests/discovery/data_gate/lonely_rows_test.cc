// Single wrong samples of any channel are found and left out; nothing else is.
#include "discovery/data_gate/lonely_rows.h"

#include <gmock/gmock.h>

#include "effects/catalogue.h"
#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

using testing::FaultsOf;
using testing::kClampedRecord;
using testing::kStepRecord;
using testing::Measured;
using testing::SamplesOf;

/// What is found in a case, with the model that it was found with.
struct Found {
  explicit Found(const Case& c) : model(c) {
    model.noise_model = EstimateNoise(model, Hypothesis::Base(c.rig));
    const NoiseFloor floor = FindFloor(model, Hypothesis::Base(c.rig));
    rows = LonelyRowsOf(model, floor.clean);
  }
  CaseModel model;
  std::vector<LonelyRow> rows;
};

TEST(LonelyRows, NothingIsFoundInSoundRecords) {
  EXPECT_TRUE(Found(Measured({}, 0, "multisine at 60 Hz")).rows.empty());
  EffectInstance e = MakeInstance(EffectNamed("iron-reluctance"), "A");
  e.Set("path", 6e-5);
  EXPECT_TRUE(Found(Measured({e})).rows.empty());
}

// Each is possible, and too small or in a channel that no limit bounds: no fault of the data that
// stops a search.
TEST(LonelyRows, OneSampleOfAnyChannelIsLeftOutAndTold) {
  struct Glitch {
    const char *record, *channel;
    double size;
  };
  for (const Glitch& g : {Glitch{kStepRecord, "bus", 10.0},
                          {kClampedRecord, "A.fx", 300.0},
                          {kStepRecord, "A.x", 1.2e-4},
                          {kStepRecord, "B.i3", -2.5}}) {
    Case c = Measured();
    SamplesOf(c, g.record, g.channel)[1777] += g.size;
    EXPECT_TRUE(FaultsOf(c).empty()) << g.channel;
    Found found(c);
    ASSERT_EQ(found.rows.size(), 1U) << g.channel;
    EXPECT_EQ(found.rows[0].sample, 1777U);
    EXPECT_THAT(LonelyRemarks(c, found.rows), ::testing::ElementsAre(::testing::AllOf(
                                                  ::testing::HasSubstr(g.channel),
                                                  ::testing::HasSubstr("1 sample stands alone"))));
    found.model.LeaveOut(SpansOf(found.rows));
    for (const Target& t : found.model.targets()) {
      if (t.record != found.rows[0].record) continue;
      for (std::size_t k = t.first; k < t.first + t.count; ++k)
        EXPECT_TRUE(found.model.sample(k) != 1777 || !found.model.ok()[k]);
    }
  }
}

// What comes and goes in several columns at once is the machine's.
TEST(LonelyRows, AnEventInSeveralColumnsIsNoGlitch) {
  Case c = Measured();
  for (const char* channel : {"A.x", "A.y", "B.x"})
    SamplesOf(c, kStepRecord, channel)[1777] += 1.2e-4;
  EXPECT_TRUE(Found(c).rows.empty());
}

}  // namespace
}  // namespace ambrig
