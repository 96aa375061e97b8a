#include "faulttolerance/supervision/hand_over_policy.h"

namespace ambrig {

namespace {

class Jump : public HandOver {
 public:
  SetPointVector Step(const SetPointVector& wanted, const Eigen::Vector2d&) override {
    return wanted;
  }
  bool done() const override { return true; }
  std::unique_ptr<HandOver> Clone() const override { return std::make_unique<Jump>(*this); }
};

}  // namespace

std::unique_ptr<HandOver> MakeJump() { return std::make_unique<Jump>(); }

}  // namespace ambrig
