// Mistakes come in turn, with sizes that loggers and their users make.
#include "discovery/practice/mistake_draw.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace ambrig {
namespace {

TEST(MistakeDraw, EveryKindInTurnWithASizeOfItsOwn) {
  std::map<std::string, std::set<double>> sizes;
  for (std::size_t k = 0; k < 200; ++k) {
    const Spoiling s = DrawMistake(k, PracticeDraw(100 + k, 7));
    EXPECT_TRUE(s.channel.empty());
    EXPECT_EQ(s.fault, DrawMistake(k + 10, PracticeDraw(3, 7)).fault);
    EXPECT_EQ(s.amount, DrawMistake(k, PracticeDraw(100 + k, 7)).amount);
    sizes[s.fault].insert(s.amount);
  }
  ASSERT_EQ(sizes.size(), 10U);
  for (const char* none : {"sign", "swap", "scenario"}) EXPECT_EQ(sizes[none], std::set{0.0});
  for (const double factor : sizes["unit"])
    EXPECT_GE(std::abs(std::log(factor)), std::log(2.0)) << factor;
  for (const char* drawn : {"lag", "instrument", "clip", "freeze", "lost", "range"})
    EXPECT_EQ(sizes[drawn].size(), 20U) << drawn;
  for (const char* share : {"clip", "freeze", "lost"})
    EXPECT_LT(*sizes[share].rbegin(), 1) << share;
  for (const char* late : {"lag", "instrument"}) EXPECT_GE(*sizes[late].begin(), 3e-3) << late;
}

}  // namespace
}  // namespace ambrig
