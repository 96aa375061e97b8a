/// Weights of a synthesis on the shaft itself, on the flexible TUM rig: that they are what they
/// say, and what they are for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/linear/control_plant.h"
#include "core/base/read_file.h"
#include "core/base/toml_edit.h"
#include "rig/rig_file.h"
#include "simulation/sampled/controller_setup.h"

namespace ambrig {
namespace {

const std::vector<std::size_t> kAxes{0, 1, 2, 3};

RigParameters Tum(const std::string& name, const std::vector<TomlEdit>& edits = {}) {
  const std::string file = std::string(AMBRIG_SOURCE_DIR "/examples/design_tum/") + name + ".toml";
  const std::string text = ReadFile(file);
  return ReadRigText(edits.empty() ? text : EditedToml(text, file, edits), file);
}

double Hertz(std::complex<double> z, double Ts) {
  return std::abs(std::arg(z)) / (2 * std::numbers::pi * Ts);
}

/// Of the pole that is nearest to a frequency.
double NearestPole(const Eigen::MatrixXd& A, double Ts, double hertz) {
  const Eigen::VectorXcd poles = A.eigenvalues();
  double best = kInfinity;
  for (const std::complex<double> z : poles)
    if (std::abs(Hertz(z, Ts) - hertz) < std::abs(best - hertz)) best = Hertz(z, Ts);
  return best;
}

// Closing the uncertain loop, w = -d/uncertainty v of one mode, is that mode with frequency w
// sqrt(1 + 2 d). The weight of a plane at the bearing is the bearing's own.
TEST(ShaftWeights, AreWhatTheySay) {
  const RigParameters rig = Tum("h_infinity");
  const double uncertainty = 0.04, error = 0.02;
  const SampledPlant p =
      MakeControlPlant(rig, kAxes, 0, nullptr,
                       {{{"A", 2e-5, 3.0}, {"disk", 1e-4, 1.0}}, ModeWeight{1e-4, uncertainty}});
  ASSERT_EQ(p.V.rows(), static_cast<Eigen::Index>(4 + 2 * rig.modes.size()));
  ASSERT_EQ(p.G.cols(), p.V.rows());
  // sensors stand at the bearings here
  EXPECT_LT((p.V.topRows(2) * 2e-5 - p.C.topRows(2)).norm(), 1e-12 * p.C.norm());
  EXPECT_LT((p.G.leftCols(2) - 3.0 * p.E.leftCols(2)).norm(), 1e-9 * p.G.leftCols(2).norm());
  const std::size_t mode = 2;
  const double hertz = rig.modes[mode].omega / (2 * std::numbers::pi);
  const auto row = static_cast<Eigen::Index>(4 + 2 * mode);
  const double before = NearestPole(p.A, p.Ts, hertz);
  const Eigen::MatrixXd off =
      p.A - error / uncertainty * p.G.middleCols(row, 2) * p.V.middleRows(row, 2);
  RigParameters other = rig;
  other.modes[mode].omega *= std::sqrt(1 + 2 * error);
  const double exact =
      NearestPole(MakeControlPlant(other, kAxes, 0).A, p.Ts, hertz * std::sqrt(1 + 2 * error));
  EXPECT_GT(exact, 1.01 * before);
  EXPECT_NEAR(NearestPole(off, p.Ts, exact), exact, 0.01 * (exact - before));
}

// Maxwell's reciprocity: a force at the disk moves the bearing as one at the bearing moves the
// disk.
TEST(ShaftWeights, AreReciprocal) {
  const SampledPlant p =
      MakeControlPlant(Tum("h_infinity"), kAxes, 0, nullptr, {{{"disk", 1.0, 1.0}}, {}});
  for (const double hertz : {5.0, 16.0, 80.0, 300.0}) {
    const std::complex<double> z = std::polar(1.0, 2 * std::numbers::pi * hertz * p.Ts);
    const Eigen::MatrixXcd inverse =
        (z * Eigen::MatrixXcd::Identity(p.A.rows(), p.A.rows()) - p.A).inverse();
    const std::complex<double> there = (p.V.row(0) * inverse * p.E.col(0))(0),
                               back = (p.C.row(0) * inverse * p.G.col(0))(0);
    EXPECT_LT(std::abs(there - back), 1e-3 * std::abs(there)) << hertz;
  }
}

/// Largest spectral radius over speeds of the loop with the true shaft's bending frequencies off by
/// `error`.
double Radius(const RigParameters& rig, double error) {
  RigParameters plant = rig;
  for (BendingMode& m : plant.modes) m.omega *= 1 + error;
  const auto controller = MakeController(NominalRig(rig), rig.controller);
  double worst = 0;
  for (const double speed : {0.0, 157.0, 314.0})
    worst = std::max(
        worst, SpectralRadius(LoopMatrix(MakeControlPlant(plant, kAxes, speed, &rig).FromForce(),
                                         controller->Linear(speed))));
  return worst;
}

// What the uncertainty is for: told that frequencies are exact, both syntheses are unstable when
// they are off by one per cent.
TEST(ShaftWeights, CarryErrorsOfTheFrequencies) {
  for (const char* name : {"lqg", "h_infinity"}) {
    const RigParameters rig = Tum(name), exact = Tum(name, {{"controller.modes.uncertainty", 0.0}});
    EXPECT_LT(Radius(exact, 0), 1) << name;
    EXPECT_GT(std::max(Radius(exact, -0.01), Radius(exact, 0.01)), 1 + 1e-6) << name;
    for (const double error : {-0.02, 0.0, 0.02})
      EXPECT_LT(Radius(rig, error), 1) << name << ' ' << error;
  }
}

// One design over all speeds loses the rotor at speed, one per end of the range holds between them
// too.
TEST(ShaftWeights, HInfinityOverSpeeds) {
  const RigParameters rig = Tum("h_infinity");
  ASSERT_GE(rig.controller.speeds.size(), 2U);
  RigParameters one = rig;
  one.controller.speeds = {0.0};
  one.controller.modes.reset();
  EXPECT_GT(Radius(one, 0), 1 + 1e-6);
  EXPECT_LT(Radius(rig, 0), 1);
}

// The model's order is the controller's: two states a mode and plane.
TEST(ShaftWeights, ModelModes) {
  const auto order = [](double modes) {
    const RigParameters rig = Tum("lqg", {{"controller.model_modes", modes}});
    return MakeController(NominalRig(rig), rig.controller)->Linear(0).states();
  };
  EXPECT_EQ(order(4) - order(3), 4);
  EXPECT_EQ(order(6), order(100));
}

TEST(ShaftWeights, MistakesAreTold) {
  const std::string file = AMBRIG_SOURCE_DIR "/examples/design_tum/lqg.toml", text = ReadFile(file);
  const auto said = [&](const std::string& from, const std::string& to) -> std::string {
    std::string changed = text;
    const auto at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    changed.replace(at, from.size(), to);
    try {
      ReadRigText(changed, file);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_NE(said("at = \"disk\"", "at = \"disc\"").find("allowed: A, B, "), std::string::npos);
  EXPECT_NE(said("uncertainty = ", "uncertainty = -").find("allowed"), std::string::npos);
  EXPECT_NE(said("model_modes = ", "model_modes = -").find("allowed: 0 to 100"), std::string::npos);
  EXPECT_NE(said("[[controller.plane]]",
                 "[[controller.plane]]\nat = \"A\"\n[[controller.plane]]\nforce = 1.0\n")
                .find("force"),
            std::string::npos);
}

}  // namespace
}  // namespace ambrig
