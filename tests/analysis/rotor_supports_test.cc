// The rotor on the springs of its bearings: the whole beam, whatever bending and residual modes its
// runs keep.
#include "analysis/rotor_supports.h"

#include <gtest/gtest.h>

#include "tests/simulation/tum_rig.h"

namespace ambrig {
namespace {

using testing::TumRig;
using testing::TumRigText;

RotorOnSupports Supported(const std::string& modes) {
  const RigParameters rig = TumRig(TumRigText({{"modes = 4", modes}}));
  return AnalyseSupports(FindOperatingPoint(rig), 5);
}

TEST(RotorSupports, AreOfTheWholeBeamWhateverTheRunsKeep) {
  const RotorOnSupports four = Supported("modes = 4");
  for (const char* modes : {"modes = 2", "modes = 2\nstatic_correction = true"}) {
    const RotorOnSupports other = Supported(modes);
    ASSERT_EQ(other.free.size(), four.free.size()) << modes;
    ASSERT_EQ(other.supported.size(), four.supported.size()) << modes;
    for (std::size_t k = 0; k < four.free.size(); ++k)
      EXPECT_NEAR(other.free[k].frequency / four.free[k].frequency, 1, 1e-6) << modes << k;
    // The bearings' springs follow the sag of what is kept, by its square: 0.1 % of 1 %.
    for (std::size_t k = 0; k < four.supported.size(); ++k)
      EXPECT_NEAR(other.supported[k].frequency / four.supported[k].frequency, 1, 1e-5)
          << modes << k;
    ASSERT_EQ(other.critical.size(), four.critical.size()) << modes;
    for (std::size_t k = 0; k < four.critical.size(); ++k)
      EXPECT_NEAR(other.critical[k].speed / four.critical[k].speed, 1, 1e-5) << modes << k;
  }
}

}  // namespace
}  // namespace ambrig
