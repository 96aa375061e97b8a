// Records with imposed motion: measured positions move the gaps, rotor and controller play no part.
// The data come from levitated runs under the controller, which is another path through the engine
// than the one that predicts them.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/record/channels.h"
#include "discovery/model/record_traits.h"
#include "tests/discovery/model/imposed_case.h"

namespace ambrig {
namespace {

class ImposedMotion : public ImposedCase {
 protected:
  /// All motion is imposed.
  void SetUp() override {
    data_ = hidden_->data;
    for (CaseRecord& r : data_.records) r.imposed = Imposed::kMotion;
  }
};

TEST_F(ImposedMotion, TheTrueCoilsLeaveNothingButNoise) {
  const double ratio = ErrorOverFloor(data_);
  EXPECT_GT(ratio, 0.9);
  EXPECT_LT(ratio, 1.05);
}

TEST_F(ImposedMotion, AWrongRotorPlaysNoPart) {
  ASSERT_TRUE(SetParameter(data_.rig, "rotor.mass", 1.5 * data_.rig.rotor.mass));
  EXPECT_LT(ErrorOverFloor(data_), 1.05);
}

TEST_F(ImposedMotion, AWrongCoilShows) {
  ASSERT_TRUE(SetParameter(data_.rig, "bearings.A.leakage_inductance", 1e-3));
  EXPECT_GT(ErrorOverFloor(data_), 1.3);
}

TEST_F(ImposedMotion, TheFirstRowsOfALoopWithAnUnknownPastAreLeftOut) {
  for (const CaseRecord& r : data_.records) {
    const bool clamped = r.scenario.start == StartState::kClamped;
    EXPECT_EQ(HasSettled(r, r.data.start), clamped);
    EXPECT_TRUE(HasSettled(r, r.data.start + 0.0041));
  }
  CaseRecord free = data_.records[0];
  free.imposed = Imposed::kNothing;
  EXPECT_TRUE(HasSettled(free, free.data.start));
}

TEST_F(ImposedMotion, CommandsOfAClampedScenarioAreNotReadFromRows) {
  for (CaseRecord& r : data_.records) {
    const auto set_points = [&] {
      const Record driving = DrivingRecord(data_.rig, r);
      return std::ranges::any_of(driving.channels, [](const Channel& c) {
        return IsOfKind(c.name, ChannelKind::kSetPoint);
      });
    };
    EXPECT_EQ(set_points(), r.scenario.start != StartState::kClamped);
    r.scenario.excitations.clear();  // somebody else's commands
    EXPECT_TRUE(set_points());
  }
}

}  // namespace
}  // namespace ambrig
