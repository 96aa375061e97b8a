// A logger that loses samples must not make a healthy block look wrong.
#include "discovery/model/blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "rig/rig_assembly.h"
#include "rig/rig_file.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {
namespace {

constexpr double kBlocksNan = std::numeric_limits<double>::quiet_NaN();

class Blocks : public ::testing::Test {
 protected:
  Blocks() : rig_(ReadRig(AMBRIG_SOURCE_DIR "/scenarios/library/rigs/reference.toml")) {
    scenario_.duration = 0.05;
    scenario_.seed = 4;
    EngineOptions options;
    options.record_rate = 12500;
    record_ = SwitchingEngine(rig_, scenario_, options).Run().record;
  }
  std::vector<double>& Samples(const std::string& name) {
    for (Channel& c : record_.channels)
      if (c.name == name) return c.samples;
    throw std::runtime_error("no channel " + name);
  }
  BlockErrors Errors() const { return BlockRms(rig_, rig_, scenario_, record_); }

  RigParameters rig_;
  Scenario scenario_;
  Record record_;
};

TEST_F(Blocks, ALostSampleChangesLittle) {
  const BlockErrors whole = Errors();
  ASSERT_TRUE(whole.contains("coil") && whole.contains("controller") && whole.contains("rotor"));
  Samples("B.x")[200] = kBlocksNan;
  Samples("A.s3")[350] = kBlocksNan;
  Samples("A.i5")[450] = kBlocksNan;
  const BlockErrors holed = Errors();
  ASSERT_EQ(holed.size(), whole.size());
  // An exact controller has no error at all: 1e-4 (A, N) is where compare begins to count
  // (discovery/model/block_ratios.cc).
  for (const auto& [block, error] : whole)
    EXPECT_NEAR(holed.at(block), error, 0.2 * std::max(error, 1e-4)) << block;
}

// The recorded set-points are those of the controller with the recorded readings: nothing is left
// but the rounding of the record, and a constant in the readings, which the integral would take up,
// is none of the controller's.
TEST_F(Blocks, TheControllerThatWroteTheRecordHasNoError) {
  EXPECT_LT(Errors().at("controller"), 1e-6);
  for (double& v : Samples("A.s3")) v += 0.1;
  const double shifted = Errors().at("controller");
  EXPECT_LT(shifted,
            0.02);  // a constant force is no error, a coil is a sixteenth of the errors' squares
  for (std::size_t k = 0; k < Samples("A.s3").size(); k += 2) Samples("A.s3")[k] += 0.4;
  EXPECT_GT(Errors().at("controller"), 0.02);
}

// The errors are judged about their mean: of one row after the 30 that settle nothing is left,
// whatever its set-points.
TEST_F(Blocks, TheMeanOfTheControllersErrorIsNoError) {
  for (Channel& c : record_.channels) c.samples.resize(33);
  for (const int coil : {1, 3, 5}) Samples("A.s" + std::to_string(coil)).back() += 0.1 * coil;
  EXPECT_LT(Errors().at("controller"), 1e-9);
}

// Of a short record the first quarter settles the loops, the rest is judged.
TEST_F(Blocks, AShortRecordIsJudgedToo) {
  for (Channel& c : record_.channels) c.samples.resize(40);
  EXPECT_TRUE(Errors().contains("coil"));
}

// 5 um at 100 Hz of a shaft of 4 kg want 4 N at each bearing, which no current of the record gives.
TEST_F(Blocks, AForceAlongEitherAxisIsTheRotors) {
  const Record healthy = record_;
  const double before = Errors().at("rotor");
  for (const char* axis : {"A.x", "A.y"}) {
    record_ = healthy;
    std::vector<double>& y = Samples(axis);
    for (std::size_t k = 0; k < y.size(); ++k)
      y[k] += 5e-6 * std::sin(2 * 3.14159265 * 100 * static_cast<double>(k) / record_.rate);
    EXPECT_GT(Errors().at("rotor"), before + 0.1) << axis;
  }
}

TEST_F(Blocks, ATrulyWrongReadingStillShows) {
  const double healthy = Errors().at("coil");
  Samples("B.x")[200] = kBlocksNan;
  for (double& v : Samples("A.s3")) v *= 1.2;
  EXPECT_GT(Errors().at("coil"), 3 * healthy);
}

}  // namespace
}  // namespace ambrig
