// Which channels of a record the model predicts, from when on, and whether its rotor touches
// something.
#include "discovery/model/record_traits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rig/rig_file.h"

namespace ambrig {
namespace {

CaseRecord TimeRecord(StartState start) {
  CaseRecord r;
  r.scenario.start = start;
  r.scenario.duration = 0.2;
  r.scenario.speed_free_from = 1;  // never
  return r;
}

// The clamp prescribes set-points, the scenario the speed and the angle; the rest is predicted.
TEST(RecordTraits, WhatIsPrescribedIsNotPredicted) {
  CaseRecord free = TimeRecord(StartState::kLevitated), held = TimeRecord(StartState::kClamped);
  for (const char* channel : {"A.x", "A.i3", "A.d3", "bus"}) {
    EXPECT_TRUE(IsPredicted(free, channel)) << channel;
    EXPECT_TRUE(IsPredicted(held, channel)) << channel;
  }
  EXPECT_TRUE(IsPredicted(free, "A.s3"));
  EXPECT_FALSE(IsPredicted(held, "A.s3"));
  for (const char* channel : {"omega", "theta", "room temperature"})
    EXPECT_FALSE(IsPredicted(free, channel)) << channel;
  free.scenario.speed_free_from = 0.1;
  EXPECT_TRUE(IsPredicted(free, "omega"));
  EXPECT_FALSE(IsPredicted(free, "theta"));
}

// Measured positions that move the shaft are given, and so are the set-points measured beside them;
// the loops need their time to forget what went before.
TEST(RecordTraits, WhatDrivesIsNotPredicted) {
  CaseRecord r = TimeRecord(StartState::kLevitated);
  r.data.start = 0.1;
  EXPECT_TRUE(HasSettled(r, 0.1));
  r.imposed = Imposed::kMotion;
  EXPECT_FALSE(IsPredicted(r, "A.x"));
  EXPECT_FALSE(IsPredicted(r, "A.s3"));
  EXPECT_TRUE(IsPredicted(r, "A.i3"));
  EXPECT_FALSE(HasSettled(r, 0.1 + 0.9 * kLoopsSettle));
  EXPECT_TRUE(HasSettled(r, 0.1 + 1.1 * kLoopsSettle));
  r.scenario.start = StartState::kClamped;
  EXPECT_TRUE(HasSettled(r, 0.1));
}

// At its stop, or nearly; farther out it is a wrong unit.
TEST(RecordTraits, AReadingAtTheClearanceTouches) {
  const RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/reference/rig.toml");
  const double clearance = rig.Find("A")->auxiliary->clearance;
  for (const auto& [x, touches] : {std::pair{0.8, false}, {0.9, true}, {4.0, true}, {6.0, false}}) {
    CaseRecord r = TimeRecord(StartState::kLevitated);
    const double each = x * clearance / std::sqrt(2.0);
    r.data.channels = {{"A.x", "m", {0, each, 0}}, {"A.y", "m", {0, -each, 0}}};
    EXPECT_EQ(Touches(rig, r), touches) << x;
  }
}

}  // namespace
}  // namespace ambrig
