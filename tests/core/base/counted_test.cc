#include "core/base/counted.h"

#include <gtest/gtest.h>

namespace ambrig {
namespace {

TEST(Counted, OneAndMany) {
  EXPECT_EQ(Counted(1, "scenario"), "1 scenario");
  EXPECT_EQ(Counted(std::size_t{0}, "scenario"), "0 scenarios");
  EXPECT_EQ(Counted(3L, "entry"), "3 entries");
  EXPECT_EQ(Counted(1, "entry"), "1 entry");
}

}  // namespace
}  // namespace ambrig
