// Frequency responses of rigs with an effect against sines in the switching engine.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "tests/discovery/model/response_cases.h"

namespace ambrig {
namespace {

using testing::AxisCase;
using testing::ExpectNearSines;
using testing::TemporaryFolder;
using testing::With;

class EffectInResponses : public ::testing::TestWithParam<std::tuple<EffectInstance, bool>> {};

// In the linear model, or through the simulated multisine, on a grid of its own.
TEST_P(EffectInResponses, FollowsSinesInTheSwitchingEngine) {
  const auto& [effect, linear] = GetParam();
  const TemporaryFolder folder;
  const Case c = AxisCase(folder, {23, 71, 180, 410, 900});
  RigParameters rig = c.rig;
  rig.effects = {effect};
  EXPECT_EQ(InLinearModel(c.rig, effect), linear);
  ExpectNearSines(rig, c);
}

INSTANTIATE_TEST_SUITE_P(
    Effects, EffectInResponses,
    ::testing::Values(std::tuple{With("eddy-currents", "A", "cutoff", 1500), true},
                      std::tuple{With("sensor-lowpass", "A", "cutoff", 1200), true},
                      std::tuple{With("sensor-gain", "A.x", "gain", 1.15), true},
                      std::tuple{With("sensor-rotation", "A", "angle", 0.15), true},
                      std::tuple{With("sensor-offset", "A.x", "offset", 4e-5), true},
                      std::tuple{With("current-sensor-gain", "A", "gain", 0.85), true},
                      std::tuple{With("current-sensor-offset", "A.coil1", "offset", 0.15), true},
                      std::tuple{With("iron-reluctance", "A", "path", 3e-5), true},
                      std::tuple{With("saturation", "A", "knee", 0.5), true},
                      std::tuple{With("dead-time", "A", "time", 1e-6), true},
                      std::tuple{With("amplifier-offset", "A", "offset", 2), true},
                      std::tuple{With("hysteresis", "A", "coercive", 0.05), false}),
    [](const auto& one) {
      std::string name = std::get<0>(one.param).name;
      std::ranges::replace(name, '-', '_');
      return name;
    });

}  // namespace
}  // namespace ambrig
