// Time columns: names, units, uniform steps, and what is wrong with those that are not.
#include "core/record/time_base.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/base/errors.h"
#include "core/base/parameters.h"
#include "tests/core/temporary_folder.h"

namespace ambrig {
namespace {

using testing::ErrorText;
using ::testing::HasSubstr;

TEST(TimeNames, AreKnownWithTheirUnits) {
  for (const char* name : {"t", "T", "time", "Time (ms)", "t_us", "time (s)", "TIME_NS"})
    EXPECT_TRUE(IsTimeName(name)) << name;
  for (const char* name : {"temperature", "A.x", "tt", "timer", ""})
    EXPECT_FALSE(IsTimeName(name)) << name;
  EXPECT_EQ(TimeUnitOf("Time (ms)"), "ms");
  EXPECT_EQ(TimeUnitOf("t_us"), "us");
  EXPECT_EQ(TimeUnitOf("time_s"), "s");
  EXPECT_EQ(TimeUnitOf("t"), "");
}

std::vector<double> Times(double start, double step, int n) {
  std::vector<double> t;
  for (int k = 0; k < n; ++k) t.push_back(start + step * k);
  return t;
}

// A rate that was a short number before its period was rounded comes back as such.
TEST(UniformTimes, GiveRateAndStart) {
  const TimeBase b = UniformTimeBase(Times(0.25, 1.0 / 12500, 1000), "f");
  EXPECT_EQ(b.rate, 12500);
  EXPECT_EQ(b.start, 0.25);
  std::vector<double> few = Times(0, 1.0 / 3, 100);
  for (double& t : few) t = std::round(t * 100) / 100;  // two digits after the point
  EXPECT_NEAR(UniformTimeBase(few, "f").rate, 3, 0.01);
}

TEST(UniformTimes, NameTheFirstRowThatIsWrong) {
  const auto message = [](std::vector<double> t) {
    return ErrorText<InputError>([&] { UniformTimeBase(t, "f.csv", 1); });
  };
  std::vector<double> t = Times(0, 1e-3, 50);
  t[20] = std::nan("");
  EXPECT_THAT(message(t), HasSubstr("f.csv: row 22: time"));
  t = Times(0, 1e-3, 50);
  t[30] = t[29];
  EXPECT_THAT(message(t), HasSubstr("row 32: time 0.029 s does not increase"));
  t = Times(0, 1e-3, 50);
  for (std::size_t k = 10; k < 50; ++k) t[k] += 5e-3;  // a gap
  EXPECT_THAT(message(t), HasSubstr("row 12: time 0.015 s is not uniform: step 0.00"));
  EXPECT_THAT(message({1.0}), HasSubstr("at least two rows"));
}

Record TwoChannels() {
  Record r;
  r.channels = {{"time_ms", "", {0, 0.5, 1.0, 1.5}}, {"A.x", "m", {1, 2, 3, 4}}};
  return r;
}

TEST(FinishRecord, TakesTheTimeChannelAway) {
  Record r = TwoChannels();
  FinishRecord(r, "f");
  EXPECT_NEAR(r.rate, 2000, 1e-9);
  EXPECT_EQ(r.start, 0);
  ASSERT_EQ(r.channels.size(), 1u);
  EXPECT_EQ(r.channels[0].name, "A.x");
}

TEST(FinishRecord, RefusesWhatContradicts) {
  const auto message = [](Record r) {
    return ErrorText<InputError>([&] { FinishRecord(r, "f"); });
  };
  Record r = TwoChannels();
  r.rate = 1000;
  EXPECT_THAT(message(r), HasSubstr("f: rate = 1000 Hz, but time_ms has 2000 Hz"));
  r.rate = 2000.5;  // within a thousandth
  EXPECT_EQ(message(r), "");
  r = TwoChannels();
  r.channels[1].samples.pop_back();
  EXPECT_THAT(message(r), HasSubstr("channel A.x has 3 rows, time_ms has 4"));
  r = TwoChannels();
  r.channels.push_back(r.channels[1]);
  EXPECT_THAT(message(r), HasSubstr("channel A.x is there twice"));
  r = TwoChannels();
  r.channels.erase(r.channels.begin());
  EXPECT_THAT(message(r), HasSubstr("neither a rate [Hz] nor a time channel"));
  r.rate = -5;
  EXPECT_THAT(message(r), HasSubstr("must be positive"));
  r.rate = 5;
  r.start = kInfinity;
  EXPECT_THAT(message(r), HasSubstr("must be finite"));
  EXPECT_THAT(message({}), HasSubstr("no channels"));
}

}  // namespace
}  // namespace ambrig
