#include "fdd/learning/commissioning_file.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>

#include "core/base/errors.h"
#include "tests/fdd/stator_bench.h"

namespace ambrig {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

CommissionedBearing Learnt() {
  const LinkageModel m = MakeLinkageModel(testing_bench::Reference());
  CommissionedBearing b = NominalBearing("A", m);
  b.learnt = true;
  b.grade = 0.125;
  b.rows = 17;
  b.learnt_on = ContentHashOf(m, testing_bench::Bridge());
  b.circuit.dx = 1.25e-6;
  b.circuit.run_out = {{1e-6, -2e-6, 0, 1.0 / 3}, {0, 4e-6, 5e-7, 0}};
  b.circuit.relaxation = {0.1, 0.2, 0.3, 4.0 / 3};
  b.pattern = 0.004;
  for (int j = 0; j < kLanes; ++j) {
    b.coils.gain[j] = 1 + (j % 2 ? -0.01 : 0.01) / (j + 3);
    b.coils.offset[j] = 0.3 * (j - 2) / 7;
    b.largest_flux[j] = 3 + j;
    b.current_error[j] = 0.1 * j;
    for (int w = 0; w < kExcessWindows; ++w) b.largest[w][j] = 0.01 * w + 0.001 * j;
  }
  return b;
}

std::string Written(const std::string& text) {
  const std::string file =
      ::testing::TempDir() + "/" + std::to_string(::getpid()) + "_x.commissioning.toml";
  std::ofstream(file) << text;
  return file;
}

TEST(CommissioningFile, ComesBackAsItWasWritten) {
  const CommissionedBearing b = Learnt();
  const std::string file = Written(CommissioningText({{}, {b}}));
  const CommissionedBearing c = ReadCommissionedBearing(
      file, "A", MakeLinkageModel(testing_bench::Reference()), testing_bench::Bridge());
  EXPECT_TRUE(c.usable());
  EXPECT_EQ(c.circuit.dx, b.circuit.dx);
  EXPECT_EQ(c.circuit.relaxation, b.circuit.relaxation);
  EXPECT_EQ(c.circuit.run_out.x, b.circuit.run_out.x);
  EXPECT_EQ(c.circuit.run_out.y, b.circuit.run_out.y);
  EXPECT_EQ(c.pattern, b.pattern);
  for (int j = 0; j < kLanes; ++j) {
    EXPECT_EQ(c.coils.gain[j], b.coils.gain[j]);
    EXPECT_EQ(c.coils.leakage[j], b.coils.leakage[j]);
    EXPECT_EQ(c.coils.offset[j], b.coils.offset[j]);
    EXPECT_EQ(c.largest_flux[j], b.largest_flux[j]);
    for (int w = 0; w < kExcessWindows; ++w) EXPECT_EQ(c.largest[w][j], b.largest[w][j]);
  }
}

TEST(CommissioningFile, SaysOfWhichMachineItIs) {
  CommissionedModel model{{}, {Learnt()}};
  model.machine = {true,
                   14,
                   true,
                   {{"bearings.A.gap", "0123abcd", "A"}},
                   {{"eddy-currents at A", "89abcdef", "A"}}};
  const MachineIdentity read = ReadCommissioning(Written(CommissioningText(model))).machine;
  EXPECT_TRUE(read.known);
  EXPECT_EQ(read.unit, 14);
  ASSERT_EQ(read.fitted.size(), 1u);
  EXPECT_EQ(read.fitted[0].name, "bearings.A.gap");
  EXPECT_EQ(read.fitted[0].hash, "0123abcd");
  ASSERT_EQ(read.effects.size(), 1u);
  EXPECT_EQ(read.effects[0].name, "eddy-currents at A");
  EXPECT_EQ(read.effects[0].hash, "89abcdef");
}

TEST(CommissioningFile, OfAnotherRigIsRefused) {
  const std::string file = Written(CommissioningText({{}, {Learnt()}}));
  RadialStatorParameters other = testing_bench::Reference();
  other.turns += 1;
  try {
    ReadCommissionedBearing(file, "A", MakeLinkageModel(other), testing_bench::Bridge());
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("run ambrig commission again"));
  }
}

TEST(CommissioningFile, ABearingWithoutAnEntryIsNominal) {
  const std::string file = Written(CommissioningText({{}, {Learnt()}}));
  EXPECT_FALSE(ReadCommissionedBearing(file, "B", MakeLinkageModel(testing_bench::Reference()),
                                       testing_bench::Bridge())
                   .learnt);
}

TEST(CommissioningFile, MistakesAreNamedWithTheirPlace) {
  std::string text = CommissioningText({{}, {Learnt()}});
  const auto at = text.find("gain = [");
  text.insert(at + 8, "7.0, ");
  try {
    ReadCommissioning(Written(text));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("gain"), HasSubstr("has 9 numbers, allowed: 8")));
  }
}

// Those of machines that are round do not have the keys, and neither had the files of earlier
// versions.
TEST(CommissioningFile, WithoutRunOutIsRead) {
  CommissionedBearing b = Learnt();
  b.circuit.run_out = {};
  const std::string text = CommissioningText({{}, {b}});
  EXPECT_EQ(text.find("run_out"), std::string::npos);
  EXPECT_TRUE(ReadCommissioning(Written(text)).bearings[0].circuit.run_out.none());
}

TEST(CommissioningFile, RunOutOfOneOrderIsRefused) {
  std::string text = CommissioningText({{}, {Learnt()}});
  const auto at = text.find("run_out_y = [") + 13;
  text.replace(at, text.find(']', at) - at, "1e-6, 2e-6");
  try {
    ReadCommissioning(Written(text));
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("run_out_y"), HasSubstr("has 2 numbers, allowed: 4")));
  }
}

}  // namespace
}  // namespace ambrig
