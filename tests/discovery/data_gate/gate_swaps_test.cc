// Coils whose columns were exchanged.
#include <gtest/gtest.h>

#include <cmath>

#include "discovery/data_gate/gate_columns.h"
#include "tests/discovery/data_gate/gate_case.h"

namespace ambrig {
namespace {

using testing::FaultsOf;
using testing::kStepRecord;
using testing::Measured;
using testing::RecordNamed;
using testing::SamplesOf;

// A logger that mixes up two coils, set-points included, changes nothing else of the bearing.
TEST(DataGate, TwoCoilsExchangedWithTheirSetPoints) {
  Case c = Measured();
  for (const char* kind : {"i", "s"})
    std::swap(SamplesOf(c, kStepRecord, std::string("A.") + kind + "3"),
              SamplesOf(c, kStepRecord, std::string("A.") + kind + "7"));
  const auto faults = FaultsOf(c);
  ASSERT_EQ(faults.size(), 2U);
  for (const DataFault& f : faults) EXPECT_EQ(f.fault, "swap") << FaultText(f);
}

// Two coils whose currents hardly differ: what is expected of the other one leaves noise alone, and
// the rest of the record shows none. Where the rest errs too, it may be the rig.
TEST(DataGate, CoilsOfNearlyEqualCurrentsExchanged) {
  for (const bool rest_errs : {false, true}) {
    Case c = Measured();
    std::swap(SamplesOf(c, kStepRecord, "A.i2"), SamplesOf(c, kStepRecord, "A.i3"));
    const std::size_t r = RecordNamed(c, kStepRecord);
    CaseModel model(c);
    const Hypothesis h = Hypothesis::Base(c.rig);
    std::vector<double> predicted = FindFloor(model, h).clean;
    double error = 0;
    for (const GateColumn& column : ColumnsOf(model, predicted, r))
      if (column.name == "A.i2")
        error = ErrorBesideZero(column, column.column.predicted, MostZero(model, "A.i2"));
    // as if the noise were so much larger that the exchange is five times as large
    const double coarser = error / 5;
    ASSERT_GT(coarser, 1);
    for (Target& t : model.targets()) t.floor *= coarser;
    if (rest_errs)
      for (const Target& t : model.targets())
        for (std::size_t k = 0; k < t.count; ++k)
          predicted[t.first + k] += 2 * t.floor * std::sin(0.01 * static_cast<double>(k));
    const auto faults = InspectData(model, predicted, h);
    if (rest_errs) {
      EXPECT_TRUE(faults.empty()) << FaultText(faults[0]);
      continue;
    }
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].fault, "swap") << FaultText(faults[0]);
    EXPECT_EQ(faults[0].channel, "A.i2");
    EXPECT_EQ(faults[0].with, "A.i3");
  }
}

}  // namespace
}  // namespace ambrig
