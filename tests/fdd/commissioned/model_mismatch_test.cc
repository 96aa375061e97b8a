// A model of another machine: c of all coils departs alike, at no instant. Nobody is blamed.
#include <gtest/gtest.h>

#include "tests/fdd/commissioned_plant.h"

namespace ambrig {
namespace {

using namespace testing_plant;

/// A machine whose bearing A has what the model that was learnt on the base model does not.
RigParameters OtherMachine(double cutoff) {
  return WithEffect(ReferenceRig(), "eddy-currents", "A", {{"cutoff", cutoff}});
}

TEST(ModelMismatch, OfAnotherMachineNoTurnsAreMissed) {
  for (const double cutoff : {600.0, 1000.0, 3000.0}) {
    const auto seen = Concluded(OtherMachine(cutoff), &BaseModel().bearing, Operation(""));
    EXPECT_TRUE(seen->found.empty()) << cutoff;
    EXPECT_TRUE(seen->doubted) << cutoff;
  }
}

TEST(ModelMismatch, ACoilWithoutCurrentIsNamedAllTheSame) {
  const auto seen =
      Concluded(OtherMachine(1000), &BaseModel().bearing, Operation(FaultOf(3, "open"), 0.033));
  EXPECT_EQ(seen->Coils(), std::set<int>{3});
  EXPECT_LT(seen->found.at(0).time - kOnset, 0.5e-3);
}

}  // namespace
}  // namespace ambrig
