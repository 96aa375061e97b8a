// Numbers go up by one, a listener that was away catches up, one that was away too long is told so.
#include "workbench/event_log.h"

#include <gtest/gtest.h>

#include <thread>

namespace ambrig::workbench {
namespace {

using std::chrono::milliseconds;

TEST(EventLog, CatchesUp) {
  EventLog log;
  for (int k = 1; k <= 3; ++k) log.Add({{"event", "x"}, {"k", k}});
  std::uint64_t seq = 1;
  EXPECT_EQ(log.After(&seq, milliseconds(0)),
            "{\"event\":\"x\",\"k\":2,\"seq\":2}\n{\"event\":\"x\",\"k\":3,\"seq\":3}\n");
  EXPECT_EQ(seq, 3u);
  EXPECT_EQ(log.After(&seq, milliseconds(1)), "{\"event\":\"beat\"}\n");
}

TEST(EventLog, TellsWhatItForgot) {
  EventLog log;
  for (int k = 0; k < 10000; ++k) log.Add({{"event", "x"}});
  std::uint64_t seq = 5;
  EXPECT_EQ(log.After(&seq, milliseconds(0)), "{\"event\":\"resync\",\"seq\":10000}\n");
  seq = 123456;  // of another server
  EXPECT_EQ(log.After(&seq, milliseconds(0)), "{\"event\":\"resync\",\"seq\":10000}\n");
  EXPECT_EQ(seq, 10000u);
}

TEST(EventLog, WakesWhoWaits) {
  EventLog log;
  std::uint64_t seq = 0;
  std::string heard, ended = "x";
  std::thread listener([&] {
    heard = log.After(&seq, milliseconds(20000));
    ended = log.After(&seq, milliseconds(20000));
  });
  log.Add({{"event", "x"}});
  while (log.last() < 1) std::this_thread::yield();
  log.Close();
  listener.join();
  EXPECT_EQ(ended, "");
  EXPECT_TRUE(heard.empty() ||
              heard == "{\"event\":\"x\",\"seq\":1}\n");  // closed before it looked
}

}  // namespace
}  // namespace ambrig::workbench
