// Starts of effects are scored the same whether many are asked for or one.
#include "discovery/search/start_search.h"

#include <gtest/gtest.h>

#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

TEST(StartSearch, ManyStartsAreScoredAsEachAlone) {
  const LinearCase c({2e-5, 4e-5, 6e-5, 5e-5}, 1.08, 0);
  const FitResult base = c.Base();
  const StartSearch search(c.model, base, 300);
  std::vector<SimulatedStart> all;
  for (int k = 0; k < 70; ++k) all.push_back({LinearCase::Gain(1 + 0.002 * k)});
  search.Simulate(all);
  for (std::size_t k = 0; k < all.size(); ++k) {
    std::vector<SimulatedStart> one = {{all[k].effect}};
    search.Simulate(one);
    EXPECT_EQ(all[k].score, one[0].score) << k;
    EXPECT_TRUE(std::isfinite(all[k].score)) << k;
  }
}

}  // namespace
}  // namespace ambrig
