#pragma once
/// Records of the reference rig for the data gate, "measured" by the model itself with noise of
/// another seed.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "discovery/data_gate/data_gate.h"
#include "discovery/experiment/examination.h"
#include "discovery/model/floor.h"
#include "effects/catalogue.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_file.h"

namespace ambrig::testing {

inline RigParameters RadialRig() {
  RigParameters rig =
      ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
  std::erase_if(rig.bearings, [](const BearingParameters& b) { return b.kind->axial; });
  return rig;
}

/// `c` with what this truth does in its records, noise of another seed included.
inline Case MeasuredBy(const Hypothesis& truth, Case c) {
  const CaseModel model(c);
  for (std::size_t r = 0; r < c.records.size(); ++r) {
    const Record run = model.Simulated(truth, r, true, 70 + r);
    for (Channel& ch : c.records[r].data.channels) {
      const auto& from = run.Find(ch.name)->samples;
      std::copy_n(from.begin(), std::min(from.size(), ch.samples.size()), ch.samples.begin());
    }
  }
  return c;
}

/// `c` measured on `rig` while one of its records ran under another scenario than its file states.
inline Case MeasuredUnder(Case c, std::size_t record, const std::function<void(Scenario&)>& change,
                          const RigParameters& rig = RadialRig()) {
  const Scenario written = c.records[record].scenario;
  change(c.records[record].scenario);
  Hypothesis truth;
  truth.rig = rig;
  c = MeasuredBy(truth, std::move(c));
  c.records[record].scenario = written;
  return c;
}

/// Takes the channels of these names out of a record.
inline void DropChannels(CaseRecord& r, const std::function<bool(const std::string&)>& drop) {
  std::set<std::string> kept;
  for (const Channel& ch : r.data.channels)
    if (!drop(ch.name)) kept.insert(ch.name);
  KeepChannels(r, kept);
}

/// A force that the model lacks [N/m].
inline EffectInstance CrossCouplingAtA(double stiffness) {
  EffectInstance cross = MakeInstance(EffectNamed("cross-coupling"), "A");
  cross.values[0] = stiffness;
  return cross;
}

/// Two records as a logger writes them: steps at rest, and clamped current ramps; with `third` one
/// more.
inline Case Measured(const std::vector<EffectInstance>& effects = {}, double mass_shift = 0,
                     const std::string& third = "") {
  std::vector<ExaminationRecord> chosen;
  for (const ExaminationRecord& r : Examination(RadialRig(), 4))
    if (r.title == "steps of reference and load at rest" || r.title == "clamped, current ramps" ||
        r.title == third)
      chosen.push_back(r);
  Hypothesis truth;
  truth.rig = RadialRig();
  truth.rig.rotor.mass += mass_shift;
  truth.rig.effects = effects;
  return MeasuredBy(truth, EmptyCase(RadialRig(), chosen));
}

inline std::vector<DataFault> FaultsOf(const Case& c) {
  CaseModel model(c);
  const Hypothesis h = Hypothesis::Base(c.rig);
  const NoiseFloor floor = FindFloor(model, h);
  return InspectData(model, floor.clean, h);
}

/// One fault in all, of this kind and column.
inline void ExpectOnly(const std::vector<DataFault>& faults, const std::string& fault,
                       const std::string& channel) {
  ASSERT_EQ(faults.size(), 1U) << channel;
  EXPECT_EQ(faults[0].fault, fault) << FaultText(faults[0]);
  EXPECT_EQ(faults[0].channel, channel);
}

inline std::size_t RecordNamed(const Case& c, const std::string& title) {
  for (std::size_t r = 0; r < c.records.size(); ++r)
    if (c.records[r].data_file == title) return r;
  return 99;
}

inline constexpr const char* kStepRecord = "steps of reference and load at rest";
inline constexpr const char* kClampedRecord = "clamped, current ramps";

inline std::vector<double>& SamplesOf(Case& c, const char* record, const std::string& channel) {
  for (Channel& ch : c.records[RecordNamed(c, record)].data.channels)
    if (ch.name == channel) return ch.samples;
  throw std::runtime_error(channel);
}

}  // namespace ambrig::testing
