// What the caller of a search is told.
#include "discovery/explain/search_progress.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "core/base/errors.h"
#include "tests/discovery/explain/search_parts.h"

namespace ambrig {
namespace {

class SearchProgressTest : public testing::SearchParts {};

TEST_F(SearchProgressTest, OfAPartIsAPartOfTheWhole) {
  std::vector<double> fractions;
  options_.progress = [&](double f, const std::string&) { fractions.push_back(f); };
  progress_(0.25, "first");
  const auto part = progress_.Part(0.5, 0.2);
  part(0, "part");
  part(1, "part");
  ASSERT_EQ(fractions.size(), 3u);
  EXPECT_DOUBLE_EQ(fractions[1], 0.5);
  EXPECT_DOUBLE_EQ(fractions[2], 0.7);
  std::atomic<bool> stop = true;
  options_.stop = &stop;
  EXPECT_THROW(progress_(0.8, "next"), Interrupted);
}

}  // namespace
}  // namespace ambrig
