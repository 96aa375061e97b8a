#pragma once
/// What was measured of one bearing while its healthy machine was being commissioned: every ADC
/// sample, kept, because a record of means does not hold the slopes.
#include <vector>

#include "fdd/measurement/period_slopes.h"

namespace ambrig {

class CommissioningLog {
 public:
  explicit CommissioningLog(int samples) : samples_(samples) {}

  void Add(const MeasuredPeriod& in);
  std::size_t size() const { return periods_.size(); }
  /// Period n; valid while the log is not changed.
  MeasuredPeriod At(std::size_t n) const;

 private:
  struct Kept {
    MeasuredPeriod in;
    Lane duty, set_point;
  };
  int samples_;
  std::vector<Kept> periods_;
  std::vector<Lane> adc_;
};

}  // namespace ambrig
