// Errors that are large, few and together, written into the noise of one channel.
#include "discovery/search/burst_rows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/noise.h"
#include "tests/discovery/measured_case.h"

namespace ambrig {
namespace {

class BurstRowsTest : public ::testing::Test {
 protected:
  static std::vector<double> White(std::size_t rows) {
    std::vector<double> r(rows);
    for (std::size_t k = 0; k < rows; ++k) r[k] = Normal(9, 0, k);
    return r;
  }
  /// A decay of `size` floors over `rows` rows of a channel from its row 100 on.
  void Burst(std::size_t target, double size, std::size_t rows) {
    for (std::size_t k = 0; k < rows; ++k)
      residual_[model_.targets()[target].first + 100 + k] +=
          size * std::exp(-3.0 * static_cast<double>(k) / static_cast<double>(rows));
  }

  const Case data_ = MeasuredCase({{2e-5, 3e-5}, {-6e-5, 1e-5}, {5e-5, -4e-5}});
  CaseModel model_{data_};
  std::vector<double> residual_ = White(model_.size());
};

TEST_F(BurstRowsTest, NoiseHasNone) {
  EXPECT_TRUE(BurstRows(model_, residual_, Which::kAll).empty());
}

// From 1 ms (13 rows at 12.5 kHz) before the first error beyond six floors.
TEST_F(BurstRowsTest, ADecayIsOneSpanOfItsRecord) {
  const Target& t = model_.targets()[5];
  ASSERT_EQ(t.record, 1U);
  ASSERT_GE(t.count, 300U);
  Burst(5, 60, 12);  // ten rows above six floors
  const auto spans = BurstRows(model_, residual_, Which::kAll);
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_EQ(spans[0].record, 1U);
  EXPECT_EQ(spans[0].first, 87U);
  EXPECT_NEAR(static_cast<double>(spans[0].last), 100 + 9 + 13, 2);
  const Which other = data_.records[1].validate ? Which::kFit : Which::kValidate;
  EXPECT_TRUE(BurstRows(model_, residual_, other).empty());
}

// A channel that is wrong in a fifth of its rows is wrong, not on another branch for an instant.
TEST_F(BurstRowsTest, ALongErrorIsNone) {
  Burst(5, 60, model_.targets()[5].count / 5);
  EXPECT_TRUE(BurstRows(model_, residual_, Which::kAll).empty());
}

// Beside an error that fills other channels a burst is not what matters.
TEST_F(BurstRowsTest, WhereMostOfTheErrorIsElsewhereThereIsNone) {
  Burst(5, 60, 20);
  const Target& t = model_.targets()[2];
  for (std::size_t k = t.first; k < t.first + t.count; ++k) residual_[k] *= 12;
  EXPECT_TRUE(BurstRows(model_, residual_, Which::kAll).empty());
}

TEST_F(BurstRowsTest, RowsThatAreLeftOutComeBack) {
  const std::vector<char> counted = model_.sound();
  model_.LeaveOut({{1, 90, 110}});
  EXPECT_NE(model_.ok(), counted);
  model_.SetSound(counted);
  EXPECT_EQ(model_.ok(), counted);
}

}  // namespace
}  // namespace ambrig
