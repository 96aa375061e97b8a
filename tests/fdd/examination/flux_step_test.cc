// Turns that are bypassed and turns that close through a resistance have the same slopes; the flux
// at the instant of the fault tells which.
#include "fdd/examination/flux_step.h"

#include <gtest/gtest.h>

#include "tests/fdd/commissioned_plant.h"

namespace ambrig {
namespace {

using namespace testing_plant;

Diagnosis Told(const CommissionedRig& plant, int coil, const std::string& parameters) {
  const auto seen = ConcludedShort(plant, coil, parameters, 0.032);
  EXPECT_EQ(seen->Coils(), std::set<int>{coil}) << parameters;
  return seen->found.empty() ? Diagnosis{} : seen->found[0];
}

TEST(FluxStep, AFewTurnsInALoopAreNotHalfOfTheWinding) {
  for (const CommissionedRig* plant : {&BaseModel()})
    for (const char* loop :
         {"fraction = 0.03, short_resistance = 0.01", "fraction = 0.1, short_resistance = 0.01"}) {
      const Diagnosis d = Told(*plant, 3, loop);
      EXPECT_EQ(d.cls, FaultClass::kPartialShort) << loop;
      EXPECT_GT(d.ripple_fraction, 0.3) << loop;
      EXPECT_LT(d.fraction, 0.1) << loop;
      EXPECT_GE(d.fraction, 0) << loop;
    }
}

TEST(FluxStep, BypassedTurnsAreToldByTheirSlopes) {
  for (const CommissionedRig* plant : {&BaseModel(), &SlowIron(), &ThinSheets()})
    for (const int coil : {1, 3, 5, 6})
      for (const double share : {0.3, 0.5}) {
        const Diagnosis d = Told(*plant, coil, fmt::format("fraction = {}", share));
        EXPECT_EQ(d.fraction, d.ripple_fraction) << coil << " " << share;
        EXPECT_NEAR(d.fraction, share, 0.06) << coil << " " << share;
      }
}

}  // namespace
}  // namespace ambrig
