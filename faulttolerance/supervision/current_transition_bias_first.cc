#include "faulttolerance/supervision/current_transition_policy.h"

namespace ambrig {

namespace {

class BiasFirst : public CurrentTransition {
 public:
  explicit BiasFirst(const TransitionStart& s)
      : bias_(s.bias_before.cwiseProduct(Live(s))),
        control_(s.now - bias_),
        bias_after_(s.bias_after),
        step_(RampStep(s)),
        least_(s.bearing.quadrants == 2 ? 0 : -s.bearing.i_max),
        most_(s.bearing.i_max) {}
  CoilVector Step(const CoilVector& wanted, const Eigen::Vector2d&) override {
    if (done_) return wanted;
    const CoilVector bias = Toward(bias_, bias_after_);
    if (bias != bias_) {
      bias_ = bias;
    } else {
      const CoilVector control = wanted - bias_;
      control_ = Toward(control_, control);
      done_ = control_ == control;
    }
    return (bias_ + control_).cwiseMax(least_).cwiseMin(most_);
  }
  bool done() const override { return done_; }
  std::unique_ptr<CurrentTransition> Clone() const override {
    return std::make_unique<BiasFirst>(*this);
  }

 private:
  static CoilVector Live(const TransitionStart& s) {
    return (s.bearing.turns_left.array() > 0).cast<double>();
  }
  CoilVector Toward(const CoilVector& from, const CoilVector& to) const {
    return from + (to - from).cwiseMin(step_).cwiseMax(-step_);
  }

  CoilVector bias_, control_, bias_after_;
  CoilVector step_;
  double least_, most_;
  bool done_ = false;
};

}  // namespace

std::unique_ptr<CurrentTransition> MakeBiasFirst(const TransitionStart& start) {
  return std::make_unique<BiasFirst>(start);
}

}  // namespace ambrig
