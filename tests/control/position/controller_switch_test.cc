/// Changing over between controllers: no step of the force, and the new one's law afterwards.
#include "control/position/controller_switch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "control/position/filtered_pid.h"
#include "control/position/state_space_controller.h"

namespace ambrig {
namespace {

constexpr double kTs = 80e-6;
constexpr PidParameters kSoft = {2e5, 500, 3e6, 1.5e-4, 60}, kHard = {4e5, 900, 6e6, 1.5e-4, 60};

std::unique_ptr<PositionController> Lead() {
  return std::make_unique<StateSpaceController>(
      std::vector<double>{0},
      std::vector<StateSpace>{FromTransferFunction({3e6, -2.7e6}, {1, -0.3})},
      std::vector<double>{60});
}

std::unique_ptr<ControllerSwitch> Make() {
  std::vector<std::unique_ptr<PositionController>> all;
  all.push_back(std::make_unique<DecentralisedPid>(std::vector<PidParameters>{kSoft}, kTs));
  all.push_back(std::make_unique<DecentralisedPid>(std::vector<PidParameters>{kHard}, kTs));
  all.push_back(Lead());
  return std::make_unique<ControllerSwitch>(std::move(all), std::vector<double>{60}, kTs);
}

double Motion(int n) { return 4e-6 * std::sin(0.02 * n) + 1e-6; }

// The period of the change has the old controller's force exactly; the next differ by no more than
// the motion asks for.
TEST(ControllerSwitch, TheForceHasNoStep) {
  for (const std::size_t to : {std::size_t{1}, std::size_t{2}}) {
    auto k = Make();
    DecentralisedPid alone({kSoft}, kTs);
    k->Hold({15}, {0}, {0});
    alone.Hold({15}, {0}, {0});
    std::vector<double> f(1), g(1), before(1);
    double usual = 0, at_change = 0;
    for (int n = 0; n < 600; ++n) {
      if (n == 500) k->SwitchTo(to);
      before = f;
      k->Step({Motion(n)}, {0}, {0}, 0, f);
      if (n <= 500) {
        alone.Step({Motion(n)}, {0}, {0}, 0, g);
        EXPECT_EQ(f[0], g[0]) << n;
      }
      const double step = std::abs(f[0] - before[0]);
      if (n > 100 && n < 500) usual = std::max(usual, step);
      if (n >= 500 && n < 510) at_change = std::max(at_change, step);
    }
    EXPECT_LT(at_change, 4 * usual) << to;  // twice the gains, another lead
    EXPECT_EQ(k->in_charge(), to);
  }
}

// When the difference has faded the new one's law rules: for the plain lead that is a known force.
TEST(ControllerSwitch, TheNewLawRules) {
  auto k = Make();
  k->Hold({0}, {0}, {0});
  std::vector<double> f(1);
  for (int n = 0; n < 100; ++n) k->Step({0}, {0}, {0}, 0, f);
  k->SwitchTo(2);
  for (int n = 0; n < 20000; ++n) k->Step({n < 50 ? 0 : -1e-6}, {0}, {0}, 0, f);
  EXPECT_NEAR(f[0], 0.3e6 / 0.7 * 1e-6, 1e-6);
}

TEST(ControllerSwitch, ACloneGoesOnAlike) {
  auto k = Make();
  std::vector<double> f(1), g(1);
  for (int n = 0; n < 100; ++n) {
    if (n == 90) k->SwitchTo(1);
    k->Step({Motion(n)}, {0}, {0}, 0, f);
  }
  const auto copy = k->Clone();
  for (int n = 100; n < 200; ++n) {
    k->Step({Motion(n)}, {0}, {0}, 0, f);
    copy->Step({Motion(n)}, {0}, {0}, 0, g);
    EXPECT_EQ(f[0], g[0]);
  }
}

}  // namespace
}  // namespace ambrig
