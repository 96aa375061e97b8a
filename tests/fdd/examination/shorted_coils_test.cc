// Several coils shorted at once, on the simulator's own stator with the ADC's noise.
#include "fdd/examination/shorted_coils.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using namespace testing_bench;

DetectorSettings Settings(const Bench& bench) {
  DetectorSettings s;
  s.sampling = bench.Sampling();
  return s;
}

std::array<bool, kLanes> All() {
  std::array<bool, kLanes> judged;
  judged.fill(true);
  return judged;
}

/// Five noisy periods while the coils are driven unequally.
std::vector<KeptPeriod> Measured(Bench& bench, unsigned seed) {
  std::mt19937 g(seed);
  std::uniform_real_distribution<double> duty(0.5, 0.55);
  std::normal_distribution<double> noise(0, 0.004);
  std::vector<KeptPeriod> kept(5);
  for (KeptPeriod& p : kept) {
    for (double& d : bench.duty.v) d = duty(g);
    p.in = bench.Run();
    for (int k = 0; k < kSamples; ++k) {
      p.adc[static_cast<std::size_t>(k)] = bench.adc[k];
      for (double& i : p.adc[static_cast<std::size_t>(k)].v) i = i > 0 ? i + noise(g) : i;
    }
    p.duty = bench.duty;
  }
  for (KeptPeriod& p : kept) {
    p.in.adc = p.adc.data();
    p.in.duty = &p.duty;
  }
  return kept;
}

/// As the detector does: from two periods, and when they do not tell, from five.
ShortedCoils Examined(const Bench& bench, const std::vector<KeptPeriod>& kept) {
  const LinkageModel m = MakeLinkageModel(Reference());
  const ShortedCoils found = FindShortedCoils(m, Settings(bench), {&kept[0], &kept[1]}, All());
  if (!found.coils.empty()) return found;
  return FindShortedCoils(m, Settings(bench), {&kept[0], &kept[1], &kept[2], &kept[3], &kept[4]},
                          All());
}

ShortedCoils Found(Bench& bench, unsigned seed) { return Examined(bench, Measured(bench, seed)); }

/// Coil 7 with `least` of its turns shorted, the others with 20 to 60 %. False when nothing was
/// decided.
bool NamesItsCoils(unsigned set, double least) {
  const double shorted[] = {0.5, 0.2, 0.3, 0.6, 0.2, 0.5, least, 0.4};
  Bench bench;
  for (int j = 0; j < kLanes; ++j)
    if (set >> j & 1) bench.lanes.ShortTurns(j, shorted[j], kInfinity, bench.x0, bench.y0);
  const ShortedCoils found = Found(bench, set);
  const bool several = std::popcount(set) > 1;  // one alone is coil_examination.h's
  if (found.coils.empty()) return !several;
  unsigned named = 0;
  for (int j : found.coils) {
    named |= 1u << j;
    EXPECT_NEAR(found.turns_left[j], 1 - shorted[j], 0.03) << set << " coil " << j + 1;
  }
  EXPECT_EQ(named, several ? set : 0u);
  return true;
}

TEST(ShortedCoils, NoSetIsMistakenAndNearlyAllAreNamed) {
  int undecided = 0;
  for (unsigned set = 1; set < 256; ++set) undecided += !NamesItsCoils(set, 0.2);
  // of 255: a coil with 60 % shorted falls to zero current, others fit as well
  EXPECT_LE(undecided, 1);
}

// In larger sets a few noisy periods do not tell so small a short; it is found later, alone.
TEST(ShortedCoils, AMinorShortBesideTwoOthersIsNamed) {
  for (unsigned set = 1; set < 256; ++set)
    if (std::popcount(set) <= 3) {
      EXPECT_TRUE(NamesItsCoils(set, 0.1)) << set;
    }
}

TEST(ShortedCoils, OpenCoilsBesideThemAreLeftOut) {
  Bench bench;
  bench.lanes.Break(0, bench.x0, bench.y0);
  bench.lanes.ShortTurns(3, 0.5, kInfinity, bench.x0, bench.y0);
  bench.lanes.ShortTurns(6, 0.3, kInfinity, bench.x0, bench.y0);
  EXPECT_EQ(Found(bench, 3).coils, (std::vector<int>{3, 6}));
}

// Six coils were given up. Of the two that are left one has lost half of its turns, the other one
// so few that the tolerances of the gaps explain as much: one coil alone is coil_examination.h's.
TEST(ShortedCoils, OfTwoCoilsThatAreLeftAHealthyOneIsNotNamed) {
  Bench bench;
  bench.lanes.ShortTurns(3, 0.03, kInfinity, bench.x0, bench.y0);
  bench.lanes.ShortTurns(6, 0.5, kInfinity, bench.x0, bench.y0);
  const std::vector<KeptPeriod> kept = Measured(bench, 5);
  DetectorSettings s = Settings(bench);
  std::array<bool, kLanes> left{};
  left[3] = left[6] = true;
  s.gap_sd = 0.04;
  EXPECT_TRUE(
      FindShortedCoils(MakeLinkageModel(Reference()), s, {&kept[0], &kept[1]}, left).coils.empty());
  // Where the gaps are known better it is a short of its own.
  s.gap_sd = 0.001;
  EXPECT_EQ(FindShortedCoils(MakeLinkageModel(Reference()), s, {&kept[0], &kept[1]}, left).coils,
            (std::vector<int>{3, 6}));
}

// What is no set of bypassed turns must not be explained as one.
TEST(ShortedCoils, OtherFaultsAreNotExplained) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Bench healthy;
    EXPECT_TRUE(Found(healthy, seed).coils.empty());
    Bench sensor;
    std::vector<KeptPeriod> kept = Measured(sensor, seed);
    for (KeptPeriod& p : kept)
      for (Lane& i : p.adc) i[static_cast<int>(seed % 8)] *= 0.7;
    EXPECT_TRUE(Examined(sensor, kept).coils.empty()) << seed;
    Bench loop;  // the shorted turns carry a current of their own
    loop.lanes.ShortTurns(static_cast<int>(seed % 8), 0.3, 0.05, loop.x0, loop.y0);
    EXPECT_TRUE(Found(loop, seed).coils.empty()) << seed;
  }
}

}  // namespace
}  // namespace ambrig
