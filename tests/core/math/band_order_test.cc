// Orders of unknowns that make a band narrow.
#include "core/math/band_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace ambrig {
namespace {

// A chain of unknowns numbered at random is a band of one again; two chains, tied at two places,
// one of two to three.
TEST(BandOrder, FindsTheChain) {
  const int n = 60;
  std::vector<int> name(n);
  std::iota(name.begin(), name.end(), 0);
  std::shuffle(name.begin(), name.end(), std::mt19937_64(3));
  Neighbours chain(n);
  const auto tie = [&](int a, int b) {
    chain[name[a]].push_back(name[b]);
    chain[name[b]].push_back(name[a]);
  };
  for (int k = 0; k + 1 < n; ++k) tie(k, k + 1);
  EXPECT_EQ(BandWidth(chain, BandOrder(chain, 0)), 1);
  tie(0, n / 2);
  tie(n / 2 - 1, n - 1);
  EXPECT_LE(BandWidth(chain, BandOrder(chain, 0)), 4);
  std::vector<int> sorted = BandOrder(chain, 0);
  std::sort(sorted.begin(), sorted.end());
  for (int k = 0; k < n; ++k) EXPECT_EQ(sorted[k], k);  // every place once
}

TEST(BandOrder, LeavesWhatIsNarrowEnough) {
  const Neighbours pair = {{2}, {}, {0}};
  EXPECT_EQ(BandOrder(pair, 2), (std::vector{0, 1, 2}));
  EXPECT_EQ(BandWidth(pair, BandOrder(pair, 1)), 1);
}

}  // namespace
}  // namespace ambrig
