// Periods under one iron law in one loop, against the same samples one by one
// (stator_lanes_general.cc).
#include "actuators/magnetics/law_loop.h"

#include <gtest/gtest.h>

#include "tests/effects/effect_rigs.h"

namespace ambrig {
namespace {

constexpr int kSamples = 18, kPeriods = 300;
constexpr double kPeriod = 1 / 25e3;  // [s]

struct OneLaw {
  std::string effect, target;
  Values values;
};
void PrintTo(const OneLaw& law, std::ostream* out) { *out << law.effect << " at " << law.target; }

/// The bearing that has the effect, settled at `current` [A].
struct Bench {
  Plant plant;
  StatorLanes* lanes = nullptr;

  Bench(const OneLaw& law, double current) : plant(PlantWith(law.effect, law.target, law.values)) {
    for (BearingPlant& b : plant.bearings)
      if (!b.laws.empty()) lanes = &b.lanes;
    lanes->SetStep(kPeriod / kSamples);
    lanes->Settle(Currents(current), 0, 0);
  }
};

/// Duties that hold about `wanted` [A] and wander by some percent of the period from coil to coil.
VoltagePattern PatternFor(const StatorLanes& lanes, double wanted, int period) {
  VoltagePattern p;
  for (int j = 0; j < lanes.coils; ++j) {
    const double wander = 0.06 * std::sin(0.7 * period + 1.3 * j) + 0.02 * std::cos(2.9 * period);
    p.t2[j] = kPeriod * std::clamp(0.51 + 0.15 * (wanted - lanes.i[j]) + wander, 0.02, 0.98);
    p.gain[1][j] = 1;
    p.gain[0][j] = p.gain[2][j] = -1;
  }
  return p;
}

struct Outcome {
  double worst_flux = 0;  // difference over the flux
  bool blocked = false;   // some diode has ended a current
  Lane phi, i;
};

/// The loop's way beside that of single samples, at the same voltages along the same motion.
Outcome Compare(const OneLaw& law, double current) {
  Bench looped(law, current), single(law, current);
  Outcome out;
  double x = 0;
  for (int n = 0; n < kPeriods; ++n) {
    const VoltagePattern p = PatternFor(*single.lanes, current, n);
    const double next = 4e-5 * std::sin(0.05 * (n + 1));
    looped.lanes->RunGeneralPeriod(p, 30, x, 0, next, 0, kSamples);
    single.lanes->BeginPeriod(x, 0, next, 0, kSamples);
    for (int k = 0; k < kSamples; ++k) single.lanes->StepSample(p, 30, k);
    single.lanes->EndPeriod();
    x = next;
    double size = 0, difference = 0;
    for (int j = 0; j < single.lanes->coils; ++j) {
      size = std::max(size, std::abs(single.lanes->phi[j]));
      difference = std::max(difference, std::abs(looped.lanes->phi[j] - single.lanes->phi[j]));
      out.blocked = out.blocked || single.lanes->blocked[static_cast<std::size_t>(j)];
    }
    out.worst_flux = std::max(out.worst_flux, difference / size);
    EXPECT_NEAR(looped.lanes->fx, single.lanes->fx, 1e-5 * (1 + std::abs(single.lanes->fx))) << n;
  }
  out.phi = looped.lanes->phi;
  out.i = looped.lanes->i;
  return out;
}

class LawLoop : public testing::TestWithParam<OneLaw> {};

// Either way stops where what is left of the tangent's error is kCorrected or kConverged of the
// flux, times the change of the tangent over the circuit's stiffness, at most a tenth here. The
// linkages, which both ways integrate, keep the errors of samples from adding up.
TEST_P(LawLoop, GivesTheFluxesOfSingleSamples) {
  const Outcome out = Compare(GetParam(), 2);
  EXPECT_LT(out.worst_flux, 0.1 * (kCorrected + kConverged));
  EXPECT_FALSE(out.blocked);
}

// Around zero current diodes block: those samples are solved one by one, in the middle of a period.
TEST_P(LawLoop, LeavesBlockingDiodesToSingleSamples) {
  const Outcome out = Compare(GetParam(), 0.05);
  EXPECT_TRUE(out.blocked);
  EXPECT_LT(out.worst_flux, 0.1 * (kCorrected + kConverged));
}

TEST_P(LawLoop, SameBitsInHalves) {
  if (!HasWholeLanes()) GTEST_SKIP() << "no 512-bit registers here";
  const Outcome whole = Compare(GetParam(), 2);
  whole_lanes = false;
  const Outcome halves = Compare(GetParam(), 2);
  whole_lanes = true;
  for (int j = 0; j < kLanes; ++j) {
    EXPECT_EQ(whole.phi[j], halves.phi[j]) << j;
    EXPECT_EQ(whole.i[j], halves.i[j]) << j;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Laws, LawLoop,
    testing::Values(OneLaw{"iron-reluctance", "A", {{"path", 2e-5}, {"threshold", 10}}},
                    OneLaw{"saturation", "A", {{"knee", 0.3}, {"path", 0.1}}},
                    OneLaw{"hysteresis", "A", {{"coercive", 0.2}, {"width", 0.1}}},
                    OneLaw{"eddy-currents", "A", {{"cutoff", 400}}},
                    OneLaw{"eddy-impedance", "A", {{"path", 1e-5}, {"r4", 0.2}, {"r9", 5}}},
                    OneLaw{"play-hysteresis", "A", {{"width", 0.2}, {"c3", 0.03}, {"c7", 0.1}}},
                    OneLaw{"hysteresis", "Z", {{"coercive", 0.2}, {"width", 0.1}}},
                    OneLaw{"eddy-currents", "Z", {{"cutoff", 400}, {"path", 3e-5}}}));

}  // namespace
}  // namespace ambrig
