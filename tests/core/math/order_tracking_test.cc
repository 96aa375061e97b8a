#include "core/math/order_tracking.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"

namespace ambrig {
namespace {

/// Forward order 1 of 3 um at 40 degrees, backward order 1 of 1 um, a standing 25 Hz motion of
/// 2 um in x, an offset; the speed rises from 20 to 60 Hz in 4 s.
struct Signal {
  std::vector<double> x, y, theta;
  double rate = 2000;
  Signal() {
    for (int k = 0; k < 8000; ++k) {
      const double t = k / rate, angle = 2 * kPi * (20 * t + 5 * t * t);
      theta.push_back(angle);
      const std::complex<double> z =
          std::polar(3e-6, angle + 40 * kPi / 180) + std::polar(1e-6, -angle);
      x.push_back(z.real() + 2e-6 * std::cos(2 * kPi * 25 * t) + 5e-5);
      y.push_back(z.imag() - 3e-5);
    }
  }
  Orbit orbit() const { return {x, y, rate, 0}; }
};

TEST(OrderTracking, FindsForwardAndBackwardParts) {
  const Signal s;
  const TrackedOrder track = TrackOrder(s.orbit(), s.theta, 1, 0.4, 0.1);
  ASSERT_GT(track.t.size(), 30u);
  int compared = 0;
  for (std::size_t k = 0; k < track.t.size(); ++k) {
    if (20 + 10 * track.t[k] < 35) continue;  // the 25 Hz motion lies in the window's band before
    // Hann over 0.4 s, 10 Hz and more away: side lobes below 0.1 % of 2 um.
    EXPECT_NEAR(std::abs(track.forward[k]), 3e-6, 1e-8);
    EXPECT_NEAR(std::arg(track.forward[k]), 40 * kPi / 180, 3e-3);
    EXPECT_NEAR(std::abs(track.backward[k]), 1e-6, 1e-8);
    ++compared;
  }
  EXPECT_GT(compared, 15);
}

TEST(OrderTracking, TooFewTurnsAreNoNumber) {
  const Signal s;
  const TrackedOrder track = TrackOrder(s.orbit(), s.theta, 1, 0.1, 0.1);  // two turns at 20 Hz
  EXPECT_TRUE(std::isnan(track.forward.front().real()));
  EXPECT_FALSE(std::isnan(track.forward.back().real()));
}

TEST(OrderTracking, WaterfallShowsCircularAmplitudesOnTheirSide) {
  const Signal s;
  const WaterfallSpectrum w = Waterfall(s.orbit(), 0.4, 0.5, 100, 401);
  ASSERT_EQ(w.amplitude.size(), w.t.size());
  const double df = w.frequency[1] - w.frequency[0];
  const auto& row = w.amplitude.back();
  const double speed = 20 + 10 * w.t.back();  // [Hz]
  ASSERT_GT(speed, 50);
  // largest within 2.5 lines: the speed sweeps 4 Hz in the window
  const auto near = [&](double f) {
    double top = 0;
    for (std::size_t k = 0; k < row.size(); ++k)
      if (std::abs(w.frequency[k] - f) < 2.5 * df) top = std::max(top, row[k]);
    return top;
  };
  // The standing motion is half forward, half backward; the sweep widens order 1 a little.
  EXPECT_NEAR(near(25), 1e-6, 1e-8);
  EXPECT_NEAR(near(-25), 1e-6, 1e-8);
  EXPECT_NEAR(near(speed), 3e-6, 0.6e-6);
  EXPECT_NEAR(near(-speed), 1e-6, 0.2e-6);
  EXPECT_LT(near(80), 1e-8);
  EXPECT_LT(near(0.1), 1e-8);  // the offset is out
  EXPECT_LE(w.frequency.size(), 401u);
}

}  // namespace
}  // namespace ambrig
