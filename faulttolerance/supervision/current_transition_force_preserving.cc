#include <algorithm>

#include "faulttolerance/redistribution/network_force.h"
#include "faulttolerance/supervision/current_transition_policy.h"

namespace ambrig {

namespace {

constexpr int kCorrections = 3;
// periods: where the force cannot be kept on the way, the way ends all the same
constexpr int kLongest = 60;

class ForcePreserving : public CurrentTransition {
 public:
  explicit ForcePreserving(const TransitionStart& s)
      : now_(s.now),
        step_(RampStep(s)),
        network_(s.bearing),
        least_(s.bearing.quadrants == 2 ? 0 : -s.bearing.i_max),
        most_(s.bearing.i_max),
        damping_(1e-4 * ForceFactor(s.bearing) * ForceFactor(s.bearing) * s.bearing.c0 *
                 s.bearing.c0) {}
  CoilVector Step(const CoilVector& wanted, const Eigen::Vector2d& force) override {
    if (done_) return wanted;
    const CoilVector way = wanted - now_;
    double share = 1;
    for (int j = 0; j < 8; ++j)
      if (std::abs(way[j]) > step_[j]) share = std::min(share, step_[j] / std::abs(way[j]));
    done_ = share == 1 || ++periods_ >= kLongest;
    if (done_) return now_ = wanted;
    const CoilVector low = (now_ - step_).cwiseMax(least_), high = (now_ + step_).cwiseMin(most_);
    now_ += share * way;
    for (int n = 0; n < kCorrections; ++n) {  // least change of the currents that gives the force
      ForceGradient J;
      const Eigen::Vector2d missing = force - network_.Force(now_, &J);
      const Eigen::Matrix2d S = J * J.transpose() + damping_ * Eigen::Matrix2d::Identity();
      now_ = (now_ + J.transpose() * (S.inverse() * missing)).cwiseMax(low).cwiseMin(high);
    }
    return now_;
  }
  bool done() const override { return done_; }
  std::unique_ptr<CurrentTransition> Clone() const override {
    return std::make_unique<ForcePreserving>(*this);
  }

 private:
  CoilVector now_;
  CoilVector step_;
  NetworkForce network_;
  double least_, most_, damping_;
  int periods_ = 0;
  bool done_ = false;
};

}  // namespace

std::unique_ptr<CurrentTransition> MakeForcePreserving(const TransitionStart& start) {
  return std::make_unique<ForcePreserving>(start);
}

}  // namespace ambrig
