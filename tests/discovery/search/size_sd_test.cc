// Standard deviations of sizes with the shape of the law held: pieces of an information matrix.
#include "discovery/search/size_sd.h"

#include <gtest/gtest.h>

#include <cmath>

#include "effects/catalogue.h"
#include "tests/effects/effect_rigs.h"

namespace ambrig {
namespace {

/// The rig's mass, then gain and offset of a sensor.
Hypothesis MassGainOffset() {
  RigParameters rig = ReferenceRig();
  rig.tolerances = {{"rotor.mass", 0.01, kRequired}};
  Hypothesis h = Hypothesis::Base(rig);
  h.AddEffect(MakeInstance(EffectNamed("sensor-gain"), "A.x"));
  h.AddEffect(MakeInstance(EffectNamed("sensor-offset"), "A.x"));
  return h;
}

// Neither has a shape: each is known as well as the inverse of the information says.
TEST(SdOfSizes, WithoutAShapeItIsTheCovariance) {
  const Hypothesis h = MassGainOffset();
  ASSERT_EQ(h.free.size(), 3u);
  Eigen::Matrix3d information;
  information << 4, 1, 0.5, 1, 9, -2, 0.5, -2, 16;
  const Eigen::Matrix3d covariance = information.inverse();
  const std::vector<double> sd = SdOfSizes(h, information);
  EXPECT_EQ(sd[0], 0);  // of the rig, no size of an effect
  EXPECT_NEAR(sd[1], std::sqrt(covariance(1, 1)), 1e-12);
  EXPECT_NEAR(sd[2], std::sqrt(covariance(2, 2)), 1e-12);
}

// A low pass has one number, its frequency: it switches the effect. A resonance has amplitude,
// frequency and damping; with the latter two held the amplitude is known better.
TEST(SdOfSizes, ShapesAreHeldAndHaveNone) {
  const RigParameters rig = [] {
    RigParameters r = ReferenceRig();
    r.tolerances.clear();
    return r;
  }();
  int shapes = 0, sizes = 0;
  for (const EffectDescription& d : Catalogue()) {
    const auto targets = TargetsOf(d, TargetsOfEffects(rig));
    if (d.users_own || targets.empty()) continue;
    Hypothesis h = Hypothesis::Base(rig);
    EffectInstance e = MakeInstance(d, targets[0]);
    for (std::size_t row = 0; row < e.table.size(); ++row) e.values[row] = e.table[row].typical_hi;
    h.AddEffect(e);
    const auto n = static_cast<Eigen::Index>(h.free.size());
    // Everything is correlated by one half.
    const Eigen::MatrixXd information =
        0.5 * (Eigen::MatrixXd::Ones(n, n) + Eigen::MatrixXd::Identity(n, n));
    const std::vector<double> sd = SdOfSizes(h, information);
    Eigen::Index held = 0;
    for (const FreeParameter& p : h.free) held += d.Switches(e.table[p.row]) ? 0 : 1;
    const Eigen::Index left = n - held;
    for (std::size_t k = 0; k < h.free.size(); ++k) {
      if (!d.Switches(e.table[h.free[k].row])) {
        EXPECT_EQ(sd[k], 0) << h.free[k].path;
        ++shapes;
      } else {
        // Inverse of (1 + 1 1ᵀ)/2 of order m: diagonal 2 m/(m + 1).
        const auto m = static_cast<double>(left);
        EXPECT_NEAR(sd[k], std::sqrt(2 * m / (m + 1)), 1e-9) << h.free[k].path;
        ++sizes;
      }
    }
  }
  EXPECT_GT(shapes, 5);
  EXPECT_GT(sizes, 20);
}

}  // namespace
}  // namespace ambrig
