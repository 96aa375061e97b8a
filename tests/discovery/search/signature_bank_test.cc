// Signatures of probes of a linear reading and their products, in closed form, however many are asked for at once.
#include "discovery/search/signature_bank.h"

#include <gtest/gtest.h>

#include "tests/discovery/linear_case.h"

namespace ambrig {
namespace {

// One group of 30 probes is more than a chunk holds, and is simulated all the same; five smaller ones follow.
// signature = (gain - 1) x/floor in every row of A.x, so that the products are sums of squares of x.
TEST(SignatureBank, AGroupLargerThanAChunkIsSimulated) {
  const LinearCase c({2e-5, 4e-5, 6e-5, 5e-5}, 1.08, 0);
  std::vector<ProbeGroup> groups(6);
  std::vector<double> gains;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (int k = 0; k < (g == 0 ? 30 : 7); ++k) {
      gains.push_back(1.01 + 0.001 * static_cast<double>(gains.size()));
      groups[g].probes.push_back(LinearCase::Gain(gains.back()));
      groups[g].rows.push_back(0);
    }
  SignatureBank bank;
  bank.Simulate(c.model, c.Base(), groups, nullptr);
  ASSERT_EQ(bank.entries().size(), groups.size());
  EXPECT_EQ(bank.entries()[0].count(), 30);
  for (std::size_t g = 1; g < groups.size(); ++g) {
    EXPECT_EQ(bank.entries()[g].count(), 7);
    EXPECT_EQ(bank.entries()[g].first, 30 + 7 * (static_cast<Eigen::Index>(g) - 1));
  }
  double fitted = 0;
  for (std::size_t r = 0; r < c.fit_records(); ++r)
    fitted += LinearCase::kRows * c.x[r] * c.x[r] / LinearCase::kFloor / LinearCase::kFloor;
  const double unseen =
      LinearCase::kRows * c.x.back() * c.x.back() / LinearCase::kFloor / LinearCase::kFloor;
  const Gram& products = bank.Products(c.model);
  const auto n = static_cast<Eigen::Index>(gains.size());
  ASSERT_EQ(products.fit.rows(), n);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b) {
      const double both =
          (gains[static_cast<std::size_t>(a)] - 1) * (gains[static_cast<std::size_t>(b)] - 1);
      EXPECT_NEAR(products.fit(a, b), both * fitted, 1e-4 * both * fitted);
      EXPECT_NEAR(products.validate(a, b), both * unseen, 1e-4 * both * unseen);
    }
}

}  // namespace
}  // namespace ambrig
