// Mistakes put into simulated records are named with record, channel and amount; sound records and
// records of a rig with an effect are left alone.
#include "discovery/data_gate/data_gate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "discovery/practice/spoil.h"
#include "effects/catalogue.h"
#include "tests/discovery/data_gate/gate_case.h"
#include "tests/discovery/measured_case.h"

namespace ambrig {
namespace {

using testing::ExpectOnly;
using testing::FaultsOf;
using testing::kClampedRecord;
using testing::kStepRecord;
using testing::Measured;
using testing::RecordNamed;
using testing::SamplesOf;

TEST(DataGate, SoundRecordsPass) { EXPECT_TRUE(FaultsOf(Measured()).empty()); }

// What the rig does differently is no error of the data: a fit has to say what it is.
TEST(DataGate, EffectsAndParametersPass) {
  for (const auto& [name, target, parameter, value] :
       {std::tuple{"sensor-gain", "A.x", "gain", 1.08},
        {"side-pull", "B", "stiffness", 4e4},
        {"iron-reluctance", "A", "path", 6e-5},
        {"current-sensor-offset", "B.coil2", "offset", 0.1},
        {"loop-delay", "rig", "time", 1.6e-4},
        {"turn-mismatch", "A.coil3", "ratio", 0.94}}) {
    EffectInstance e = MakeInstance(EffectNamed(name), target);
    e.Set(parameter, value);
    const auto faults = FaultsOf(Measured({e}));
    EXPECT_TRUE(faults.empty()) << name << ": " << FaultText(faults[0]);
  }
  EXPECT_TRUE(FaultsOf(Measured({}, 0.1)).empty());
}

struct Mistake {
  const char *record, *fault, *channel;
};

class DataGateFinds : public ::testing::TestWithParam<Mistake> {};

TEST_P(DataGateFinds, TheMistakeAndNothingElse) {
  const Mistake m = GetParam();
  Case c = Measured();
  Spoil(c, RecordNamed(c, m.record), {m.fault, m.channel}, 1);
  const auto faults = FaultsOf(c);
  ASSERT_FALSE(faults.empty());
  for (const DataFault& f : faults) {
    EXPECT_EQ(f.fault, m.fault) << FaultText(f);
    EXPECT_EQ(f.record, m.record);
    EXPECT_FALSE(f.mend.empty());
    EXPECT_GT(f.probability, 0.8);
  }
  const DataFault& f = faults[0];
  const std::string fault = m.fault;
  const bool whole = fault == "lag" || fault == "lost";
  if (whole) {
    EXPECT_EQ(f.channel, "");
  } else {
    EXPECT_TRUE(f.channel == m.channel || f.with == m.channel) << f.channel;
  }
  EXPECT_EQ(faults.size(), 1U);
  if (fault == "unit") {
    EXPECT_DOUBLE_EQ(f.factor, 1000);
  }
  if (fault == "lag") {
    EXPECT_NEAR(f.seconds, 0.02, 5e-4);
  }
  if (fault == "lost") {  // from 45 % of the record's 0.35 s on
    EXPECT_NEAR(f.seconds, 0.08 * 0.35, 2e-3);
    double from = 0, to = 0;
    ASSERT_EQ(std::sscanf(f.mend.c_str(), "leave_out = [[%lf, %lf]]", &from, &to), 2) << f.mend;
    EXPECT_NEAR(from, (1968 - 2) / 12500.0, 0.5 / 12500.0);  // two rows before the first lost one
    EXPECT_NEAR(to, 0.92 * 0.35, 1e-3);
  }
}

// What the data-quality pass left out because it stands still is named too, but not of a clamped
// rotor, which may stand.
TEST(DataGate, AStuckColumnThatWasLeftOutIsNamed) {
  for (const char* record : {kStepRecord, kClampedRecord}) {
    Case c = Measured();
    const std::size_t r = RecordNamed(c, record);
    for (std::size_t k = 0; k < c.records[r].quality.size(); ++k) {
      ChannelQuality& q = c.records[r].quality[k];
      if (q.channel != "B.i3") continue;
      q.use = false;
      q.verdict = "stuck at one value";
      std::vector<double>& y = c.records[r].data.channels[k].samples;
      std::fill(y.begin(), y.end(), 2.0);
    }
    const auto faults = FaultsOf(c);
    if (record == kClampedRecord) {
      EXPECT_TRUE(faults.empty());
      continue;
    }
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].fault, "freeze");
    EXPECT_EQ(faults[0].channel, "B.i3");
    EXPECT_EQ(faults[0].mend, "channels.\"B.i3\" = { use = false }");
    const Record& data = c.records[r].data;
    EXPECT_NEAR(faults[0].seconds, static_cast<double>(data.rows()) / data.rate, 1e-9);
  }
}

TEST(DataGate, ColumnsOfDifferentKindsExchanged) {
  for (const char* other : {"A.i1", "A.s5"}) {
    Case c = Measured();
    std::swap(SamplesOf(c, kStepRecord, "bus"), SamplesOf(c, kStepRecord, other));
    const auto faults = FaultsOf(c);
    ASSERT_EQ(faults.size(), 1U) << other;
    EXPECT_EQ(faults[0].fault, "swap") << FaultText(faults[0]);
    EXPECT_TRUE(faults[0].channel == "bus" || faults[0].with == "bus");
    EXPECT_TRUE(faults[0].channel == other || faults[0].with == other);
  }
}

// Two held sensors whose readings differ by less than their zeros may are not told apart.
TEST(DataGate, ZerosOfHeldSensorsAreNoExchange) {
  for (const double apart : {6e-6, 6e-5}) {
    Case c = MeasuredCase({{2e-5, 3e-5}, {-6e-5, 1e-5}});
    for (CaseRecord& r : c.records) r.scenario.clamp["B"][0] += apart;  // of what the model expects
    // what A.x shows is expected of B.x, and the other way round
    for (double& v : c.records[0].data.channels[0].samples) v += apart;
    const auto faults = FaultsOf(c);
    const bool exchanged = std::any_of(faults.begin(), faults.end(), [&](const DataFault& f) {
      return f.fault == "swap" && f.record == c.records[0].data_file;
    });
    EXPECT_EQ(exchanged, apart > 1e-5) << apart;  // zeros of 0.1 mm of clearance are a few um
  }
}

// A force that takes the weight off, or more, gives currents that look like others' or like their
// own with a factor. Their set-points ask for what they show, and the rest of the bearing errs too.
TEST(DataGate, AForceOfTheOtherSignIsNoMistake) {
  for (const double force : {30.0, 36.0, 44.0, 48.0}) {
    EffectInstance load = MakeInstance(EffectNamed("constant-load"), "A");
    load.Set("fy", force);
    const auto faults = FaultsOf(Measured({load}));
    EXPECT_TRUE(faults.empty()) << force << ": " << FaultText(faults[0]);
  }
}

// One column that runs ahead from some instant on shows what the machine did, for example a load
// that a rub carries in the magnet's place, unless it shows exactly what the model expects some
// rows later.
TEST(DataGate, OneColumnLosesRowsOnlyIfTheRestFits) {
  for (const double size : {1.0, 0.8}) {
    Case c = Measured();
    std::vector<double>& i = SamplesOf(c, kStepRecord, "B.i1");
    const auto at = static_cast<std::ptrdiff_t>(i.size() / 4);
    std::copy(i.begin() + at + 400, i.end(), i.begin() + at);
    const double level = i[0];
    for (auto k = i.begin() + at; k != i.end(); ++k) *k = level + size * (*k - level);
    const auto faults = FaultsOf(c);
    if (size < 1) {
      for (const DataFault& f : faults) EXPECT_NE(f.fault, "lost") << FaultText(f);
      continue;
    }
    ExpectOnly(faults, "lost", "B.i1");
    EXPECT_NEAR(faults[0].seconds, 400 / 12500.0, 1e-3);
  }
}

// A record faster than the controller repeats every reading; one that stands still for far longer
// is frozen.
TEST(DataGate, AFrozenReadingIsFoundWhereEveryReadingIsRepeated) {
  for (const bool frozen : {false, true}) {
    Case c = Measured();
    std::vector<double>& x = SamplesOf(c, kClampedRecord, "A.x");
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = x[k - k % 10];
    if (frozen) Spoil(c, RecordNamed(c, kClampedRecord), {"freeze", "A.x"}, 1);
    const auto faults = FaultsOf(c);
    ASSERT_EQ(faults.size(), frozen ? 1U : 0U);
    if (!frozen) continue;
    EXPECT_EQ(faults[0].fault, "freeze");
    EXPECT_EQ(faults[0].channel, "A.x");
  }
}

// Single readings that no shaft and no converter can come and go to, and noise that only looks so.
TEST(DataGate, LonelyReadingsCannotBe) {
  for (const auto& [channel, size] : {std::pair{"A.x", 1.5e-3}, {"B.i4", 9.0}}) {
    Case c = Measured();
    std::vector<double>& y = SamplesOf(c, kStepRecord, channel);
    for (const std::size_t k : {400U, 1300U, 2100U}) y[k] += size;
    ExpectOnly(FaultsOf(c), "range", channel);
  }
}

// Flat tops are those of a converter also where the model does not reach them: beside an effect it
// may expect anything.
TEST(DataGate, FlatTopsThatTheModelDoesNotReach) {
  Case c = Measured();
  std::vector<double>& y = SamplesOf(c, kStepRecord, "A.x");
  const double top = *std::max_element(y.begin(), y.end());
  for (std::size_t k = 0; k < y.size(); ++k) {
    y[k] += 0.8 * top * std::sin(2 * M_PI * 90 * static_cast<double>(k) / 12500.0);
    y[k] = std::min(y[k], 1.2 * top);
  }
  const auto faults = FaultsOf(c);
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults[0].fault, "clip") << FaultText(faults[0]);
  EXPECT_EQ(faults[0].channel, "A.x");
}

// The top of a ramp is the column's own extreme: a logger that freezes there does not stand at a
// limit.
TEST(DataGate, AFreezeAtTheTopOfARampIsNoLimit) {
  Case c = Measured();
  std::vector<double>& i = SamplesOf(c, kClampedRecord, "A.i6");
  const auto top = std::max_element(i.begin(), i.end());
  ASSERT_GT(i.end() - top, 200);
  std::fill_n(top, 200, *top);
  const auto faults = FaultsOf(c);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].fault, "freeze") << FaultText(faults[0]);
  EXPECT_EQ(faults[0].channel, "A.i6");
}

INSTANTIATE_TEST_SUITE_P(
    Mistakes, DataGateFinds,
    ::testing::Values(Mistake{kStepRecord, "unit", "A.x"}, Mistake{kStepRecord, "unit", "B.i3"},
                      Mistake{kStepRecord, "sign", "A.y"}, Mistake{kStepRecord, "sign", "B.i3"},
                      Mistake{kStepRecord, "swap", "A.x"}, Mistake{kStepRecord, "lag", ""},
                      Mistake{kStepRecord, "lost", ""}, Mistake{kStepRecord, "freeze", "B.x"},
                      Mistake{kStepRecord, "range", "A.x"}, Mistake{kClampedRecord, "unit", "A.i1"},
                      Mistake{kClampedRecord, "sign", "A.fx"},
                      Mistake{kClampedRecord, "swap", "A.i1"},
                      Mistake{kClampedRecord, "clip", "B.i1"}, Mistake{kStepRecord, "clip", "A.i6"},
                      Mistake{kClampedRecord, "lag", ""}, Mistake{kClampedRecord, "freeze", "A.fy"},
                      Mistake{kClampedRecord, "freeze", "A.x"},
                      Mistake{kClampedRecord, "range", "bus"}),
    [](const auto& mistake) {
      std::string name = std::string(mistake.param.record == kStepRecord ? "Steps" : "Clamped") +
                         mistake.param.fault + mistake.param.channel;
      std::erase_if(name, [](char ch) { return !std::isalnum(static_cast<unsigned char>(ch)); });
      return name;
    });

}  // namespace
}  // namespace ambrig
