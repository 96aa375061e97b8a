/// A flexible rotor that levitates: its start and one trajectory in three fidelities.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/math/constants.h"
#include "rig/rig_file.h"
#include "rotor/shaft/rotor_modes.h"
#include "simulation/continuous/averaged_engine.h"
#include "simulation/continuous/reference_engine.h"
#include "simulation/switching/switching_engine.h"
#include "tests/simulation/tum_rig.h"
#include "tests/simulation/witness.h"

namespace ambrig {
namespace {

using testing::Mbtr;
using testing::Quiet;

// A levitated start is in equilibrium, sag included: the disk hangs at rest, as deep as statics
// say.
TEST(LevitatedShaft, StartsSaggedAndStill) {
  RigParameters rig = Mbtr();
  rig.effects.clear();
  const Record record = SwitchingEngine(rig, Quiet(rig, 0.06, 0), {}).Run().record;
  const auto &y = record.Find("disk.r.y")->samples, &a = record.Find("A.r.y")->samples,
             &b = record.Find("B.r.y")->samples;
  BeamDefinition d = rig.beam->definition;
  d.supports = {IsotropicSupport(0.113, 1e12, 0), IsotropicSupport(0.623, 1e12, 0)};
  const BeamRotor beam = BuildBeam(d);
  const LinearRotor pinned = Assemble(beam);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(pinned.M.rows());
  for (const auto& xy : pinned.xy) g(xy[1]) = -9.81;
  const Eigen::VectorXd rest = pinned.K.llt().solve(pinned.M * g);
  const double sag = rest(pinned.xy[static_cast<std::size_t>(NodeAt(beam, 0.363))][1]);
  EXPECT_LT(sag, -5e-4);  // most of a millimetre
  const double share = (0.363 - 0.113) / (0.623 - 0.113);
  const auto [low, high] = std::minmax_element(y.begin(), y.end());
  // The switching ripple starts without its mean force being exact: a tremble, no ringing.
  EXPECT_LT(*high - *low, 2e-6);
  // Four modes carry the static shape to 0.5 %.
  EXPECT_NEAR(y.back() - (1 - share) * a.back() - share * b.back(), sag, 5e-3 * std::abs(sag));
}

// A blow to the disk of the turning, levitated rotor: three fidelities, one trajectory.
TEST(LevitatedShaft, FidelitiesAgree) {
  const RigParameters rig = Mbtr();
  Scenario scenario = Quiet(rig, 0.03, 300);
  scenario.loads = {{rig.FindStation("disk")->z, false, 3, -6, 0, 0.002, 0.006}};
  const double warm_up = 0.01;
  ReferenceOptions r;
  r.sampled.warm_up = warm_up;
  const Record reference = RunReference(rig, scenario, r).record;
  const auto fast = [&](int substeps) {
    EngineOptions o;
    o.warm_up = warm_up;
    o.substeps = substeps;
    return Compare(SwitchingEngine(rig, scenario, o).Run().record, reference);
  };
  const Difference once = fast(1), four = fast(4);
  EXPECT_GT(once.rows, 300u);
  EXPECT_LT(once.position, 1e-7);  // of a millimetre of motion of the disk
  EXPECT_LT(once.current, 5e-3);
  EXPECT_LE(four.current_rms, once.current_rms);
  AveragedOptions m = DefaultAveragedOptions();
  m.sampled.warm_up = warm_up;
  const Record mean = RunAveraged(rig, scenario, m).record;
  EXPECT_LT(Compare(mean, reference).position, 2e-6);
}

}  // namespace
}  // namespace ambrig
