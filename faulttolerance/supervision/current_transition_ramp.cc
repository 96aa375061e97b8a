#include "faulttolerance/supervision/current_transition_policy.h"

namespace ambrig {

namespace {

class Ramp : public CurrentTransition {
 public:
  explicit Ramp(const TransitionStart& s) : now_(s.now), step_(RampStep(s)) {}
  CoilVector Step(const CoilVector& wanted, const Eigen::Vector2d&) override {
    if (done_) return wanted;
    now_ += (wanted - now_).cwiseMin(step_).cwiseMax(-step_);
    done_ = now_ == wanted;
    return now_;
  }
  bool done() const override { return done_; }
  std::unique_ptr<CurrentTransition> Clone() const override {
    return std::make_unique<Ramp>(*this);
  }

 private:
  CoilVector now_;
  CoilVector step_;
  bool done_ = false;
};

}  // namespace

std::unique_ptr<CurrentTransition> MakeRamp(const TransitionStart& start) {
  return std::make_unique<Ramp>(start);
}

}  // namespace ambrig
