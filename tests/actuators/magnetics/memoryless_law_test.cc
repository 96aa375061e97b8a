// A law without memory: what it drops hangs on the flux alone, whatever went before.
#include "actuators/magnetics/memoryless_law.h"

#include <gtest/gtest.h>

namespace ambrig {
namespace {

/// drop = a phi^3.
class Cubic final : public MemorylessLaw {
 public:
  explicit Cubic(double a) : a_(a) {}
  void Drop(const Lane& phi, Lane* drop, Lane* slope) const override {
    for (int j = 0; j < kLanes; ++j) {
      (*drop)[j] += a_ * phi[j] * phi[j] * phi[j];
      (*slope)[j] += 3 * a_ * phi[j] * phi[j];
    }
  }

 private:
  double a_;
};

TEST(MemorylessLaw, AddsTheSameAtOnceAndAfterAnyTimeAndHistory) {
  Cubic law(2.0);
  FluxLaw& seam = law;
  Lane phi, other;
  for (int j = 0; j < kLanes; ++j) phi[j] = 1e-3 * (j - 3), other[j] = 5e-3;
  const auto added = [&](auto&& ask) {
    Lane drop, slope;
    for (int j = 0; j < kLanes; ++j) drop[j] = 7, slope[j] = 11;
    ask(&drop, &slope);
    for (int j = 0; j < kLanes; ++j) {
      EXPECT_EQ(drop[j], 7 + 2.0 * phi[j] * phi[j] * phi[j]);
      EXPECT_EQ(slope[j], 11 + 6.0 * phi[j] * phi[j]);
    }
  };
  added([&](Lane* drop, Lane* slope) { seam.Drop(phi, drop, slope); });
  added([&](Lane* drop, Lane* slope) { seam.Steady(phi, drop, slope); });
  seam.SetStep(1e-6);
  seam.Commit(other);
  added([&](Lane* drop, Lane* slope) { seam.Drop(phi, drop, slope); });
  seam.Settle(other);
  added([&](Lane* drop, Lane* slope) { seam.Drop(phi, drop, slope); });
  added([&](Lane* drop, Lane* slope) { seam.Steady(phi, drop, slope); });
  EXPECT_FALSE(seam.linear());
}

}  // namespace
}  // namespace ambrig
