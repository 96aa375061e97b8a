// Contacts from motions that are written down: touchdown, hops, lift-off, drop, clearance left.
#include "simulation/verdict/contact_watch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/actuators/magnetics/reference_lanes.h"

namespace ambrig {
namespace {

constexpr double kLookPeriod = 1e-3;  // [s] between looks

class ContactWatchTest : public ::testing::Test {
 protected:
  ContactWatchTest() { scenario_.drop_limit = 0.1; }

  /// The rotor's centre at height y(t) [m] for every look up to `until`; no tilt.
  template <class Height>
  void Run(double until, const Height& y) {
    ContactWatch watch(plant_.rotor, scenario_, kLookPeriod);
    MotionState s;
    for (int k = 1; k * kLookPeriod <= until + 1e-12; ++k) {
      s.t = k * kLookPeriod;
      s.q[1] = y(s.t);
      watch.Period(s, k == 1, result_);
    }
    watch.Finish(s, result_);
  }
  std::vector<double> TimesOf(const std::string& kind, const std::string& target) const {
    std::vector<double> out;
    for (const RunEvent& e : result_.events)
      if (e.kind == kind && e.target == target) out.push_back(e.t);
    return out;
  }

  Plant plant_ = BuildPlant(TrueRig(ReferenceLanesRig()));  // clearance 0.2 mm at A and B
  Scenario scenario_;
  RunResult result_;
};

TEST_F(ContactWatchTest, AFreeRotorTouchesNothing) {
  Run(0.2, [](double t) { return t < 0.1 ? 1e-4 : -5e-5; });
  EXPECT_FALSE(result_.touchdown || result_.drop);
  EXPECT_TRUE(result_.events.empty());
  EXPECT_NEAR(result_.metrics.min_clearance_left, 1e-4, 1e-12);
  EXPECT_EQ(result_.metrics.longest_contact, 0);
}

TEST_F(ContactWatchTest, AShortContactIsATouchdownAndALiftOffInBothBearings) {
  Run(0.3, [](double t) { return t >= 0.0995 && t < 0.1295 ? -2.1e-4 : 0; });
  EXPECT_TRUE(result_.touchdown);
  EXPECT_FALSE(result_.drop);
  for (const char* bearing : {"A", "B"}) {
    ASSERT_EQ(TimesOf("touchdown", bearing).size(), 1u);
    EXPECT_NEAR(TimesOf("touchdown", bearing)[0], 0.1, 1e-9);
    ASSERT_EQ(TimesOf("lift_off", bearing).size(), 1u);
    EXPECT_NEAR(TimesOf("lift_off", bearing)[0], 0.13, 1e-9);
  }
  EXPECT_NEAR(result_.metrics.longest_contact, 0.03, 1e-9);
  EXPECT_NEAR(result_.metrics.min_clearance_left, -1e-5, 1e-12);
}

TEST_F(ContactWatchTest, AContactLongerThanTheLimitIsADrop) {
  Run(0.3, [](double t) { return t > 0.05 && t < 0.2 ? -2.1e-4 : 0; });
  EXPECT_TRUE(result_.drop);
  ASSERT_EQ(TimesOf("drop", "A").size(), 1u);
  EXPECT_NEAR(TimesOf("drop", "A")[0], 0.051 + 0.101, 2e-3);
  EXPECT_TRUE(TimesOf("drop", "B").empty());  // told once
}

// Hops shorter than a fall through the clearance are one contact; a longer flight ends it.
TEST_F(ContactWatchTest, HopsAreOneContactUntilTheRotorIsFreeForLonger) {
  const auto hopping = [](double flight) {
    return [flight](double t) {
      return t > 0.05 && std::fmod(t, flight + 0.01) < 0.01 ? -2.1e-4 : 0.0;
    };
  };
  Run(0.3, hopping(0.012));
  EXPECT_TRUE(result_.drop);
  EXPECT_GT(TimesOf("touchdown", "A").size(), 4u);
  EXPECT_LT(result_.metrics.longest_contact, 0.02);  // of one hop
  result_ = {};
  Run(0.3, hopping(0.03));
  EXPECT_FALSE(result_.drop);
}

TEST_F(ContactWatchTest, InContactAtTheEndIsADrop) {
  Run(0.2, [](double t) { return t > 0.15 ? -2.1e-4 : 0; });
  EXPECT_TRUE(result_.drop);
  EXPECT_EQ(TimesOf("drop", "rotor").size(), 1u);
  EXPECT_NEAR(result_.metrics.longest_contact, 0.05, 2e-3);
}

// A resting start is no touchdown; lifting off and coming back is one.
TEST_F(ContactWatchTest, ARestingStartIsNoTouchdown) {
  scenario_.start = StartState::kResting;
  Run(0.2, [](double t) { return t < 0.03 ? -2.1e-4 : 0; });
  EXPECT_FALSE(result_.touchdown);
  EXPECT_EQ(TimesOf("lift_off", "A").size(), 1u);
  result_ = {};
  Run(0.2, [](double t) { return t < 0.03 || (t > 0.1 && t < 0.11) ? -2.1e-4 : 0; });
  EXPECT_TRUE(result_.touchdown);
}

}  // namespace
}  // namespace ambrig
