// A logger that starts one row late in one record: told as such, not fitted by effects.
#include <gmock/gmock.h>

#include "discovery/data/clock_shift.h"
#include "discovery/decision/explain.h"
#include "discovery/practice/examination.h"
#include "discovery/practice/measured_case.h"
#include "rig/bearing_kinds/bearing_kind.h"
#include "rig/rig_file.h"

namespace ambrig {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// Healthy records of the reference rig without its thrust bearing, as a logger writes them.
Case Records() {
  RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  std::erase_if(rig.bearings, [](const BearingParameters& b) { return b.kind->axial; });
  std::vector<ExaminationRecord> chosen;
  for (const ExaminationRecord& r : Examination(rig, 4))
    if (r.title == "steps of reference and load at rest" || r.title == "multisine at rest" ||
        r.title == "clamped, current ramps")
      chosen.push_back(r);
  Case c = EmptyCase(rig, chosen);
  const Case commanded = c;
  const CaseModel model(commanded);
  Hypothesis truth;
  truth.rig = rig;
  for (std::size_t r = 0; r < c.records.size(); ++r) MeasureRecord(model, truth, r, 31, 0.1, c);
  return c;
}

TEST(LateClock, OfOneRecordIsSetRight) {
  const Case c = WithClocks(Records(), {-1, 0, 0});  // every row shows what was one row before
  ExplainOptions options;
  options.candidates = 2;
  options.rounds = 1;
  const Explanation e = Explain(c, options);
  EXPECT_THAT(e.warnings, Contains(HasSubstr("is 1 row late")));
  EXPECT_TRUE(e.adopted.empty());
  EXPECT_NE(e.verdict, "unknown");
  EXPECT_LT(e.final_ratio_fit, 1.05);
}

}  // namespace
}  // namespace ambrig
