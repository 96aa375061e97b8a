// The records of the test: no choice depends on them, their errors are told at the end.
#include "discovery/explain/test_figures.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/discovery/examined_records.h"
#include "tests/discovery/measured_case.h"

namespace ambrig {
namespace {

/// Four places with an offset of A.x, a fifth one as a test in which it is another one.
Case WithTest(double offset_of_test) {
  Case c = MeasuredCase({{2e-5, 3e-5, 1, 3e-6},
                         {-6e-5, 1e-5, 1, 3e-6},
                         {5e-5, -4e-5, 1, 3e-6},
                         {-3e-5, -5e-5, 1, 3e-6},
                         {4e-5, 2e-5, 1, offset_of_test}});
  c.records[3].validate = true;
  c.records[4].test = true;
  return c;
}

TEST(TestFigures, TheyAreThoseOfRecordsThatNoChoiceHasSeen) {
  const Explanation same = Explain(WithTest(3e-6), ShortSearch()),
                    other = Explain(WithTest(-3e-6), ShortSearch());
  for (const Explanation* e : {&same, &other}) {
    ASSERT_EQ(e->adopted.size(), 1U);
    EXPECT_EQ(e->adopted[0].name, "sensor-offset");
  }
  EXPECT_EQ(same.adopted[0].values, other.adopted[0].values);
  EXPECT_EQ(same.final_ratio_validate, other.final_ratio_validate);
  EXPECT_EQ(same.closure.floors_before, other.closure.floors_before);
  EXPECT_GT(same.closure.test_before, 3);
  EXPECT_NEAR(same.closure.test_after, 1, 0.15);
  EXPECT_GT(other.closure.test_after, 1.5 * other.closure.test_before);
}

}  // namespace
}  // namespace ambrig
