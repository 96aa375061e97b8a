#pragma once
/// The multisine at rest of a heavy rotor with a resonance, free of noise.
#include <gtest/gtest.h>

#include <algorithm>

#include "discovery/experiment/examination.h"
#include "discovery/search/candidate_fit.h"
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

/// The first record of a case as a rig with this effect makes it.
inline void Measure(Case& c, const EffectInstance& effect) {
  const CaseModel empty(c);
  Hypothesis truth = Hypothesis::Base(c.rig);
  truth.AddEffect(effect);
  const Record measured = empty.Simulated(truth, 0, false, 1);
  for (Channel& ch : c.records[0].data.channels)
    if (const Channel* from = measured.Find(ch.name))
      ch.samples.assign(from->samples.begin(),
                        from->samples.begin() + static_cast<std::ptrdiff_t>(ch.samples.size()));
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
    Measure(data_, BaseOf(90, 35, 0.02));
  }
  /// The rig as it is, over floors of a thousandth of each channel.
  FitResult Simulated(CaseModel& model) const {
    for (Target& t : model.targets()) t.floor = std::max(1e-3 * t.full_scale, 1e-9);
    FitOptions look;
    look.iterations = 0;
    return Fit(model, Hypothesis::Base(data_.rig), look);
  }
  /// The short fit of a resonance that is sought from `start`.
  FitResult FittedFrom(const EffectInstance& start) const {
    CaseModel model(data_, 4);
    const FitResult base = Simulated(model);
    Candidate candidate;
    candidate.narrow = true;
    candidate.effect = start;
    return FitBriefly(model, base, candidate, 1e5);
  }
  Case data_;
};

}  // namespace ambrig::testing
