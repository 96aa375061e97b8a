#include "fdd/learning/commissioning_log.h"

namespace ambrig {

void CommissioningLog::Add(const MeasuredPeriod& in) {
  Kept kept;
  kept.in = in;
  kept.duty = *in.duty;
  if (in.set_point) kept.set_point = *in.set_point;
  adc_.insert(adc_.end(), in.adc, in.adc + samples_);
  periods_.push_back(kept);
}

MeasuredPeriod CommissioningLog::At(std::size_t n) const {
  const Kept& kept = periods_[n];
  MeasuredPeriod in = kept.in;
  in.adc = adc_.data() + n * static_cast<std::size_t>(samples_);
  in.duty = &kept.duty;
  in.set_point = kept.in.set_point ? &kept.set_point : nullptr;
  return in;
}

}  // namespace ambrig
