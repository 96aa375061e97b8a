#pragma once
/// A practice case of the reference rig without its thrust bearing and without an effect, every
/// parameter as in the rig file: what remains of a model that is given measured motion or measured
/// currents must be noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "discovery/model/floor.h"
#include "discovery/model/residual.h"
#include "discovery/practice/hide.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_file.h"

namespace ambrig {

class ImposedCase : public ::testing::Test {
 protected:
  static RigParameters FreeRotor() {
    RigParameters rig =
        ReadRig(std::string(AMBRIG_SOURCE_DIR) + "/scenarios/library/rigs/reference.toml");
    std::erase_if(rig.bearings, [](const BearingParameters& b) { return b.kind->axial; });
    return rig;
  }
  static void SetUpTestSuite() {
    hidden_ = std::make_unique<HiddenCase>(Hide(FreeRotor(), {{}, false, 5}));
  }
  static void TearDownTestSuite() { hidden_.reset(); }

  static double ErrorOverFloor(const Case& data) {
    CaseModel model(data, 4);
    const Hypothesis base = Hypothesis::Base(data.rig);
    const NoiseFloor floor = FindFloor(model, base);
    return Ratio(model, Residual(model, floor.clean), Which::kFit);
  }
  static inline std::unique_ptr<HiddenCase> hidden_;
  Case data_;
};

}  // namespace ambrig
