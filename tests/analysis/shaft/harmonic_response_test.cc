// Harmonic forces and moving ground against one mass on a spring.
#include "analysis/shaft/harmonic_response.h"

#include <gtest/gtest.h>

#include "core/math/constants.h"

namespace ambrig {
namespace {

constexpr double kForcedK = 4e5, kForcedC = 200;

/// A stiff bar with a disk in the middle; springs of k/2 and dampers of c/2 at its ends.
BeamRotor StiffRotor() {
  BeamDefinition d;
  ShaftSection s;
  s.length = 1.2;
  s.od = s.od_right = 0.4;
  s.material = {1e13, 1, 0.3};
  d.sections = {s};
  d.elements_per_section = 2;
  d.disks.push_back({0.6, 10, 0.5, 0.1, "disk", ""});
  for (const double z : {0.0, 1.2})
    d.supports.push_back(IsotropicSupport(z, kForcedK / 2, kForcedC / 2));
  return BuildBeam(d);
}

std::complex<double> Stiffness(double w) {
  const double m = Totals(StiffRotor()).mass;
  return {kForcedK - w * w * m, w * kForcedC};
}

// The bar's own bending gives way by some 1e-6 of the springs.
TEST(HarmonicResponse, ForceOnOneMass) {
  const ShaftProbe middle{"disk", 0.6, ""};
  const std::vector<double> at = {50, 190, 199, 210, 400};
  const HarmonicSweep s =
      SweepHarmonic(StiffRotor(), 0, {{{middle, 3, 4, 0.5}}, 0, 0}, {middle}, at);
  for (std::size_t k = 0; k < at.size(); ++k) {
    const std::complex<double> unit = std::polar(1.0, 0.5) / Stiffness(at[k]);
    EXPECT_LT(std::abs(s.probes[0].x[k] / (3.0 * unit) - 1.0), 1e-4) << at[k];
    EXPECT_LT(std::abs(s.probes[0].y[k] / (4.0 * unit) - 1.0), 1e-4) << at[k];
  }
}

// Transmissibility (k + i w c)/(k - w² m + i w c), and at w = 0 the shaft goes with the ground.
TEST(HarmonicResponse, GroundThatMoves) {
  const ShaftProbe middle{"disk", 0.6, ""};
  const std::vector<double> at = {1e-3, 150, 195, 300};
  const HarmonicSweep s = SweepHarmonic(StiffRotor(), 0, {{}, 1e-5, 0}, {middle}, at);
  for (std::size_t k = 0; k < at.size(); ++k) {
    const std::complex<double> moved =
        1e-5 * std::complex<double>(kForcedK, at[k] * kForcedC) / Stiffness(at[k]);
    EXPECT_LT(std::abs(s.probes[0].x[k] / moved - 1.0), 1e-4) << at[k];
    EXPECT_LT(std::abs(s.probes[0].y[k]), 1e-15);
  }
}

// A forward turning force is unbalance: (1, -i) Omega² U.
TEST(HarmonicResponse, UnbalanceIsTwoForces) {
  const BeamRotor rotor = StiffRotor();
  const ShaftProbe off{"off", 0.3, ""};
  const double w = 230, u = 1e-4;
  const auto x = SweepHarmonic(rotor, w, {{{off, u * w * w, 0, 0}}, 0, 0}, {off}, {w});
  const auto y = SweepHarmonic(rotor, w, {{{off, 0, u * w * w, -kPi / 2}}, 0, 0}, {off}, {w});
  const auto both = SweepShaft(rotor, {{"one", {{0.3, u, 0}}}}, {off}, {w});
  const auto sum = x.probes[0].x[0] + y.probes[0].x[0];
  EXPECT_LT(std::abs(sum / both[0].probes[0].x[0] - 1.0), 1e-11);
}

}  // namespace
}  // namespace ambrig
