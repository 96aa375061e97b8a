// Faults near the end of the range of flux that was commissioned: lost turns make the flux that is
// computed too large. Plants: the switching engine with effects.
#include <gtest/gtest.h>

#include "tests/fdd/commissioned_plant.h"

namespace ambrig {
namespace {

using namespace testing_plant;

/// What the detector learnt of SlowIron, as if the commissioning had gone to `share` of the flux.
CommissionedBearing UpTo(double share) {
  CommissionedBearing b = SlowIron().bearing;
  for (double& flux : b.largest_flux.v) flux *= share;
  return b;
}

/// The smallest range that a healthy run does not leave, to a percent.
double JustEnough() {
  double less = 0.1, enough = 1;
  while (enough - less > 0.01) {
    const double share = (less + enough) / 2;
    const CommissionedBearing b = UpTo(share);
    (Concluded(SlowIron().rig, &b, Operation(""))->doubted ? less : enough) = share;
  }
  return enough;
}

TEST(CommissionedRange, AFaultAtItsEndIsFoundInTime) {
  const CommissionedBearing b = UpTo(1.005 * JustEnough());
  for (int coil = 1; coil <= 8; ++coil) {
    const auto seen =
        Concluded(SlowIron().rig, &b, Operation(FaultOf(coil, "partial-short", "fraction = 0.1")));
    ASSERT_EQ(seen->Coils(), std::set<int>{coil});
    EXPECT_LT(seen->found[0].time - kOnset, 0.5e-3) << coil;
  }
}

// Iron that saturates beyond what was commissioned raises c as a short does, but not at once.
TEST(CommissionedRange, IronThatSaturatesBeyondItIsNoFault) {
  const CommissionedRig iron(WithEffect(ReferenceRig(), "saturation", "A", {{"knee", 0.6}}));
  CommissionedBearing b = iron.bearing;
  for (const double share : {0.9, 0.8, 0.7, 0.6, 0.5}) {
    for (int j = 0; j < 8; ++j) b.largest_flux[j] = share * iron.bearing.largest_flux[j];
    EXPECT_TRUE(Concluded(iron.rig, &b, Operation("", 0.1))->found.empty()) << share;
  }
}

}  // namespace
}  // namespace ambrig
