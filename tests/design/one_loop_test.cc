/// There is one linear loop: the design's figures and the analysis have the same sensitivity.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/linear/control_plant.h"
#include "analysis/sensitivity.h"
#include "design/linear_figures.h"
#include "simulation/sampled/controller_setup.h"
#include "tests/simulation/controlled_rig.h"

namespace ambrig {
namespace {

class OneLoop : public ::testing::TestWithParam<std::string> {};

TEST_P(OneLoop, AnalysisAndDesignHaveTheSameSensitivity) {
  const RigParameters rig = RigWith(GetParam());
  constexpr double kSpeed = 600;  // [rad/s]
  const OperatingPoint point = FindOperatingPoint(rig);
  const ClosedLoop loop(point, kSpeed);
  const Sensitivity analysed = FindSensitivity(point, TransferFunction(point, loop), kSpeed);
  const SampledPlant plant = MakeControlPlant(point, {0, 1, 2, 3, 4}, kSpeed, CurrentModel::kCoils);
  const StateSpace K = MakeController(NominalRig(rig), rig.controller)->Linear(kSpeed);
  for (std::size_t axis = 0; axis < analysed.axes.size(); ++axis) {
    const std::vector<double> curve = SensitivityCurve(plant, K, axis, analysed.frequency);
    for (std::size_t k = 0; k < curve.size(); ++k)
      ASSERT_NEAR(curve[k] / std::abs(analysed.axes[axis].S[k]), 1, 1e-7)
          << analysed.axes[axis].axis << ", " << analysed.frequency[k] << " Hz";
  }
}

INSTANTIATE_TEST_SUITE_P(Controllers, OneLoop,
                         ::testing::Values("kind = \"pid\"\n" + kPidGains, kTiltTranslation,
                                           kTransfer, std::string("kind = \"lqg\"\n")));

}  // namespace
}  // namespace ambrig
