// Several coils of a bearing fail at one instant: all of them are named, no other is. The plants
// have effects that the detector's equations do not contain.
#include <gtest/gtest.h>

#include "tests/fdd/commissioned_plant.h"

namespace ambrig {
namespace {

using namespace testing_plant;

std::string Together(const std::vector<int>& coils, const std::string& kind,
                     const std::string& parameters = "") {
  std::string text;
  for (int coil : coils) text += FaultOf(coil, kind, parameters);
  return text;
}

std::set<int> SetOf(const std::vector<int>& coils) { return {coils.begin(), coils.end()}; }

std::string TextOf(const std::vector<int>& coils) {
  return fmt::format("coils {}", fmt::join(coils, ","));
}

const std::vector<std::vector<int>> kSets = {
    {1, 2},    {3, 6},       {1, 5},       {1, 2, 3},    {1, 3, 5},    {2, 4, 6},
    {3, 4, 8}, {1, 2, 3, 4}, {1, 3, 5, 7}, {1, 2, 5, 6}, {2, 3, 6, 7}, {1, 2, 4, 6, 7}};

void ExpectAllOpensNamed(const CommissionedRig& plant, const std::vector<int>& coils) {
  const auto seen = Concluded(plant.rig, &plant.bearing, Operation(Together(coils, "open"), 0.032));
  EXPECT_EQ(seen->Coils(), SetOf(coils)) << TextOf(coils);
  double first = kInfinity;
  for (const Diagnosis& d : seen->found) {
    EXPECT_EQ(d.cls, FaultClass::kOpen) << TextOf(coils) << " " << d.coil + 1;
    EXPECT_LT(d.time - kOnset, 2e-3) << TextOf(coils) << " " << d.coil + 1;
    first = std::min(first, d.time - kOnset);
  }
  EXPECT_LT(first, 0.25e-3) << TextOf(coils);
}

TEST(SimultaneousFaults, OpenCoilsAreAllNamedAndNoNeighbour) {
  for (const std::vector<int>& coils : kSets) {
    ExpectAllOpensNamed(SlowIron(), coils);
    ExpectAllOpensNamed(ThinSheets(), coils);
  }
}

// The second of two is named although the detector pauses after the first, while which no other
// conclusion is drawn.
TEST(SimultaneousFaults, TheOtherOpenCoilOfAPairIsNamedWhileTheDetectorPauses) {
  for (int first = 1; first <= 8; ++first)
    for (int second = first + 1; second <= 8; ++second) {
      const auto seen = Concluded(SlowIron().rig, &SlowIron().bearing,
                                  Operation(Together({first, second}, "open"), 0.032));
      EXPECT_EQ(seen->Coils(), SetOf({first, second}));
      for (const Diagnosis& d : seen->found)
        EXPECT_LT(d.time - kOnset, 0.3e-3) << first << " and " << second << ": " << d.coil + 1;
    }
}

void ExpectAllShortsNamed(const CommissionedRig& plant, const std::vector<int>& coils,
                          double share) {
  const auto seen = Concluded(
      plant.rig, &plant.bearing,
      Operation(Together(coils, "partial-short", fmt::format("fraction = {}", share)), 0.0335));
  EXPECT_EQ(seen->Coils(), SetOf(coils)) << TextOf(coils);
  EXPECT_EQ(seen->found.size(), coils.size()) << TextOf(coils);
  for (const Diagnosis& d : seen->found) {
    EXPECT_EQ(d.cls, FaultClass::kPartialShort) << TextOf(coils) << " " << d.coil + 1;
    EXPECT_NEAR(d.fraction, share, 0.05) << TextOf(coils) << " " << d.coil + 1;
    EXPECT_LT(d.time - kOnset, 0.5e-3) << TextOf(coils) << " " << d.coil + 1;
  }
}

TEST(SimultaneousFaults, HalfShortsAreAllNamedWithTheirShareAndNoNeighbour) {
  for (const std::vector<int>& coils : kSets) {
    ExpectAllShortsNamed(SlowIron(), coils, 0.5);
    ExpectAllShortsNamed(ThinSheets(), coils, 0.5);
  }
}

TEST(SimultaneousFaults, AllCoilsAtOnce) {
  const std::vector<int> all = {1, 2, 3, 4, 5, 6, 7, 8};
  ExpectAllShortsNamed(SlowIron(), all, 0.5);
  ExpectAllOpensNamed(SlowIron(), all);
}

TEST(SimultaneousFaults, AnOpenCoilAndShortedOnesBesideIt) {
  const auto seen = Concluded(
      SlowIron().rig, &SlowIron().bearing,
      Operation(Together({2}, "open") + Together({5, 6}, "partial-short", "fraction = 0.5"),
                0.0335));
  EXPECT_EQ(seen->Coils(), (std::set<int>{2, 5, 6}));
  for (const Diagnosis& d : seen->found)
    EXPECT_EQ(d.cls, d.coil == 1 ? FaultClass::kOpen : FaultClass::kPartialShort) << d.coil + 1;
}

// Coils of one polarity that are shorted one after the other move the rotor's potential: what the
// model errs by there falls on the coils of the other polarity.
TEST(SimultaneousFaults, ShortsOfOnePolarityBlameNoneOfTheOther) {
  const std::pair<const char*, const CommissionedRig*> plants[] = {
      {"no effect", &BaseModel()}, {"slow iron", &SlowIron()}, {"thin sheets", &ThinSheets()}};
  for (const auto& [name, plant] : plants)
    for (const std::vector<int>& coils : {std::vector{1, 3, 5, 7}, {1, 2, 3, 5, 7}}) {
      std::string faults;
      double t = kOnset;
      for (const int coil : coils) {
        faults += FaultOf(coil, "partial-short", "fraction = 0.5", t);
        t += 4e-3;
      }
      const auto seen = Concluded(plant->rig, &plant->bearing, Operation(faults, t));
      EXPECT_EQ(seen->Coils(), SetOf(coils)) << name << ", " << TextOf(coils);
    }
}

// One half-short moves the c of its neighbours by a quarter: they are not blamed with it.
TEST(SimultaneousFaults, ASingleHalfShortBlamesNobodyElse) {
  for (const int coil : {1, 2, 3, 4, 5, 6, 7, 8}) {
    ExpectAllShortsNamed(SlowIron(), {coil}, 0.5);
    ExpectAllShortsNamed(ThinSheets(), {coil}, 0.6);
    // Those that pull least carry 1 A: with half of the turns their current ends in every off
    // phase.
    ExpectAllShortsNamed(ThinSheets(), {coil}, 0.5);
  }
}

// A small loss widens the bands of the other coils a little, so that the second of two is found.
TEST(SimultaneousFaults, TheSecondOfTwoSmallShortsIsFoundAfterTheFirst) {
  for (const CommissionedRig* plant : {&SlowIron(), &ThinSheets()})
    for (const char* share : {"0.1", "0.04"})
      for (const int other : {4, 5, 6, 7}) {
        const std::string both =
            Together({3, other}, "partial-short", std::string("fraction = ") + share);
        const auto seen = Concluded(plant->rig, &plant->bearing, Operation(both, 0.045));
        EXPECT_EQ(seen->Coils(), SetOf({3, other})) << share;
      }
}

}  // namespace
}  // namespace ambrig
