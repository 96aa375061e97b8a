// What a run whose detector doubted its model tells the person who reads it.
#include <gmock/gmock.h>

#include "app/pages/run_report_data.h"
#include "tests/actuators/magnetics/reference_lanes.h"

namespace ambrig {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

RunResult Doubted(double a, double b) {
  RunResult result;
  result.doubtful = a > 0 || b > 0;
  result.doubtful_share = {{"A", a}, {"B", b}, {"Z", 0}};
  return result;
}

TEST(DoubtfulModelNote, OfACommissionedRigSaysHowLongAndWhere) {
  RigParameters rig = ReferenceLanesRig();
  rig.detection.commissioning = "rig.commissioning.json";
  EXPECT_THAT(DoubtfulModelNote(rig, Doubted(0, 0)), IsEmpty());
  EXPECT_THAT(DoubtfulModelNote(rig, Doubted(0.03, 0.1396)), HasSubstr("A 3 %, B 14 %"));
  EXPECT_THAT(DoubtfulModelNote(rig, Doubted(0.005, 0.5)), Not(HasSubstr("A ")));
  EXPECT_THAT(DoubtfulModelNote(rig, Doubted(0.005, 0)), IsEmpty());
}

TEST(DoubtfulModelNote, OfARigThatIsNotCommissionedSaysHowToTeachIt) {
  RigParameters rig = ReferenceLanesRig();
  rig.file = "/nowhere/rig.toml";
  EXPECT_THAT(DoubtfulModelNote(rig, Doubted(1, 1)),
              HasSubstr("ambrig commission /nowhere/rig.toml"));
}

}  // namespace
}  // namespace ambrig
