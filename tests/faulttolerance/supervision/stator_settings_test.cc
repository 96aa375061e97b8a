// What a bearing with any stator does not have is refused, not ignored.
#include "faulttolerance/supervision/stator_settings.h"

#include <gmock/gmock.h>

#include "core/base/errors.h"
#include "rig/rig_file.h"

namespace ambrig {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

RigParameters SixPoleRig() {
  return ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/stators/six_poles.toml");
}

std::string Refusal(const RigParameters& rig, const std::string& redistribution) {
  try {
    CheckWhatStatorsAllow(rig, rig.bearings[0], redistribution);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(StatorSettings, AnotherDetectorIsRefusedWithTheOneThatIsThere) {
  RigParameters rig = SixPoleRig();
  EXPECT_EQ(Refusal(rig, "auto"), "");
  rig.detection.kind = "kalman";
  EXPECT_THAT(Refusal(rig, "auto"),
              AllOf(HasSubstr("\"kalman\" with bearing A"), HasSubstr("allowed: commissioned")));
}

TEST(StatorSettings, ForceByForceIsRefused) {
  EXPECT_THAT(Refusal(SixPoleRig(), "force-by-force"), HasSubstr("allowed: auto, matrix"));
}

TEST(StatorSettings, BearingsOfEightPolesHaveEveryDetector) {
  RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  rig.detection.kind = "kalman";
  EXPECT_EQ(Refusal(rig, "force-by-force"), "");
}

}  // namespace
}  // namespace ambrig
