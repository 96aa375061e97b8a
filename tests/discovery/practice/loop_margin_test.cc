// Which drawn machines are worth measuring.
#include "discovery/practice/loop_margin.h"

#include <gtest/gtest.h>

#include "core/base/errors.h"
#include "rig/rig_file.h"

namespace ambrig {
namespace {

RigParameters Example(const std::string& name) {
  return ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/" + name + "/rig.toml");
}

TEST(LoopMargin, TheExamplesHaveOne) {
  for (const char* name : {"reference", "small_spindle", "heavy_compressor"})
    EXPECT_NO_THROW(RequireLoopMargin(Example(name))) << name;
}

// A current loop that is slower than the rotor falls leaves no gain that holds it.
TEST(LoopMargin, ASlowAmplifierUnderAHeavyRotorIsRefused) {
  RigParameters rig = Example("heavy_compressor");
  rig.amplifier.kp *= 0.3;
  rig.amplifier.ki *= 0.3;
  EXPECT_THROW(RequireLoopMargin(rig), InputError);
}

// Stable, but not when the gain of the loops changes by a tenth: found by bisection of the
// derivative gain.
TEST(LoopMargin, TheEdgeOfStabilityIsRefused) {
  RigParameters rig = Example("small_spindle");
  const double kd = rig.controller.pid.kd;
  double refused = 0.01, accepted = 1;
  for (int k = 0; k < 12; ++k) {
    const double middle = 0.5 * (refused + accepted);
    rig.controller.pid.kd = middle * kd;
    try {
      RequireLoopMargin(rig);
      accepted = middle;
    } catch (const InputError&) {
      refused = middle;
    }
  }
  rig.controller.pid.kd = refused * kd;
  try {
    RequireLoopMargin(rig);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("all but unstable"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace ambrig
