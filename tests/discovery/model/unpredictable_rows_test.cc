// Instants that noise decides, in noise that is written down.
#include "discovery/model/unpredictable_rows.h"

#include <gtest/gtest.h>

#include "core/math/noise.h"
#include "discovery/model/case_model.h"
#include "tests/discovery/measured_case.h"

namespace ambrig {
namespace {

class UnpredictableRowsTest : public ::testing::Test {
 protected:
  static std::vector<double> White(std::uint32_t seed, std::size_t rows) {
    std::vector<double> d(rows);
    for (std::size_t k = 0; k < rows; ++k) d[k] = 2e-7 * Normal(seed, 0, k);
    return d;
  }

  const Case data_ = MeasuredCase({{2e-5, 3e-5}, {-6e-5, 1e-5}, {5e-5, -4e-5}});
  CaseModel model_{data_};
  std::vector<double> d1_ = White(5, model_.size()), d2_ = White(6, model_.size());
};

// 4800 normal numbers, twice: one beyond five sd in 2000 such draws.
TEST_F(UnpredictableRowsTest, WhiteNoiseHasNone) {
  EXPECT_TRUE(UnpredictableRows(model_, d1_, d2_).empty());
}

// Three rows of one channel of the second record depart in one of the two runs: 0.5 ms before and
// after belong to them (seven rows at 12.5 kHz), in all channels of that record and in no other.
TEST_F(UnpredictableRowsTest, DepartureIsAnInstantOfItsRecord) {
  const Target& t = model_.targets()[5];
  ASSERT_EQ(t.record, 1u);
  for (std::size_t k = 100; k < 103; ++k) d2_[t.first + k] = 6e-6;
  const std::vector<SampleSpan> spans = UnpredictableRows(model_, d1_, d2_);
  ASSERT_EQ(spans.size(), 1u);
  EXPECT_EQ(spans[0].record, 1u);
  EXPECT_EQ(spans[0].first, 93u);
  EXPECT_EQ(spans[0].last, 109u);
  model_.LeaveOut(spans);
  for (const Target& o : model_.targets())
    for (std::size_t k = 0; k < o.count; ++k)
      EXPECT_EQ(model_.ok()[o.first + k] != 0, !(o.record == 1 && k >= 93 && k <= 109));
}

// A channel that is loud for a twentieth of the record is no instant.
TEST_F(UnpredictableRowsTest, LoudStretchIsNoise) {
  const Target& t = model_.targets()[5];
  for (std::size_t k = 100; k < 120; ++k) d2_[t.first + k] *= 30;
  EXPECT_TRUE(UnpredictableRows(model_, d1_, d2_).empty());
}

}  // namespace
}  // namespace ambrig
