// The order in which the records of a case are simulated side by side.
#include "discovery/model/record_order.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

#include "discovery/model/in_parallel.h"

namespace ambrig {
namespace {

CaseRecord Lasting(StartState start, double seconds) {
  CaseRecord r;
  r.scenario.start = start;
  r.scenario.duration = seconds;
  return r;
}

// A hovering rotor is simulated a quarter of a second before its record, one in contact costs more.
TEST(RecordOrder, TheLongestToSimulateIsTheFirst) {
  Case c;
  c.records = {Lasting(StartState::kClamped, 0.6), Lasting(StartState::kLevitated, 0.4),
               Lasting(StartState::kResting, 0.3), Lasting(StartState::kClamped, 0.6)};
  EXPECT_EQ(LongestFirst(c, {0, 0, 1, 0}), (std::vector<std::size_t>{2, 1, 0, 3}));
  EXPECT_EQ(LongestFirst(c, {0, 0, 0, 0}), (std::vector<std::size_t>{1, 0, 3, 2}));
}

TEST(InParallel, EveryPieceIsDoneOnce) {
  std::vector<int> done(1000, 0);
  InParallel(done.size(), [&](std::size_t k) { ++done[k]; });
  EXPECT_EQ(done, std::vector<int>(1000, 1));
  InParallel(0, [](std::size_t) { FAIL(); });
}

TEST(InParallel, AnExceptionComesThrough) {
  std::atomic<int> done = 0;
  const auto work = [&](std::size_t k) {
    ++done;
    if (k == 3) throw std::runtime_error("piece 3");
  };
  EXPECT_THROW(InParallel(10, work), std::runtime_error);
  EXPECT_GE(done, 1);
}

}  // namespace
}  // namespace ambrig
