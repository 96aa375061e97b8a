#include "faulttolerance/supervision/hand_over_policy.h"

namespace ambrig {

namespace {

class Ramp : public HandOver {
 public:
  explicit Ramp(const HandOverStart& s) : now_(s.now), step_(RampStep(s)) {}
  SetPointVector Step(const SetPointVector& wanted, const Eigen::Vector2d&) override {
    if (done_) return wanted;
    now_ += (wanted - now_).cwiseMin(step_).cwiseMax(-step_);
    done_ = now_ == wanted;
    return now_;
  }
  bool done() const override { return done_; }
  std::unique_ptr<HandOver> Clone() const override { return std::make_unique<Ramp>(*this); }

 private:
  SetPointVector now_;
  Coils step_;
  bool done_ = false;
};

}  // namespace

std::unique_ptr<HandOver> MakeRamp(const HandOverStart& start) {
  return std::make_unique<Ramp>(start);
}

}  // namespace ambrig
