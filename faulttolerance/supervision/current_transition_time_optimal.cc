#include "faulttolerance/supervision/current_transition_policy.h"

namespace ambrig {

namespace {

class TimeOptimal : public CurrentTransition {
 public:
  explicit TimeOptimal(const TransitionStart& s)
      : now_(s.now), rate_(InductanceOf(s) / s.period), voltage_(s.voltage) {
    for (int j = 0; j < 8; ++j)
      if (s.bearing.turns_left[j] == 0) rate_.row(j).setZero();
  }
  CoilVector Step(const CoilVector& wanted, const Eigen::Vector2d&) override {
    if (done_) return wanted;
    const double needed = (rate_ * (wanted - now_)).cwiseAbs().maxCoeff();  // [V] of the worst coil
    done_ = needed <= voltage_;
    now_ = done_ ? wanted : CoilVector(now_ + voltage_ / needed * (wanted - now_));
    return now_;
  }
  bool done() const override { return done_; }
  std::unique_ptr<CurrentTransition> Clone() const override {
    return std::make_unique<TimeOptimal>(*this);
  }

 private:
  CoilVector now_;
  CoilForm rate_;  // [V/A]
  double voltage_;
  bool done_ = false;
};

}  // namespace

std::unique_ptr<CurrentTransition> MakeTimeOptimal(const TransitionStart& start) {
  return std::make_unique<TimeOptimal>(start);
}

}  // namespace ambrig
