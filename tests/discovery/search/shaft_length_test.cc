// A bending mode is sought with shafts of other lengths too.
#include "tests/discovery/search/resonance_case.h"

namespace ambrig {
namespace {

class ShaftLengthTest : public testing::ResonanceStartTest {};

// The shape of a mode between the planes has valleys of its own: readings at both sensors tell a
// shaft of half the length.
TEST_F(ShaftLengthTest, AShorterShaftThatBendsIsFound) {
  const auto bending = [](double frequency, double gain_a, double gain_b, double length) {
    EffectInstance e = MakeInstance(EffectNamed("bending-mode"), "rig");
    e.Set("frequency", frequency);
    e.Set("gain_a", gain_a);
    e.Set("gain_b", gain_b);
    e.Set("length", length);
    return e;
  };
  data_.rig.bearings[1].sensor.z = 0.3;  // within the bearings; the other one stands outside
  testing::Measure(data_, bending(300, 0.06, 0.07, 0.55));
  const FitResult fit = FittedFrom(bending(310, 0.05, 0.05, 1));
  ASSERT_TRUE(fit.converged);
  const EffectInstance found = FittedEffect(fit, 0);
  EXPECT_NEAR(found.Value("frequency"), 300, 1);
  EXPECT_NEAR(found.Value("gain_a"), 0.06, 0.003);
  EXPECT_NEAR(found.Value("gain_b"), 0.07, 0.003);
  EXPECT_LT(found.Value("length"), 0.7);
}

}  // namespace
}  // namespace ambrig
