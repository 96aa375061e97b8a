// Set-points that are clipped or held, and columns passed on round a circle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

using testing::ExpectOnly;
using testing::FaultsOf;
using testing::kStepRecord;
using testing::Measured;
using testing::SamplesOf;

// Set-points that a logger clips or holds, while the others of the bearing go on.
TEST(GateSetPoints, ASetPointThatIsClippedOrFreezesAlone) {
  for (const bool clip : {true, false}) {
    Case c = Measured();
    std::vector<double>& s = SamplesOf(c, kStepRecord, "A.s3");
    if (clip) {
      std::vector<double> sorted = s;
      std::sort(sorted.begin(), sorted.end());
      const double top = sorted[sorted.size() * 4 / 5];
      for (double& v : s) v = std::min(v, top);
    } else {
      std::fill_n(s.begin() + 2000, s.size() / 20, s[2000]);
    }
    SCOPED_TRACE(clip);
    ExpectOnly(FaultsOf(c), clip ? "clip" : "freeze", "A.s3");
  }
}

// Three columns that were passed on round a circle: each is named with what it shows.
TEST(GateSetPoints, ThreeColumnsRoundACircle) {
  Case c = Measured();
  std::vector<double>&a = SamplesOf(c, kStepRecord, "A.i1"), &b = SamplesOf(c, kStepRecord, "A.i3"),
  &d = SamplesOf(c, kStepRecord, "A.i5");
  std::swap(a, b);  // A.i1 shows A.i3, A.i3 shows A.i5, A.i5 shows A.i1
  std::swap(b, d);
  const auto faults = FaultsOf(c);
  ASSERT_EQ(faults.size(), 3U);
  for (const DataFault& f : faults) {
    EXPECT_EQ(f.fault, "swap") << FaultText(f);
    EXPECT_EQ(f.with, f.channel == "A.i1" ? "A.i3" : f.channel == "A.i3" ? "A.i5" : "A.i1");
    EXPECT_EQ(f.mend, "channels.\"" + f.with + "\" = \"" + f.channel + "\"");
  }
}

}  // namespace
}  // namespace ambrig
