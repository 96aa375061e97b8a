// Work that would end the process ends its copy.
#include "core/base/trial_copy.h"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>

namespace ambrig {
namespace {

TEST(TrialCopy, OnlyASignalIsAnEnd) {
  EXPECT_TRUE(SurvivesInACopy([] {}));
  EXPECT_TRUE(SurvivesInACopy([] { throw std::runtime_error("said by the call itself"); }));
  EXPECT_FALSE(SurvivesInACopy([] { std::raise(SIGKILL); }));
  EXPECT_FALSE(SurvivesInACopy([] { std::abort(); }));
}

TEST(TrialCopy, ChangesNothingHere) {
  int value = 1;
  EXPECT_TRUE(SurvivesInACopy([&] { value = 2; }));
  EXPECT_EQ(value, 1);
}

}  // namespace
}  // namespace ambrig
