// One record of a machine that nobody stated among those of the rig.
#include "discovery/explain/record_of_other_machine.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

/// Three records of the rig, the last of them measured on `other`.
Case ThreeRecords(const RigParameters& other) {
  const RigParameters rig = testing::RadialRig();
  std::vector<ExaminationRecord> chosen;
  for (const ExaminationRecord& r : Examination(rig, 4))
    if (!r.burst && !r.title.starts_with("clamped") && chosen.size() < 3) chosen.push_back(r);
  Hypothesis truth, of_other;
  truth.rig = rig;
  of_other.rig = other;
  Case c = testing::MeasuredBy(truth, EmptyCase(rig, chosen));
  c.records[2] = testing::MeasuredBy(of_other, EmptyCase(rig, chosen)).records[2];
  for (CaseRecord& r : c.records) r.validate = false;
  return c;
}

/// The answer of a search to which the last record stays a riddle.
Explanation Unknown(const Case& c, double ratio) {
  Explanation e;
  e.verdict = ExplanationVerdict::kUnknown;
  e.remainder.where = {{c.records[2].data_file, "A.x", ratio}};
  return e;
}

TEST(RecordOfOtherMachine, IsNamedWithWhatItsMachineHas) {
  RigParameters other = testing::RadialRig();
  ASSERT_TRUE(SetParameter(other, "bearings.A.gap", 1.1 * *ParameterAt(other, "bearings.A.gap")));
  const Case c = ThreeRecords(other);
  Explanation e = Unknown(c, 8);
  const auto fault = RecordOfOtherMachine(c, e);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->record, c.records[2].data_file);
  EXPECT_NE(FaultText(*fault).find("bearings.A.gap"), std::string::npos) << FaultText(*fault);
  BelieveFault(*fault, e);
  EXPECT_EQ(e.verdict, ExplanationVerdict::kData);
  EXPECT_EQ(e.set[0].effect, "data");
  EXPECT_FALSE(RecordOfOtherMachine(c, e)) << "only of what is unknown";
}

TEST(RecordOfOtherMachine, AnErrorThatNoParameterMakesIsNone) {
  Case c = ThreeRecords(testing::RadialRig());
  EXPECT_FALSE(RecordOfOtherMachine(c, Unknown(c, 8)));
  for (Channel& channel : c.records[2].data.channels)
    if (channel.name == "A.x")
      for (std::size_t k = 0; k < channel.samples.size(); ++k)
        channel.samples[k] += 5e-6 * std::sin(0.03 * static_cast<double>(k * k % 40000));
  EXPECT_FALSE(RecordOfOtherMachine(c, Unknown(c, 8)));
  EXPECT_FALSE(RecordOfOtherMachine(c, Unknown(c, 2))) << "it hardly shows";
}

}  // namespace
}  // namespace ambrig
