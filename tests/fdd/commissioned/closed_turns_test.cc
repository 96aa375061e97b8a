// What is concluded beside a coil whose shorted turns close through a resistance: what such a loop
// carries is in no circuit, and its neighbours are not blamed for it.
#include <gtest/gtest.h>

#include "tests/fdd/commissioned_plant.h"

namespace ambrig {
namespace {

using namespace testing_plant;

const char* const kLoop = "fraction = 0.2, short_resistance = 0.02";
constexpr double kLater = 0.0450123;  // [s]

std::unique_ptr<ConclusionLog> SeenBesideLoop(const std::string& faults, double duration = 0.07) {
  return Concluded(BaseModel().rig, &BaseModel().bearing, Operation(faults, duration));
}

std::string StepOfReading(double t = kLater) {
  return FaultOf(6, "current-sensor", "offset = 0.8", t);
}

std::string LowReading(double t = kLater) { return FaultOf(6, "current-sensor", "gain = 0.4", t); }

// The regulator of a coil with a loop makes steps of its own; a reading that steps is told only
// where no loop may have made it.
TEST(ClosedTurns, AReadingThatStepsBesideALoopIsDoubtedAndNotBlamed) {
  const auto alone = SeenBesideLoop(StepOfReading());
  ASSERT_FALSE(alone->found.empty());
  EXPECT_EQ(alone->found[0].coil, 5);
  EXPECT_EQ(alone->found[0].cls, FaultClass::kCurrentSensor);
  const auto beside = SeenBesideLoop(FaultOf(3, "partial-short", kLoop) + StepOfReading());
  EXPECT_EQ(beside->Coils(), std::set<int>{3});
  EXPECT_TRUE(beside->doubted);
}

// The loop goes on in the flux of its pole when its coil has no current any more: false readings of
// its neighbours are told only where the coil had none.
TEST(ClosedTurns, TheLoopOfACoilThatIsLostIsStillThere) {
  const std::string open = FaultOf(3, "open", "", 0.0380123);
  EXPECT_EQ(SeenBesideLoop(open + LowReading())->Coils(), (std::set<int>{3, 6}));
  const auto looped = SeenBesideLoop(FaultOf(3, "partial-short", kLoop) + open + LowReading());
  EXPECT_EQ(looped->Coils(), std::set<int>{3});
  EXPECT_TRUE(looped->doubted);
  ASSERT_GE(looped->found.size(), 2U);
  EXPECT_EQ(looped->found[1].cls, FaultClass::kOpen);
}

// What needs no circuit is told as ever.
TEST(ClosedTurns, CoilsWithoutCurrentAndSuddenLossesAreToldBesideALoop) {
  for (const auto& [kind, parameters] :
       {std::pair{"open", ""}, std::pair{"partial-short", "fraction = 0.5"}}) {
    const auto seen =
        SeenBesideLoop(FaultOf(3, "partial-short", kLoop) + FaultOf(6, kind, parameters, kLater));
    EXPECT_EQ(seen->Coils(), (std::set<int>{3, 6})) << kind;
  }
}

// A loop moves the c of its neighbours by some tenths, now and then within a period: as much is no
// loss of their turns.
TEST(ClosedTurns, WhatALoopDoesToItsNeighboursIsNoLossOfTheirTurns) {
  const std::string fifth = FaultOf(6, "partial-short", "fraction = 0.2", kLater);
  EXPECT_EQ(SeenBesideLoop(fifth)->Coils(), std::set<int>{6});
  const auto beside = SeenBesideLoop(FaultOf(3, "partial-short", kLoop) + fifth);
  EXPECT_EQ(beside->Coils(), std::set<int>{3});
  EXPECT_TRUE(beside->doubted);
}

}  // namespace
}  // namespace ambrig
