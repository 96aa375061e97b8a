// Mistakes put into simulated records are named with record, channel and amount; sound records and
// records of a rig with an effect are left alone.
#include "discovery/data/data_gate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "discovery/model/floor.h"
#include "discovery/practice/examination.h"
#include "discovery/practice/spoil.h"
#include "effects/catalogue.h"
#include "rig/bearing_kinds/bearing_kind.h"
#include "rig/rig_file.h"
#include "tests/discovery/measured_case.h"

namespace ambrig {
namespace {

using Samples = std::vector<double>;

RigParameters RadialRig() {
  RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  std::erase_if(rig.bearings, [](const BearingParameters& b) { return b.kind->axial; });
  return rig;
}

/// Two records as a logger writes them: steps at rest, and clamped current ramps; with `third` one more.
Case Measured(const std::vector<EffectInstance>& effects = {}, double mass_shift = 0,
              const std::string& third = "") {
  std::vector<ExaminationRecord> chosen;
  for (const ExaminationRecord& r : Examination(RadialRig(), 4))
    if (r.title == "steps of reference and load at rest" || r.title == "clamped, current ramps" ||
        r.title == third)
      chosen.push_back(r);
  Case c = EmptyCase(RadialRig(), chosen);
  const CaseModel model(c);
  Hypothesis truth;
  truth.rig = RadialRig();
  truth.rig.rotor.mass += mass_shift;
  truth.rig.effects = effects;
  for (std::size_t r = 0; r < c.records.size(); ++r) {
    const Record run = model.Simulated(truth, r, true, 70 + r);
    for (Channel& ch : c.records[r].data.channels) {
      const auto& from = run.Find(ch.name)->samples;
      std::copy_n(from.begin(), std::min(from.size(), ch.samples.size()), ch.samples.begin());
    }
  }
  return c;
}

std::vector<DataFault> FaultsOf(const Case& c) {
  CaseModel model(c);
  const Hypothesis h = Hypothesis::Base(c.rig);
  const NoiseFloor floor = FindFloor(model, h);
  return InspectData(model, floor.clean, h);
}

std::size_t RecordNamed(const Case& c, const std::string& title) {
  for (std::size_t r = 0; r < c.records.size(); ++r)
    if (c.records[r].data_file == title) return r;
  return 99;
}

const char* kSteps = "steps of reference and load at rest";
const char* kClamped = "clamped, current ramps";

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
  if (fault == "lost") {
    EXPECT_NEAR(f.seconds, 0.08 * 0.35, 2e-3);
  }
}

Samples& SamplesOf(Case& c, const char* record, const std::string& channel) {
  for (Channel& ch : c.records[RecordNamed(c, record)].data.channels)
    if (ch.name == channel) return ch.samples;
  throw std::runtime_error(channel);
}

// The data of two scenarios exchanged: each record is said to be of the other's scenario.
TEST(DataGate, DataOfAnotherScenarioAreNamedWithIt) {
  const char* kOther = "multisine at 60 Hz";
  Case c = Measured({}, 0, kOther);
  const std::size_t a = RecordNamed(c, kSteps), b = RecordNamed(c, kOther);
  ASSERT_NE(b, 99U);
  std::swap(c.records[a].data, c.records[b].data);
  std::swap(c.records[a].quality, c.records[b].quality);
  for (CaseRecord* r :
       {&c.records[a], &c.records[b]})  // what was commanded says nothing of the speed
    for (Channel& ch : r->data.channels)
      if (ch.name == "omega" || ch.name == "theta")
        std::fill(ch.samples.begin(), ch.samples.end(), std::nan(""));
  int named = 0;
  for (const DataFault& f : FaultsOf(c)) {
    if (f.fault != "scenario") continue;
    ++named;
    EXPECT_TRUE(f.record == kSteps || f.record == kOther) << f.record;
    EXPECT_EQ(f.with, f.record == kSteps ? kOther : kSteps);
    EXPECT_EQ(f.mend, "scenario = \"" + f.with + "\"");
    EXPECT_GT(f.probability, 0.8);
  }
  EXPECT_GE(named, 1);
}

// What the data-quality pass left out because it stands still is named too, but not of a clamped rotor, which may stand.
TEST(DataGate, AStuckColumnThatWasLeftOutIsNamed) {
  for (const char* record : {kSteps, kClamped}) {
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
    if (record == kClamped) {
      EXPECT_TRUE(faults.empty());
      continue;
    }
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].fault, "freeze");
    EXPECT_EQ(faults[0].channel, "B.i3");
    const Record& data = c.records[r].data;
    EXPECT_NEAR(faults[0].seconds, static_cast<double>(data.rows()) / data.rate, 1e-9);
  }
}

// Of a speed column the prediction is the scenario's own profile.
TEST(DataGate, ASpeedInAnotherUnitIsNamedWithItsFactor) {
  const char* kTurning = "multisine at 60 Hz";
  for (const double factor : {60 / (2 * M_PI), 1 / (2 * M_PI), -1.0}) {
    Case c = Measured({}, 0, kTurning);
    for (double& v : SamplesOf(c, kTurning, "omega")) v *= factor;
    const auto faults = FaultsOf(c);
    ASSERT_EQ(faults.size(), 1U) << factor;
    EXPECT_EQ(faults[0].fault, factor < 0 ? "sign" : "unit");
    EXPECT_EQ(faults[0].record, kTurning);
    EXPECT_EQ(faults[0].channel, "omega");
    EXPECT_NEAR(faults[0].factor, factor, 1e-9);
    EXPECT_NE(faults[0].mend.find("channels.\"omega\""), std::string::npos);
  }
}

// The bus stands at its voltage: its noise has no correlation with a prediction, its level does.
TEST(DataGate, AConstantColumnShowsItsFactorByItsLevel) {
  for (const double factor : {2.0, 0.5, std::sqrt(2.0), 25.4, 57.29577951308232}) {
    Case c = Measured();
    for (double& v : SamplesOf(c, kSteps, "bus")) v *= factor;
    const auto faults = FaultsOf(c);
    ASSERT_EQ(faults.size(), 1U) << factor;
    EXPECT_EQ(faults[0].fault, "unit");
    EXPECT_EQ(faults[0].channel, "bus");
    EXPECT_NEAR(faults[0].factor, factor, 1e-6 * factor);
  }
}

TEST(DataGate, ColumnsOfDifferentKindsExchanged) {
  for (const char* other : {"A.i1", "A.s5"}) {
    Case c = Measured();
    std::swap(SamplesOf(c, kSteps, "bus"), SamplesOf(c, kSteps, other));
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

// A logger loses rows of all columns at once. One column that runs ahead from some instant on shows what the machine
// did, for example a load that a rub carries in the magnet's place.
TEST(DataGate, OneColumnLosesNoRows) {
  Case c = Measured();
  Samples& i = SamplesOf(c, kSteps, "B.i1");
  const auto at = static_cast<std::ptrdiff_t>(i.size() / 4);
  std::copy(i.begin() + at + 400, i.end(), i.begin() + at);
  for (const DataFault& f : FaultsOf(c)) EXPECT_NE(f.fault, "lost") << FaultText(f);
}

// A sensor that adds hum where the model expects nothing but noise: no factor of a thousand.
TEST(DataGate, HumIsNoUnit) {
  Case c = Measured();
  Samples& z = SamplesOf(c, kClamped, "B.y");
  const double level = z[0];
  for (std::size_t k = 0; k < z.size(); ++k)
    z[k] = z[k] - level + 9e-5 * std::sin(2 * 3.14159265 * 50 * static_cast<double>(k) / 12500.0);
  for (const DataFault& f : FaultsOf(c)) EXPECT_NE(f.fault, "unit") << FaultText(f);
}

INSTANTIATE_TEST_SUITE_P(
    Mistakes, DataGateFinds,
    ::testing::Values(Mistake{kSteps, "unit", "A.x"}, Mistake{kSteps, "unit", "B.i3"},
                      Mistake{kSteps, "sign", "A.y"}, Mistake{kSteps, "sign", "B.i3"},
                      Mistake{kSteps, "swap", "A.x"}, Mistake{kSteps, "lag", ""},
                      Mistake{kSteps, "lost", ""}, Mistake{kSteps, "freeze", "B.x"},
                      Mistake{kSteps, "range", "A.x"}, Mistake{kClamped, "unit", "A.i1"},
                      Mistake{kClamped, "sign", "A.fx"}, Mistake{kClamped, "swap", "A.i1"},
                      Mistake{kClamped, "clip", "B.i1"}, Mistake{kSteps, "clip", "A.i6"},
                      Mistake{kClamped, "lag", ""}, Mistake{kClamped, "freeze", "A.fy"},
                      Mistake{kClamped, "range", "bus"}),
    [](const auto& mistake) {
      std::string name = std::string(mistake.param.record == kSteps ? "Steps" : "Clamped") +
                         mistake.param.fault + mistake.param.channel;
      std::erase_if(name, [](char ch) { return !std::isalnum(static_cast<unsigned char>(ch)); });
      return name;
    });

}  // namespace
}  // namespace ambrig
