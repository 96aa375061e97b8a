// What detectors are told of the shaft's motion near its auxiliary bearings.
#include "fdd/detectors/detection_feed.h"

#include <gtest/gtest.h>

#include "rig/parameters/bearing_kind.h"
#include "rig/rig_file.h"

namespace ambrig {
namespace {

/// Readings of a shaft that moves parallel to itself, one per controller period.
class FeedBench {
 public:
  /// What is not known of bearing A's position behind a reading x of all radial planes [m].
  double At(double x) {
    readings_.clear();
    m_.bearings.resize(rig_->bearings.size());
    for (std::size_t k = 0; k < rig_->bearings.size(); ++k) {
      m_.bearings[k].bus = rig_->amplifier.bus_voltage;
      readings_.push_back(rig_->bearings[k].kind->two_axes ? x : 0);
      if (rig_->bearings[k].kind->two_axes) readings_.push_back(0);
    }
    m_.readings = &readings_;
    m_.t = m_.reading_time = count_++ / rig_->controller.rate;
    feed_.Read(m_);
    return feed_.Period(0, m_).uncertainty.position;
  }
  /// Period n after a reading of a shaft that turns with `speed` [rad/s] and stood at `angle` then.
  MeasuredPeriod After(int n, double angle, double speed) {
    m_.angle = angle;
    m_.speed = speed;
    At(0);
    m_.t += n / rig_->amplifier.switching_frequency;
    feed_.Read(m_);
    return feed_.Period(0, m_);
  }
  double period() const { return 1 / rig_->amplifier.switching_frequency; }
  double clearance() const { return rig_->bearings[0].auxiliary->clearance; }

 private:
  const NominalRig rig_{ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/reference/rig.toml")};
  DetectionFeed feed_{rig_};
  PeriodMeasurement m_;
  std::vector<double> readings_;
  int count_ = 0;
};

// Towards the stop by 5 % of the clearance per reading: as long as the next step ends within 95 %
// of it the path is known; then it may be thrown back, by twice a step and more, until three
// readings have followed a parabola.
TEST(DetectionFeed, NearTheStopTheShaftMayBeThrownBack) {
  FeedBench feed;
  const double c = feed.clearance(), step = 0.05 * c;
  for (double x = 0.2 * c; x < 0.895 * c; x += step) {
    const double unknown = feed.At(x);
    if (x > 0.6 * c) {  // the first readings follow no parabola yet
      EXPECT_LT(unknown, 0.01 * step) << x / c;
    }
  }
  EXPECT_GT(feed.At(0.9 * c + 1e-9), 2 * step);
  EXPECT_LT(feed.At(0.95 * c), 5 * step);
  double x = 0.9 * c;
  feed.At(x);
  for (int n = 0; n < 8; ++n) feed.At(x -= step);
  EXPECT_LT(feed.At(x - step), 0.01 * step);
}

TEST(DetectionFeed, TheShaftTurnsOnBetweenReadings) {
  FeedBench feed;
  const MeasuredPeriod in = feed.After(1, 3, 500);
  EXPECT_DOUBLE_EQ(in.angle0, 3 + 500 * feed.period());
  EXPECT_DOUBLE_EQ(in.angle1, 3 + 1000 * feed.period());
}

}  // namespace
}  // namespace ambrig
