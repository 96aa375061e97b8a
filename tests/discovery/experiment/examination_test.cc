// The records of an examination: what is excited, how strongly, at which speeds, and the case that
// they make.
#include "discovery/experiment/examination.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>

#include "rig/clearance.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_file.h"

namespace ambrig {
namespace {

class ExaminationOf : public ::testing::Test {
 protected:
  std::vector<Scenario> Scenarios(std::uint64_t seed, const ExaminationNeeds& needs = {}) const {
    std::vector<Scenario> out;
    for (const ExaminationRecord& r : Examination(rig_, seed, needs))
      out.push_back(ReadScenarioText(r.toml, r.title, rig_));
    return out;
  }
  Scenario Named(const std::string& title, std::uint64_t seed = 1) const {
    for (const Scenario& s : Scenarios(seed, {true, true}))
      if (s.name == title) return s;
    ADD_FAILURE() << "no record " << title;
    return {};
  }

  const RigParameters rig_ = ReadRig(AMBRIG_SOURCE_DIR "/scenarios/library/rigs/reference.toml");
  const double weight_ = rig_.rotor.mass * 9.81;
};

// rpm of the titles: 60 Hz is 377 rad/s, 180 Hz 1131, 100 Hz 628, 250 Hz 1571, 50 Hz 314, 80 Hz
// 503.
TEST_F(ExaminationOf, EveryRecordHasItsSpeedsLengthAndUse) {
  struct Row {
    const char* title;
    double from, to, duration;
    bool validate;
  };
  const Row rows[] = {{"multisine at rest", 0, 0, 0.43, false},
                      {"multisine at 60 Hz", 60, 60, 0.35, false},
                      {"run-up to 250 Hz", 0, 250, 0.6, false},
                      {"steps of reference and load at rest", 0, 0, 0.35, false},
                      {"clamped, current ramps", 0, 0, 0.2, false},
                      {"clamped, current pulses", 0, 0, 0.012, false},
                      {"lift-off at 50 Hz", 50, 50, 0.2, false},
                      {"lift-off at 80 Hz", 80, 80, 0.2, true},
                      {"coast-down from 1571 rad/s", 250, 250, 0.4, false},
                      {"coast-down from 900 rad/s", 143.24, 143.24, 0.4, true},
                      {"multisine at 180 Hz", 180, 180, 0.3, true},
                      {"steps at 100 Hz", 100, 100, 0.3, true},
                      {"clamped off centre, current ramps", 0, 0, 0.15, true}};
  const auto records = Examination(rig_, 1, {true, true});
  const auto scenarios = Scenarios(1, {true, true});
  ASSERT_EQ(records.size(), std::size(rows));
  for (std::size_t k = 0; k < records.size(); ++k) {
    const Row& row = rows[k];
    EXPECT_EQ(records[k].title, row.title);
    EXPECT_EQ(records[k].validate, row.validate) << row.title;
    EXPECT_NEAR(scenarios[k].duration, row.duration, 1e-12) << row.title;
    // whole rad/s: within half of one
    EXPECT_NEAR(scenarios[k].speed.Speed(0), 2 * M_PI * row.from, 0.5) << row.title;
    EXPECT_NEAR(scenarios[k].speed.Speed(row.duration), 2 * M_PI * row.to, 0.5) << row.title;
  }
  EXPECT_EQ(Examination(rig_, 1).size(),
            std::size(rows) - 4);  // contact and free speed only where asked for
}

TEST_F(ExaminationOf, OnlyThePulsesAreRecordedAtTheRateOfTheConverters) {
  const auto records = Examination(rig_, 1);
  const auto scenarios = Scenarios(1);
  for (std::size_t k = 0; k < records.size(); ++k) {
    const bool pulses = records[k].title == "clamped, current pulses";
    EXPECT_EQ(records[k].burst, pulses);
    EXPECT_EQ(scenarios[k].record_rate,
              pulses ? rig_.amplifier.switching_frequency * rig_.amplifier.adc_samples_per_period
                     : rig_.controller.rate);
    EXPECT_FALSE(scenarios[k].fault_tolerant);
  }
}

// 17 lines an axis on the grid of 0.5 Hz between 5 and 1500 Hz, all axes apart where the grid is
// fine enough.
TEST_F(ExaminationOf, MultisinesShareTheBandBetweenTheAxes) {
  const Scenario s = Named("multisine at rest");
  ASSERT_EQ(s.excitations.size(), 5u);  // A.x, A.y, B.x, B.y, z
  std::map<double, int> lines;
  std::set<double> amplitudes;
  for (const Excitation& e : s.excitations) {
    EXPECT_EQ(e.kind, "multisine");
    EXPECT_EQ(e.port, "force");
    EXPECT_NEAR(e.start, 0.03, 1e-12);
    EXPECT_NEAR(e.stop, 0.43, 1e-12);
    ASSERT_EQ(e.frequencies.size(), 17u);
    for (std::size_t k = 0; k < 17; ++k) {
      const double f = e.frequencies[k];
      EXPECT_EQ(2 * f, std::round(2 * f));
      EXPECT_GE(f, 5);
      EXPECT_LT(f, 1500);
      if (k > 0) {
        EXPECT_GT(f, e.frequencies[k - 1]);
      }
      ++lines[f];
    }
    for (const double phase : e.phases) {
      EXPECT_GE(phase, 0);
      EXPECT_LE(phase, 2 * M_PI);
    }
    EXPECT_GE(e.amplitude, 0.025 * weight_ * 0.7 * (1 - 1e-5));
    EXPECT_LE(e.amplitude, 0.025 * weight_ * 1.4 * (1 + 1e-5));
    amplitudes.insert(e.amplitude);
  }
  EXPECT_EQ(amplitudes.size(), 5u);
  for (const auto& [f, count] : lines)
    if (f > 10) {
      EXPECT_EQ(count, 1) << f;
    }
  // Ratios of neighbours of one axis: (1500/5)^(1/17).
  const auto& last = s.excitations[0].frequencies;
  EXPECT_NEAR(last[16] / last[15], std::pow(300.0, 1.0 / 17), 0.01);
}

// A step of each bearing within its share of the clearance, neighbours to opposite sides; then
// loads of radial bearings.
TEST_F(ExaminationOf, StepsMoveEachBearingAndThenLoadIt) {
  for (const auto& [title, share] :
       {std::pair{"steps of reference and load at rest", 0.3}, std::pair{"steps at 100 Hz", 0.2}}) {
    const Scenario s = Named(title);
    ASSERT_EQ(s.excitations.size(), rig_.bearings.size());
    std::size_t radial = 0;
    for (std::size_t b = 0; b < rig_.bearings.size(); ++b) {
      const Excitation& e = s.excitations[b];
      const double most = share * ClearanceOf(rig_.bearings[b]);
      EXPECT_EQ(e.kind, "step");
      EXPECT_EQ(e.port, "reference");
      EXPECT_GE(std::abs(e.amplitude), 0.8 * most * (1 - 1e-5)) << title;
      EXPECT_LE(std::abs(e.amplitude), 1.1 * most * (1 + 1e-5)) << title;
      EXPECT_EQ(e.amplitude < 0, b % 2 == 1);
      if (b > 0) {
        EXPECT_GT(e.start, s.excitations[b - 1].stop);  // one after the other
      }
      radial += rig_.bearings[b].kind->two_axes ? 1 : 0;
    }
    ASSERT_EQ(s.loads.size(), radial);
    double before = s.excitations.back().stop;
    for (const LoadSpec& l : s.loads) {
      EXPECT_GT(l.start, before);
      EXPECT_LE(l.stop, s.duration);
      EXPECT_LE(std::max(std::abs(l.fx), std::abs(l.fy)), 0.3 * weight_);
      before = l.stop;
    }
  }
}

// Bias in all coils of the radial bearings for the whole record, and more in one pair of neighbours
// after the other: never above what the amplifier gives.
TEST_F(ExaminationOf, ClampedRecordsRaiseOnePairOfCoilsAfterTheOther) {
  for (const char* title :
       {"clamped, current ramps", "clamped, current pulses", "clamped off centre, current ramps"}) {
    const Scenario s = Named(title);
    EXPECT_EQ(s.start, StartState::kClamped);
    ASSERT_EQ(s.clamp.size(), 2u);
    for (const BearingParameters& b : rig_.bearings)
      if (b.kind->two_axes) {
        for (const double at : s.clamp.at(b.name)) EXPECT_LE(std::abs(at), 0.5 * ClearanceOf(b));
      }
    std::map<std::string, double> bias, most, start;
    for (const Excitation& e : s.excitations) {
      EXPECT_EQ(e.port, "current");
      if (e.start == 0 && e.kind == "step" && e.amplitude == 1.2) {
        bias[e.target] = e.amplitude;
        EXPECT_NEAR(e.stop, s.duration, 1e-9);
      } else {
        most[e.target] = e.amplitude;
        start[e.target] = e.start;
      }
    }
    EXPECT_EQ(bias.size(), 16u) << title;
    EXPECT_EQ(most.size(), 16u) << title;
    for (const auto& [coil, more] : most) {
      EXPECT_GT(more, 0);
      EXPECT_LE(1.2 + more, rig_.amplifier.i_max) << coil << ' ' << title;
    }
    EXPECT_EQ(start["A.coil1"], start["A.coil2"]);
    EXPECT_LT(start["A.coil2"], start["A.coil3"]);
    EXPECT_LT(start["A.coil7"], s.duration);
    EXPECT_EQ(start["A.coil3"], start["B.coil3"]);
  }
}

TEST_F(ExaminationOf, TheSeedDrawsSizesAndTheSameSeedTheSame) {
  EXPECT_EQ(Examination(rig_, 3)[0].toml, Examination(rig_, 3)[0].toml);
  EXPECT_NE(Named("multisine at rest", 3).excitations[0].amplitude,
            Named("multisine at rest", 4).excitations[0].amplitude);
  std::set<std::uint64_t> seeds;  // of the noise: one a record
  for (const Scenario& s : Scenarios(3)) seeds.insert(s.seed);
  EXPECT_EQ(seeds.size(), Scenarios(3).size());
}

// Readings, currents and set-points of every bearing, load cells only where the rotor is held and
// the rate is the controller's.
TEST_F(ExaminationOf, TheEmptyCaseHasTheChannelsOfALogger) {
  const auto records = Examination(rig_, 1);
  const Case c = EmptyCase(rig_, records);
  ASSERT_EQ(c.records.size(), records.size());
  for (std::size_t k = 0; k < records.size(); ++k) {
    const CaseRecord& r = c.records[k];
    const bool clamped = r.scenario.start == StartState::kClamped;
    std::set<std::string> names;
    for (const Channel& ch : r.data.channels) {
      names.insert(ch.name);
      EXPECT_EQ(ch.samples.size(),
                static_cast<std::size_t>(std::lround(r.scenario.duration * r.data.rate)))
          << records[k].title;
    }
    EXPECT_EQ(names.size(), r.data.channels.size());
    EXPECT_EQ(r.quality.size(), r.data.channels.size());
    EXPECT_EQ(r.validate, records[k].validate);
    for (const char* name : {"A.x", "B.y", "z", "A.i1", "B.s8", "bus"})
      EXPECT_TRUE(names.contains(name)) << name << " in " << records[k].title;
    EXPECT_EQ(names.contains("A.fx"), clamped && !records[k].burst) << records[k].title;
  }
}

}  // namespace
}  // namespace ambrig
