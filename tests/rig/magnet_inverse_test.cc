// Currents from forces by the inverse of the magnets: the force of independent laws is the one
// asked for, at any place.
#include "rig/magnet_inverse.h"

#include <gtest/gtest.h>

#include <cmath>

#include "actuators/magnetics/radial_stator.h"
#include "core/base/read_file.h"
#include "core/math/constants.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_file.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

TEST(MagnetInverse, RadialBearingGivesTheForceAnywhere) {
  const NominalRig rig(ReadRigText(ReferenceRigText(), "rig.toml"));
  const MagnetInverse inverse = MagnetInverseOf(rig, 0, {0, 20});
  const RadialStator stator(rig->bearings[0].radial);
  for (const Eigen::Vector2d& r : {Eigen::Vector2d(0, 0), {5e-5, -8e-5}, {-1e-4, 3e-5}})
    for (const Eigen::Vector2d& f : {Eigen::Vector2d(0, 20), {-30, 10}, {0, 0}}) {
      const Lane set = inverse.currents(f, r);
      CoilVector i;
      for (int j = 0; j < kPoles; ++j) i[j] = set[j];
      EXPECT_LT((stator.Force(r, i) - f).norm(), 1e-9 * (1 + f.norm()));
      EXPECT_GE(i.minCoeff(), 0);
    }
}

// At the centre k_s = k c0²/g plus what the weight's control currents add: (k/g)(c0² + |v|²) here.
TEST(MagnetInverse, NegativeStiffnessIsTheClosedForm) {
  const NominalRig rig(ReadRigText(ReferenceRigText(), "rig.toml"));
  const RadialStatorParameters& p = rig->bearings[0].radial;
  const double c0 = rig->controller.bias_current;
  const double k = 4 * kMu0 * p.turns * p.turns * p.pole_area / (p.gap * p.gap);
  const Eigen::Matrix2d ks = MagnetInverseOf(rig, 0, {0, 0}).negative_stiffness;
  EXPECT_LT((ks - k * c0 * c0 / p.gap * Eigen::Matrix2d::Identity()).norm(), 1e-9 * ks.norm());
}

TEST(MagnetInverse, OneMagnetIsASquareRoot) {
  const NominalRig rig(ReadRig(AMBRIG_SOURCE_DIR "/examples/mls2em/rig.toml"));
  const OpposedStatorParameters& p = rig->bearings[0].opposed;
  const MagnetInverse inverse = MagnetInverseOf(rig, 0, {0.6, 0});
  const double x = 0.2 * p.gap, reach = p.gap_constant + p.gap - x;
  for (const double f : {0.3, 0.6, 1.2}) {
    const Lane set = inverse.currents({f, 0}, {x, 0});
    const double pull = 0.5 * set[0] * set[0] * p.inductance_near * p.gap_constant / reach / reach;
    double against = 0;
    if (p.coils > 1)
      against = 0.5 * set[1] * set[1] * p.inductance_near * p.gap_constant /
                std::pow(p.gap_constant + p.gap + x, 2);
    EXPECT_NEAR(pull - against, f, 1e-9);
  }
}

}  // namespace
}  // namespace ambrig
