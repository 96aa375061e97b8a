#pragma once
/// When the shaft may be touching, and for how long after that its bounces move the currents.
#include "core/base/parameters.h"
#include "fdd/measurement/period_slopes.h"

namespace ambrig {

class TouchMonitor {
 public:
  void Update(const MeasuredPeriod& in) {
    touching_ = in.uncertainty.any();
    if (touching_) touched_ = in.t;
    bounces_ = in.t < touched_ + kBounces;
  }
  bool touching() const { return touching_; }
  /// Whether the last possible contact was less than 10 ms ago.
  bool bounces() const { return bounces_; }

 private:
  static constexpr double kBounces = 10e-3;  // [s] after a contact: currents follow no set-point
  double touched_ = -kInfinity;              // start of the last period that touched [s]
  bool touching_ = false, bounces_ = false;
};

}  // namespace ambrig
