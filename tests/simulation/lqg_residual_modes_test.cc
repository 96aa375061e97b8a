// An LQG controller synthesised on a rig with `static_correction`: its model holds the residual
// modes or leaves them out (model_modes); either holds the shaft at the speeds that it was designed
// for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/linear/control_plant.h"
#include "rig/rig_assembly.h"
#include "rotor/linear/linear_rotor.h"
#include "simulation/sampled/controller_setup.h"
#include "simulation/switching/switching_engine.h"
#include "tests/simulation/tum_rig.h"

namespace ambrig {
namespace {

using testing::Quiet;
using testing::Replaced;

const std::string kLqgFolder = std::string(AMBRIG_SOURCE_DIR) + "/examples/design_tum/";

/// `modes` of the rig beside its two residual modes, `model_modes` of the controller's model (-1:
/// all that the rig has).
RigParameters LqgRig(int modes, bool corrected, int model_modes) {
  std::string text = ReadFile(kLqgFolder + "lqg.toml");
  text = Replaced(text, "modes = 6 ", "modes = " + std::to_string(modes) + " ");
  if (corrected) text = Replaced(text, "[rotor]\n", "[rotor]\nstatic_correction = true\n");
  text = Replaced(text, "model_modes = 4",
                  model_modes < 0 ? "" : "model_modes = " + std::to_string(model_modes));
  return ReadRigText(text, kLqgFolder + "lqg.toml");
}

/// Of the loop of the controller designed on `nominal` round the rig `plant`.
double LargestRadius(const RigParameters& plant, const RigParameters& nominal) {
  const auto controller = MakeController(NominalRig(nominal), nominal.controller);
  double worst = 0;
  for (const double speed : {0.0, 157.0, 314.0})
    worst = std::max(worst, SpectralRadius(LoopMatrix(
                                MakeControlPlant(plant, {0, 1, 2, 3}, speed, &nominal).FromForce(),
                                controller->Linear(speed))));
  return worst;
}

struct LqgCase {
  int modes, model_modes;
};
constexpr LqgCase kLqgCases[] = {{4, 4}, {4, -1}, {2, -1}, {0, -1}};

TEST(LqgWithResidualModes, TheLinearLoopIsStable) {
  for (const LqgCase& c : kLqgCases) {
    const RigParameters rig = LqgRig(c.modes, true, c.model_modes);
    ASSERT_EQ(rig.modes.size(), static_cast<std::size_t>(c.modes) + 2);
    EXPECT_LT(LargestRadius(rig, rig), 1) << c.modes << ' ' << c.model_modes;
  }
  // Of a model with two modes alone the residual ones spill over, at 314 rad/s.
  const RigParameters blind = LqgRig(2, true, 2);
  EXPECT_GT(LargestRadius(blind, blind), 1 + 1e-6);
}

// The residual modes stand where no mode of the shaft is: a design on them must hold the shaft with
// the eight modes that its elements have.
TEST(LqgWithResidualModes, HoldsTheShaftWithItsOwnModes) {
  const RigParameters whole = LqgRig(8, false, 4);
  for (const int model_modes : {4, -1})
    EXPECT_LT(LargestRadius(whole, LqgRig(4, true, model_modes)), 1) << model_modes;
}

// 5 N at the disk of the turning shaft: integral action brings the sensors back, the shaft between
// them stays bent as the whole beam on rigid supports there. Bounds: what is left of the closed
// loop's slowest decay, and of the controller's tremble.
TEST(LqgWithResidualModes, CarriesALoadInARun) {
  BeamDefinition d = testing::Mbtr().beam->definition;
  d.supports = {IsotropicSupport(0.113, 1e12, 0), IsotropicSupport(0.623, 1e12, 0)};
  const BeamRotor beam = BuildBeam(d);
  const LinearRotor pinned = Assemble(beam);
  const int disk = pinned.xy[static_cast<std::size_t>(NodeAt(beam, 0.363))][0];
  Eigen::VectorXd f = Eigen::VectorXd::Zero(pinned.M.rows());
  f(disk) = 5;
  const double sag = pinned.K.llt().solve(f)(disk);
  for (const LqgCase& c : kLqgCases) {
    RigParameters rig = LqgRig(c.modes, true, c.model_modes);
    rig.effects.clear();
    Scenario scenario = Quiet(rig, 0.5, 157);
    scenario.loads = {{rig.FindStation("disk")->z, false, 5, 0, 0, 0.02, 1}};
    const RunResult run = SwitchingEngine(rig, scenario, {}).Run();
    EXPECT_FALSE(run.touchdown) << c.modes << ' ' << c.model_modes;
    const auto mean = [&](const char* name) {
      const std::vector<double>& x = run.record.Find(name)->samples;
      double sum = 0;
      const std::size_t from = x.size() * 9 / 10;
      for (std::size_t k = from; k < x.size(); ++k) sum += x[k];
      return sum / static_cast<double>(x.size() - from);
    };
    const double a = mean("A.r.x"), b = mean("B.r.x"), share = (0.363 - 0.113) / (0.623 - 0.113);
    EXPECT_LT(std::abs(a), 1e-6) << c.modes << ' ' << c.model_modes;
    EXPECT_LT(std::abs(b), 1e-6);
    EXPECT_NEAR(mean("disk.r.x") - (1 - share) * a - share * b, sag, 0.01 * sag)
        << c.modes << ' ' << c.model_modes;
  }
}

}  // namespace
}  // namespace ambrig
