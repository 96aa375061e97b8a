/// Planes that a synthesis weighs besides the bearings, against designs that say the same in other
/// words.
#include "control/synthesis/plane_weight.h"

#include <gtest/gtest.h>

#include "control/synthesis/h_infinity.h"
#include "control/synthesis/lqg.h"
#include "tests/control/unstable_mass.h"

namespace ambrig {
namespace {

/// The weighed plane is the sensor's own.
SampledPlant UnstableMass(double displacement_weight, double force_noise) {
  SampledPlant p = testing::UnstableMass();
  if (displacement_weight > 0) p.V = p.C / displacement_weight;
  if (force_noise > 0) p.G = force_noise * p.E;
  return p;
}

// y²/a² + y²/b² is y²/c² with 1/c² = 1/a² + 1/b²; two independent forces at one place add by their
// squares.
TEST(PlaneWeight, OfTheSensorsOwnPlaneAddsToItsWeight) {
  const LqgParameters given;
  const double b = 0.7e-5, more = 2;
  LqgParameters sum = given;
  sum.position_weight = 1 / std::hypot(1 / given.position_weight, 1 / b);
  sum.force_noise = std::hypot(given.force_noise, more);
  const LqgDesign one = DesignLqg(UnstableMass(b, more), given, "test"),
                  other = DesignLqg(UnstableMass(0, 0), sum, "test"),
                  without = DesignLqg(UnstableMass(0, 0), given, "test");
  EXPECT_LT((one.Kx - other.Kx).norm(), 1e-9 * other.Kx.norm());
  EXPECT_LT((one.L - other.L).norm(), 1e-9 * other.L.norm());
  EXPECT_GT((one.Kx - without.Kx).norm(), 0.01 * without.Kx.norm());
  EXPECT_GT((one.L - without.L).norm(), 0.01 * without.L.norm());
}

// The generalised plant has the plane's forces and displacement beside the others, and the least
// gamma cannot fall by asking more.
TEST(PlaneWeight, InTheGeneralisedPlant) {
  const HInfinityParameters w;
  const SampledPlant with = UnstableMass(1e-8, 40), without = UnstableMass(0, 0);
  const StateSpace P = HInfinityPlant(with, w);
  EXPECT_EQ(P.inputs(), 4);   // d, plane, noise, f
  EXPECT_EQ(P.outputs(), 4);  // W y, f, v, y
  const std::complex<double> z = std::polar(1.0, 0.05);
  const Eigen::MatrixXcd G = P.Response(z);
  EXPECT_LT(std::abs(G(2, 1) - with.FromDisturbance().Response(z)(0, 0) * 40.0 / 1e-8),
            1e-9 * std::abs(G(2, 1)));
  EXPECT_LT(
      std::abs(G(3, 3) - with.FromForce().Response(z)(0, 0) * w.force_weight / w.sensor_noise),
      1e-9 * std::abs(G(3, 3)));
  const HInfinityDesign more = DesignHInfinity(with, w, "test"),
                        less = DesignHInfinity(without, w, "test");
  EXPECT_LT(SpectralRadius(LoopMatrix(with.FromForce(), more.controller)), 1);
  EXPECT_GT(more.least_gamma, 1.01 * less.least_gamma);
}

}  // namespace
}  // namespace ambrig
