// Controllers side by side: each sees its own axes, in its own order, and nothing of the others.
#include "control/position/axis_groups.h"

#include <gtest/gtest.h>

#include <memory>
#include <numeric>

namespace ambrig {
namespace {

/// f = -gain y_k + Σ of the group's readings, plus what it holds; remembers what it was told.
class Gains : public PositionController {
 public:
  Gains(std::size_t axes, double gain) : held_(axes, 0.0), gain_(gain) {}
  void Step(const std::vector<double>& y, const std::vector<double>& r,
            const std::vector<double>& excitation, double Omega, std::vector<double>& f) override {
    const double sum = std::accumulate(y.begin(), y.end(), 0.0);
    for (std::size_t k = 0; k < y.size(); ++k)
      f[k] = -gain_ * (y[k] - r[k]) + sum + excitation[k] + held_[k] + 1e-6 * Omega;
  }
  void Hold(const std::vector<double>& force, const std::vector<double>&,
            const std::vector<double>&) override {
    held_ = force;
  }
  StateSpace Linear(double) const override {
    const auto n = static_cast<Eigen::Index>(held_.size());
    return StateSpace::Gain(Eigen::MatrixXd::Ones(n, n) - gain_ * Eigen::MatrixXd::Identity(n, n));
  }
  std::unique_ptr<PositionController> Clone() const override {
    return std::make_unique<Gains>(*this);
  }

 private:
  std::vector<double> held_;
  double gain_;
};

AxisGroups Two() {
  std::vector<AxisGroup> groups(2);
  groups[0].axes = {3, 0};  // not in order
  groups[0].controller = std::make_unique<Gains>(2, 10);
  groups[1].axes = {1, 2, 4};
  groups[1].controller = std::make_unique<Gains>(3, 100);
  return AxisGroups(std::move(groups));
}

const std::vector<double> kY = {1, 2, 3, 4, 5}, kR = {0.1, 0.2, 0.3, 0.4, 0.5},
                          kE = {7, 8, 9, 10, 11};

TEST(AxisGroups, EveryControllerHasItsOwnAxes) {
  AxisGroups groups = Two();
  std::vector<double> f(5, 0);
  groups.Step(kY, kR, kE, 300, f);
  for (const std::size_t k : {0u, 3u})
    EXPECT_NEAR(f[k], -10 * (kY[k] - kR[k]) + 5 + kE[k] + 3e-4, 1e-12);
  for (const std::size_t k : {1u, 2u, 4u})
    EXPECT_NEAR(f[k], -100 * (kY[k] - kR[k]) + 10 + kE[k] + 3e-4, 1e-12);
}

TEST(AxisGroups, HeldForcesGoToTheirAxes) {
  AxisGroups groups = Two();
  const std::vector<double> none(5, 0.0), force = {0.5, 1.5, 2.5, 3.5, 4.5};
  groups.Hold(force, none, none);
  std::vector<double> f(5, 0);
  groups.Step(none, none, none, 0, f);
  EXPECT_EQ(f, force);
}

// The linear system is that of the steps, axis by axis.
TEST(AxisGroups, LinearIsWhatSteppingDoes) {
  AxisGroups groups = Two();
  const Eigen::MatrixXd D = groups.Linear(0).D;
  const std::vector<double> none(5, 0.0);
  for (std::size_t k = 0; k < 5; ++k) {
    std::vector<double> y(5, 0.0), f(5, 0.0);
    y[k] = 1;
    groups.Step(y, none, none, 0, f);
    for (std::size_t j = 0; j < 5; ++j)
      EXPECT_NEAR(D(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k)), f[j], 1e-12);
  }
}

TEST(AxisGroups, ACloneGoesItsOwnWay) {
  AxisGroups groups = Two();
  const auto clone = groups.Clone();
  const std::vector<double> none(5, 0.0), force(5, 2.0);
  groups.Hold(force, none, none);
  std::vector<double> f(5, 9.0);
  clone->Step(none, none, none, 0, f);
  EXPECT_EQ(f, none);
}

}  // namespace
}  // namespace ambrig
