#include "campaign/parameter_draw.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace ambrig {
namespace {

/// Every one of n equal slices of every dimension holds one point.
void ExpectStratified(const UnitPoints& points, std::size_t dimensions) {
  for (std::size_t d = 0; d < dimensions; ++d) {
    std::set<std::size_t> slices;
    for (const auto& p : points)
      slices.insert(static_cast<std::size_t>(p[d] * static_cast<double>(points.size())));
    EXPECT_EQ(slices.size(), points.size()) << "dimension " << d;
  }
}

TEST(ParameterDraw, LatinHypercubeHasOnePointInEverySlice) {
  ExpectStratified(LatinHypercube(37, 11, 5), 11);
}

TEST(ParameterDraw, SobolHasOnePointInEverySlice) {
  ExpectStratified(Sobol(256, kSobolDimensions, 7), kSobolDimensions);
}

// Joe and Kuo's directions give pairs of dimensions a (t, 6, 2)-net of small t: most of the
// 8 x 8 boxes hold a point already at 64 points for the first dimensions.
TEST(ParameterDraw, SobolFillsThePlaneOfItsFirstDimensions) {
  std::set<int> boxes;
  for (const auto& p : Sobol(64, 2, 3))
    boxes.insert(static_cast<int>(p[0] * 8) * 8 + static_cast<int>(p[1] * 8));
  EXPECT_EQ(boxes.size(), 64u);
}

TEST(ParameterDraw, SeedsGiveOtherPointsAndTheSameSeedTheSame) {
  EXPECT_EQ(LatinHypercube(8, 3, 1), LatinHypercube(8, 3, 1));
  EXPECT_NE(LatinHypercube(8, 3, 1), LatinHypercube(8, 3, 2));
  EXPECT_NE(Sobol(8, 3, 1), Sobol(8, 3, 2));
}

}  // namespace
}  // namespace ambrig
