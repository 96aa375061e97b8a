// Which numbers of the drawing a fit moved, in their sd.
#include "discovery/decision/parameter_shifts.h"

#include <gmock/gmock.h>

namespace ambrig {
namespace {

FreeParameter Moved(const std::string& path, double sds, int effect = -1) {
  FreeParameter p;
  p.path = path;
  p.start = 2;
  p.sd = p.step = 0.1;
  p.value = p.start + sds * p.sd;
  p.effect = effect;
  return p;
}

TEST(ParameterShifts, AreToldFromTheLeastOnAndOfTheRigAlone) {
  Hypothesis h;
  h.free = {Moved("bearings.A.gap", 2.995), Moved("rotor.mass", -1.5), Moved("cutoff", 9, 0)};
  EXPECT_THAT(ParameterShifts(h, 2), ::testing::ElementsAre("bearings.A.gap +3.00 sd"));
  EXPECT_THAT(ParameterShifts(h, 1),
              ::testing::ElementsAre("bearings.A.gap +3.00 sd", "rotor.mass -1.50 sd"));
}

}  // namespace
}  // namespace ambrig
