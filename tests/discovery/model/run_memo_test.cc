// Predictions kept in memory: found again by what a record depends on, the oldest given up first.
#include "discovery/model/run_memo.h"

#include <gtest/gtest.h>

#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

std::vector<double> Rows(double first) { return {first, first + 1, first + 2, first + 3}; }

TEST(RunMemo, GivesBackWhatItKeeps) {
  RunMemo memo;
  const std::vector<double> rows = Rows(5);
  memo.Keep("a", true, rows.data(), rows.size());
  std::vector<double> out(4, 0);
  EXPECT_EQ(memo.Find("a", out.data()), true);
  EXPECT_EQ(out, rows);
  EXPECT_EQ(memo.Find("b", out.data()), std::nullopt);
  memo.Keep("a", true, Rows(9).data(), 4);  // the first stays
  EXPECT_EQ(memo.Find("a", out.data()), true);
  EXPECT_EQ(out, rows);
  memo.Clear();
  EXPECT_EQ(memo.Find("a", out.data()), std::nullopt);
}

TEST(RunMemo, ALostRotorIsRememberedWithoutRows) {
  RunMemo memo;
  memo.Keep("lost", false, Rows(1).data(), 4);
  std::vector<double> out(4, 7);
  EXPECT_EQ(memo.Find("lost", out.data()), false);
  EXPECT_EQ(out, std::vector<double>(4, 7));
}

// Room for two of four numbers and their keys: the one not used for longest goes.
TEST(RunMemo, TheLeastRecentlyUsedGoesFirst) {
  RunMemo memo(2 * (4 * sizeof(double) + 2));
  std::vector<double> out(4);
  for (const char* key : {"a", "b"}) memo.Keep(key, true, Rows(1).data(), 4);
  EXPECT_TRUE(memo.Find("a", out.data()));
  memo.Keep("c", true, Rows(3).data(), 4);
  EXPECT_TRUE(memo.Find("a", out.data()));
  EXPECT_FALSE(memo.Find("b", out.data()));
  EXPECT_TRUE(memo.Find("c", out.data()));
}

// Five keys of a hundred letters fit in a thousand bytes: of fifty the last five are there, however
// many went before.
TEST(RunMemo, HoldsAsManyAsFitAfterManyHaveGone) {
  RunMemo memo(1000);
  const auto key = [](int k) {
    return std::string(98, 'k') + static_cast<char>('0' + k / 10) + static_cast<char>('0' + k % 10);
  };
  std::vector<double> out(4);
  for (int k = 0; k < 50; ++k) {
    memo.Keep(key(k), false, Rows(1).data(), 4);
    EXPECT_EQ(memo.Find(key(std::max(0, k - 4)), out.data()), false) << k;
    if (k >= 5) {
      EXPECT_EQ(memo.Find(key(k - 5), out.data()), std::nullopt) << k;
    }
    for (int j = std::max(0, k - 4); j <= k; ++j)
      memo.Find(key(j), out.data());  // in their order again
  }
}

class MemoKeyTest : public ::testing::Test {
 protected:
  std::string Key(const std::vector<EffectInstance>& effects, const char* start, double speed) {
    return Key(effects, start, SpeedProfile({{0, speed}, {0.004, speed}}));
  }
  std::string Key(const std::vector<EffectInstance>& effects, const char* start,
                  const SpeedProfile& speed) {
    RigParameters rig = case_.rig;
    rig.effects = effects;
    rig.tolerances = tolerances_;
    CaseRecord r = case_.records[0];
    r.scenario.start =
        std::string(start) == "clamped" ? StartState::kClamped : StartState::kLevitated;
    r.scenario.speed = speed;
    return MemoKey(rig, r, 0);
  }
  EffectInstance Effect(const char* id, const char* target, double value) {
    EffectInstance e = MakeInstance(EffectNamed(id), target);
    e.values[0] = value;
    return e;
  }
  Case case_ = LinearCase::Make({2e-5}, 1, 0);
  std::vector<Tolerance> tolerances_;
};

TEST_F(MemoKeyTest, EffectsTheirPlacesAndTheirSizesTellRunsApart) {
  const std::string none = Key({}, "levitated", 0);
  const std::string gain = Key({LinearCase::Gain(1.1)}, "levitated", 0);
  EXPECT_NE(none, gain);
  EXPECT_NE(gain, Key({LinearCase::Gain(1.1000001)}, "levitated", 0));
  EffectInstance other = LinearCase::Gain(1.1);
  other.target = "A.y";
  EXPECT_NE(gain, Key({other}, "levitated", 0));
  EXPECT_EQ(gain, Key({LinearCase::Gain(1.1)}, "levitated", 0));
}

TEST_F(MemoKeyTest, AHeldRotorDoesNotFeelWhatActsOnAFreeOne) {
  const EffectInstance pull = Effect("side-pull", "A", 1e4);
  EXPECT_EQ(Key({pull}, "clamped", 0), Key({}, "clamped", 0));
  EXPECT_NE(Key({pull}, "levitated", 0), Key({}, "levitated", 0));
  EXPECT_NE(Key({LinearCase::Gain(1.1)}, "clamped", 0), Key({}, "clamped", 0));
}

TEST_F(MemoKeyTest, ParametersCountWhereTheyAreFelt) {
  const auto changed = [&](const char* path, const char* start, double speed) {
    tolerances_ = {{path, 0.01, kRequired}};
    const std::string before = Key({}, start, speed);
    const double was = *ParameterAt(case_.rig, path);
    SetParameter(case_.rig, path, 1.01 * was);
    const bool differs = Key({}, start, speed) != before;
    SetParameter(case_.rig, path, was);
    return differs;
  };
  EXPECT_TRUE(changed("rotor.mass", "levitated", 0));
  EXPECT_FALSE(changed("rotor.mass", "clamped", 0));
  EXPECT_TRUE(changed("bearings.A.gap", "clamped", 0));
  EXPECT_FALSE(changed("rotor.inertia_polar", "levitated", 0));  // nothing turns
  EXPECT_TRUE(changed("rotor.inertia_polar", "levitated", 100));
}

// The scenario lasts 4 ms: a shaft that turns in any part of it has gyroscopic moments.
TEST_F(MemoKeyTest, AShaftThatTurnsForAWhileFeelsItsPolarInertia) {
  tolerances_ = {{"rotor.inertia_polar", 0.01, kRequired}};
  const double was = case_.rig.rotor.inertia_polar;
  using Rows = std::vector<std::vector<double>>;
  for (const Rows& rows : {Rows{{0, 50}, {0.001, 0}}, Rows{{0.0005, 0}, {0.001, 50}, {0.0015, 0}},
                           Rows{{0.003, 0}, {0.004, 50}}}) {
    case_.rig.rotor.inertia_polar = was;
    const std::string before = Key({}, "levitated", SpeedProfile(rows));
    case_.rig.rotor.inertia_polar = 1.01 * was;
    EXPECT_NE(Key({}, "levitated", SpeedProfile(rows)), before) << rows[1][1];
  }
}

}  // namespace
}  // namespace ambrig
