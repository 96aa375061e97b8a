// A loop of shorted turns keeps its flux for milliseconds; the balance of the coil's voltage
// afterwards tells how many turns it has.
#include "fdd/examination/carried_turns.h"

#include <gtest/gtest.h>

#include "tests/fdd/commissioned_plant.h"

namespace ambrig {
namespace {

using namespace testing_plant;

/// Share of the turns of `coil` that is told last, from what the first diagnosis says on.
double CarriedAtLast(const CommissionedRig& plant, int coil, const std::string& parameters) {
  const auto seen = ConcludedShort(plant, coil, parameters, 0.08);
  EXPECT_EQ(seen->Coils(), std::set<int>{coil}) << parameters;
  if (seen->found.empty()) return -1;
  double share = 1 - seen->found[0].fraction;
  for (const auto& [other, carried] : seen->carried) {
    EXPECT_EQ(other + 1, coil) << parameters;
    share = carried;
  }
  return share;
}

TEST(CarriedTurns, ALargeLoopIsSizedByWhatItsFluxComesTo) {
  for (const CommissionedRig* plant : {&BaseModel(), &SlowIron(), &ThinSheets()})
    for (const double lost : {0.3, 0.4}) {
      const std::string loop = fmt::format("fraction = {}, short_resistance = 0.05", lost);
      EXPECT_NEAR(CarriedAtLast(*plant, 3, loop), 1 - lost, 0.08) << loop;
    }
}

TEST(CarriedTurns, AFewTurnsInALoopStayAFew) {
  EXPECT_GT(CarriedAtLast(BaseModel(), 3, "fraction = 0.03, short_resistance = 0.01"), 0.9);
  EXPECT_NEAR(CarriedAtLast(BaseModel(), 3, "fraction = 0.1, short_resistance = 0.02"), 0.9, 0.06);
}

TEST(CarriedTurns, BypassedTurnsKeepTheSizeThatTheirSlopesTell) {
  for (const CommissionedRig* plant : {&BaseModel(), &SlowIron(), &ThinSheets()})
    for (const double lost : {0.3, 0.5})
      EXPECT_NEAR(CarriedAtLast(*plant, 3, fmt::format("fraction = {}", lost)), 1 - lost, 0.08)
          << lost;
}

}  // namespace
}  // namespace ambrig
