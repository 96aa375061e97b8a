// A column that is zero outside its stretches, against the same column written out.
#include "discovery/model/stretch_column.h"

#include <gtest/gtest.h>

namespace ambrig {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

TEST(StretchColumn, IsTheColumnWrittenOut) {
  VectorXd all = VectorXd::Zero(20), others = VectorXd::LinSpaced(20, -1, 3);
  StretchColumn column(20);
  for (const auto& [first, count] : {std::pair<Index, Index>{2, 4}, {6, 1}, {11, 5}}) {
    all.segment(first, count) = VectorXd::LinSpaced(count, 1, 2.5);
    column.Append(first, all.segment(first, count));
  }
  const StretchColumn dense(all);
  for (const StretchColumn& c : {column, dense}) {
    EXPECT_EQ(c.rows(), 20);
    for (Index first = 0; first <= 20; ++first)
      for (Index count = 0; first + count <= 20; ++count) {
        const VectorXd part = all.segment(first, count);
        EXPECT_EQ(c.Segment(first, count), part) << first << ", " << count;
        EXPECT_NEAR(c.SquaredNorm(first, count), part.squaredNorm(), 1e-12);
        EXPECT_NEAR(c.Dot(first, count, others), part.dot(others.segment(first, count)), 1e-12);
      }
  }
}

TEST(StretchColumn, WithoutStretchesIsZero) {
  const StretchColumn none(7);
  EXPECT_TRUE(none.Segment(0, 7).isZero(0));
  EXPECT_EQ(none.SquaredNorm(2, 5), 0);
  EXPECT_EQ(StretchColumn().rows(), 0);
}

}  // namespace
}  // namespace ambrig
