/// What a supervisor may ask of the controller.
#include "control/current/control_action.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace ambrig {
namespace {

std::vector<BearingControl> TwoBearings() {
  std::vector<BearingControl> control(2);
  for (BearingControl& c : control) c.coils = 4;
  return control;
}

TEST(ControlAction, EachChangesWhatItNamesAndNothingElse) {
  std::vector<BearingControl> control = TwoBearings();
  Apply(DisableCoil{1, 2}, control);
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t j = 0; j < kLanes; ++j)
      EXPECT_EQ(control[k].disabled[j], k == 1 && j == 2) << k << j;
  Apply(SetIntegral{0, 3, -1.5}, control);
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t j = 0; j < kLanes; ++j)
      EXPECT_EQ(control[k].regulator[j].integral(), k == 0 && j == 3 ? -1.5 : 0) << k << j;
  ReplaceMap change;
  change.bearing = 0;
  change.map.c0 = 2.5;
  change.map.W(1, 1) = 0.7;
  Apply(change, control);
  EXPECT_EQ(control[0].map.c0, 2.5);
  EXPECT_EQ(control[0].map.W(1, 1), 0.7);
  EXPECT_EQ(control[1].map.c0, 0);
  EXPECT_TRUE(control[1].disabled[2]);
}

TEST(ControlAction, AProbeEndsOffAndAnEnabledCoilFollowsItsMap) {
  std::vector<BearingControl> control = TwoBearings();
  Apply(DisableCoil{1, 2}, control);
  Apply(ProbeCoil{1, 2, 0.8}, control);
  EXPECT_FALSE(control[1].disabled[2]);
  EXPECT_EQ(control[1].probe[2], 0.8);
  EXPECT_EQ(control[1].probe[1], 0);
  Apply(ProbeCoil{1, 2, 0}, control);
  EXPECT_TRUE(control[1].disabled[2]);
  EXPECT_EQ(control[1].probe[2], 0);
  Apply(ProbeCoil{1, 2, 0.8}, control);
  Apply(EnableCoil{1, 2}, control);
  EXPECT_FALSE(control[1].disabled[2]);
  EXPECT_EQ(control[1].probe[2], 0);
}

TEST(ControlAction, ACoilOrBearingThatIsNotThereIsTheCallersMistake) {
  std::vector<BearingControl> control = TwoBearings();
  EXPECT_THROW(Apply(DisableCoil{2, 0}, control), std::logic_error);
  EXPECT_THROW(Apply(DisableCoil{0, 4}, control), std::logic_error);
  EXPECT_THROW(Apply(SetIntegral{0, -1, 0}, control), std::logic_error);
  EXPECT_THROW(Apply(EnableCoil{0, 4}, control), std::logic_error);
  EXPECT_THROW(Apply(ProbeCoil{0, 4, 1}, control), std::logic_error);
}

}  // namespace
}  // namespace ambrig
