#pragma once
/// The multisine at rest of a heavy rotor with a resonance, free of noise.
#include <gtest/gtest.h>

#include <algorithm>

#include "discovery/experiment/examination.h"
#include "discovery/search/fit.h"
#include "effects/catalogue.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_file.h"

namespace ambrig::testing {

inline EffectInstance BaseOf(double mass, double frequency, double damping) {
  EffectInstance e = MakeInstance(EffectNamed("base-mode"), "rig");
  e.Set("mass", mass);
  e.Set("frequency", frequency);
  e.Set("damping", damping);
  return e;
}

class ResonanceStartTest : public ::testing::Test {
 protected:
  ResonanceStartTest() {
    RigParameters rig =
        ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/examples/heavy_compressor/rig.toml");
    std::erase_if(rig.bearings, [](const BearingParameters& b) { return b.kind->axial; });
    rig.tolerances.clear();
    std::vector<ExaminationRecord> records = Examination(rig, 5, {});
    records.resize(1);  // multisine at rest
    data_ = EmptyCase(rig, records);
    Measure(BaseOf(90, 35, 0.02));
  }
  /// The record of a rig with this effect.
  void Measure(const EffectInstance& effect) {
    const CaseModel empty(data_);
    Hypothesis truth = Hypothesis::Base(data_.rig);
    truth.AddEffect(effect);
    const Record measured = empty.Simulated(truth, 0, false, 1);
    for (Channel& ch : data_.records[0].data.channels)
      if (const Channel* from = measured.Find(ch.name))
        ch.samples.assign(from->samples.begin(),
                          from->samples.begin() + static_cast<std::ptrdiff_t>(ch.samples.size()));
  }
  /// The rig as it is, over floors of a thousandth of each channel.
  FitResult Simulated(CaseModel& model) const {
    for (Target& t : model.targets()) t.floor = std::max(1e-3 * t.full_scale, 1e-9);
    FitOptions look;
    look.iterations = 0;
    return Fit(model, Hypothesis::Base(data_.rig), look);
  }
  Case data_;
};

}  // namespace ambrig::testing
