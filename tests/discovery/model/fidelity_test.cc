// Sensitivities from coarse predictions agree with those that resolve every current sample.
#include <gtest/gtest.h>

#include <cmath>

#include "discovery/experiment/examination.h"
#include "discovery/model/case_model.h"
#include "effects/catalogue.h"
#include "rig/rig_assembly.h"
#include "rig/rig_file.h"

namespace ambrig {
namespace {

/// rms of fine minus coarse change over rms of the fine change.
double Error(const CaseModel& model, const std::vector<Hypothesis>& pair) {
  const auto fine = model.PredictAll(pair), coarse = model.PredictAll(pair, ModelFidelity::kCoarse);
  double error = 0, change = 0;
  for (const Target& t : model.targets())
    for (std::size_t k = t.first; k < t.first + t.count; ++k) {
      const double f = (*fine[1])[k] - (*fine[0])[k], c = (*coarse[1])[k] - (*coarse[0])[k];
      const double unit = t.full_scale > 0 ? t.full_scale : 1;
      error += std::pow((f - c) / unit, 2);
      change += std::pow(f / unit, 2);
    }
  return std::sqrt(error / change);
}

class FidelityTest : public ::testing::Test {
 protected:
  FidelityTest()
      : rig_(ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml")),
        case_(EmptyCase(rig_, {Examination(rig_, 5, {})[0]})),
        model_(case_),
        base_(Hypothesis::Base(rig_)) {}

  RigParameters rig_;
  Case case_;
  CaseModel model_;
  Hypothesis base_;
};

TEST_F(FidelityTest, CoarseSensitivitiesOfRigParametersErrByLittle) {
  for (std::size_t p = 0; p < base_.free.size(); ++p) {
    if (base_.free[p].path == "rotor.inertia_polar") continue;  // the record does not turn
    Hypothesis moved = base_;
    moved.Set(p, moved.ValueAt(p, 0.3));
    EXPECT_LT(Error(model_, {base_, moved}), 0.05) << base_.free[p].path;
  }
}

TEST_F(FidelityTest, CoarseSignaturesOfEffectsErrByLittle) {
  for (const char* name : {"eddy-currents", "iron-reluctance", "saturation", "fringing"}) {
    Hypothesis with = base_;
    EffectInstance e = MakeInstance(EffectNamed(name), "A");
    for (std::size_t k = 0; k < e.values.size(); ++k)
      e.values[k] = std::sqrt(e.table[k].typical_lo * e.table[k].typical_hi);
    with.AddEffect(e);
    EXPECT_LT(Error(model_, {base_, with}), 0.1) << name;
  }
}

}  // namespace
}  // namespace ambrig
