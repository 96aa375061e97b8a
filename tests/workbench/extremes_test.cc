// Thinned series against brute force: the least and greatest of every column, however views and
// gaps lie.
#include "workbench/extremes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ambrig::workbench {
namespace {

/// Of samples [from, to) by the definition.
Extreme BruteForce(const std::vector<float>& samples, std::size_t from, std::size_t to) {
  Extreme e{NAN, NAN};
  for (std::size_t k = from; k < to; ++k) {
    if (std::isnan(samples[k])) continue;
    const float v = samples[k];
    if (!(e.lo <= v)) e.lo = v;
    if (!(e.hi >= v)) e.hi = v;
  }
  return e;
}

bool Same(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

TEST(Extremes, AreThoseOfBruteForce) {
  std::mt19937_64 random(7);
  std::normal_distribution<float> noise;
  for (int trial = 0; trial < 200; ++trial) {
    const std::size_t rows = random() % 5000;
    std::vector<float> samples(rows);
    for (float& s : samples) s = random() % 10 == 0 ? NAN : noise(random);
    if (rows > 300) std::fill(samples.begin() + 100, samples.begin() + 290, NAN);  // a long gap
    const std::size_t a = rows == 0 ? 0 : random() % rows,
                      b = rows == 0 ? 0 : random() % (rows + 1);
    const std::size_t first = std::min(a, b), last = std::max(a, b), columns = 1 + random() % 400;
    const ExtremesLevel level(samples);
    const auto thinned = ThinnedExtremes(samples, level, first, last, columns);
    ASSERT_EQ(thinned.size(), columns);
    for (std::size_t c = 0; c < columns; ++c) {
      const Extreme wanted = BruteForce(samples, first + (last - first) * c / columns,
                                        first + (last - first) * (c + 1) / columns);
      ASSERT_TRUE(Same(thinned[c].lo, wanted.lo) && Same(thinned[c].hi, wanted.hi))
          << trial << " column " << c;
    }
  }
}

// One sample of ten million that stands out is in the picture.
TEST(Extremes, LoseNoPeak) {
  std::vector<float> samples(10'000'000, 1.0F);
  samples[7'654'321] = 3;
  samples[1'234'567] = -2;
  const ExtremesLevel level(samples);
  float lo = 1, hi = 1;
  for (const Extreme& e : ThinnedExtremes(samples, level, 0, samples.size(), 1200)) {
    lo = std::min(lo, e.lo);
    hi = std::max(hi, e.hi);
  }
  EXPECT_EQ(lo, -2);
  EXPECT_EQ(hi, 3);
}

TEST(Extremes, OfNothingAreNone) {
  const std::vector<float> none;
  for (const Extreme& e : ThinnedExtremes(none, ExtremesLevel(none), 0, 10, 3))
    EXPECT_TRUE(std::isnan(e.lo) && std::isnan(e.hi));
}

}  // namespace
}  // namespace ambrig::workbench
