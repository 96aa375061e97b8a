// Machines of one type, of which the rig file states how much their coils differ: none is taken for
// a machine with an effect.
#include "discovery/decision/unit_errors.h"

#include <gtest/gtest.h>

#include "discovery/decision/compare.h"
#include "discovery/model/residual.h"
#include "discovery/practice/practice_surroundings.h"
#include "effects/catalogue.h"
#include "tests/discovery/clamped_reference.h"

namespace ambrig {
namespace {

class UnitErrorsTest : public testing::ClampedReference {
 protected:
  /// Whether the records of a machine are within what others of its type show, and the errors of
  /// these.
  bool IsWithin(const RigParameters& machine, UnitErrors* errors = nullptr,
                std::string* said = nullptr) const {
    Hypothesis truth;
    truth.rig = machine;
    Case data = EmptyCase(rig_, records_);
    FillRecords(Surroundings(), truth, 5, nullptr, data);
    CaseModel model(data);
    const Hypothesis drawing = Hypothesis::Base(data.rig);
    const Comparison compared = Compare(model, drawing, false);
    if (said) *said = SaidOfCoils(model, drawing, compared.residual);
    const UnitErrors found = ErrorsOfUnits(model, ChangesOfUnits(model, drawing));
    if (errors) *errors = found;
    return IsWithinUnits(model, compared.residual, found);
  }
};

TEST_F(UnitErrorsTest, HoldAnotherMachineOfTheType) {
  RigParameters another = rig_;
  another.amplifier.unit = 77;
  UnitErrors errors;
  EXPECT_TRUE(IsWithin(another, &errors));
  EXPECT_GT(errors.largest, 1.05);  // they show
  EXPECT_FALSE(errors.most.empty());
}

// A comparison tells how much of its error the coils may make.
TEST_F(UnitErrorsTest, StandInTheWordsOfAComparison) {
  RigParameters machine = rig_;
  machine.amplifier.unit = 77;
  std::string said;
  IsWithin(machine, nullptr, &said);
  EXPECT_NE(said.find("nothing here is more"), std::string::npos) << said;
  EffectInstance gain = MakeInstance(EffectNamed("current-sensor-gain"), "A.coil3");
  gain.Set("gain", 1 + 8 * rig_.amplifier.current_gain_spread);
  machine.effects.push_back(gain);
  IsWithin(machine, nullptr, &said);
  EXPECT_NE(said.find("some channels show more"), std::string::npos) << said;
  IsWithin(rig_, nullptr, &said);
  EXPECT_EQ(said, "");  // nothing but noise is left
}

TEST_F(UnitErrorsTest, DoNotHoldAGainFarBeyondTheSpread) {
  RigParameters faulty = rig_;
  EffectInstance gain = MakeInstance(EffectNamed("current-sensor-gain"), "A.coil3");
  gain.Set("gain", 1 + 8 * rig_.amplifier.current_gain_spread);
  faulty.effects.push_back(gain);
  EXPECT_FALSE(IsWithin(faulty));
}

// A force on the shaft shows where no error of a coil does.
TEST_F(UnitErrorsTest, DoNotHoldAnEffectOfTheRotor) {
  records_.clear();
  for (const ExaminationRecord& r : Examination(rig_, 3))
    if (r.title.starts_with("steps")) records_.push_back(r);
  ASSERT_FALSE(records_.empty());
  RigParameters another = rig_;
  another.amplifier.unit = 77;
  EXPECT_TRUE(IsWithin(another));
  EffectInstance coupling = MakeInstance(EffectNamed("cross-coupling"), "A");
  coupling.Set("stiffness", 2e4);
  another.effects.push_back(coupling);
  EXPECT_FALSE(IsWithin(another));
}

// Without a spread in the rig file nothing is excused, not even what the noise makes.
TEST_F(UnitErrorsTest, AreNoneWhereTheRigFileStatesNoSpread) {
  rig_.amplifier.current_gain_spread = rig_.amplifier.edge_spread = 0;
  UnitErrors errors;
  EXPECT_FALSE(IsWithin(rig_, &errors));
  EXPECT_EQ(errors.largest, 1);
  EXPECT_TRUE(errors.most.empty());
}

}  // namespace
}  // namespace ambrig
