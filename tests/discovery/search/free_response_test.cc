// Spectra of a free rotor's records: what noise alone makes of a line.
#include "discovery/search/free_response.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math/noise.h"
#include "core/record/channels.h"
#include "discovery/experiment/examination.h"
#include "rig/rig_file.h"

namespace ambrig {
namespace {

constexpr double kLineNoise = 2e-7;  // [m]

/// Levitated records without loads in which nothing moves: constant currents, readings of white
/// noise.
Case RestingRecords() {
  RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  for (BearingParameters& b : rig.bearings) b.sensor.noise = kLineNoise;
  Case c = EmptyCase(rig, Examination(rig, 1));
  std::uint64_t draw = 0;
  for (CaseRecord& r : c.records)
    for (Channel& channel : r.data.channels) {
      const auto id = ParseChannel(channel.name);
      for (double& v : channel.samples) {
        v = id && id->kind == ChannelKind::kCoilCurrent ? 2.0 : 0.0;
        if (id && id->kind == ChannelKind::kReading) v = kLineNoise * Normal(9, 1, draw++);
      }
    }
  return c;
}

// Both directions together have the power of x and of y: 12 sigma^2/n of each line, with Hann's
// window 1 - cos of mean square 1.5 and lines of 2/n times the sum.
TEST(FreeResponse, TheScaleOfALineIsThatOfTheNoise) {
  const Case c = RestingRecords();
  CaseModel model(c);
  for (Target& t : model.targets()) t.floor = kLineNoise;
  const auto responses = FreeResponses(model, Hypothesis::Base(c.rig));
  ASSERT_FALSE(responses.empty());
  double seen = 0, said = 0, lines = 0;
  for (const FreeResponse& r : responses)
    for (std::size_t b = 0; b < 2; ++b)
      for (std::size_t k = 0; k < r.w.size(); ++k) {
        if (r.w[k] < 1500)
          continue;  // below, the noise moves the shaft by the forces that it seems to make
        seen += std::norm(r.missing[b][k]);
        said += r.scale[b][k] * r.scale[b][k];
        ++lines;
      }
  ASSERT_GT(lines, 1000);
  EXPECT_NEAR(said / seen, 1, 0.15);
}

// A speed that begins to change within the record, be it at its last row, is no constant one.
TEST(FreeResponse, OnlyRecordsAtConstantSpeedAreUsed) {
  Case c = RestingRecords();
  const CaseModel steady(c);
  EXPECT_FALSE(FreeResponses(steady, Hypothesis::Base(c.rig)).empty());
  for (CaseRecord& r : c.records) {
    const double last = r.data.TimeAt(r.data.rows() - 1), step = 1 / r.data.rate;
    r.scenario.speed = SpeedProfile(
        std::vector<std::vector<double>>{{0, 300}, {last - 0.5 * step, 300}, {last, 310}});
  }
  const CaseModel changing(c);
  EXPECT_TRUE(FreeResponses(changing, Hypothesis::Base(c.rig)).empty());
}

}  // namespace
}  // namespace ambrig
