#pragma once
/// Steps of a current reading between two ADC samples that no voltage can make: the inductance of a
/// coil is never below its leakage, so a current moves by at most V h/L_leak from sample to sample.
/// A sensor whose offset or gain steps shows such a step, and so does a coil whose current or turns
/// vanish at once; the slopes afterwards tell which.
#include "fdd/measurement/period_slopes.h"

namespace ambrig {

class ReadingJump {
 public:
  /// `noise`: of a sample, quantisation included [A rms].
  ReadingJump(const LinkageModel& nominal, const SamplingSettings& sampling, double noise);

  /// Net sum of the impossible steps of every coil in this period, that from the last sample of the
  /// period before included; 0: none [A]. A single wrong sample steps there and back: nothing.
  Lane Period(const MeasuredPeriod& in);

 private:
  SamplingSettings sampling_;
  Lane per_volt_;  // largest step over the bus voltage [A/V]
  double noise_ = 0;
  Lane last_;
  bool started_ = false;
};

}  // namespace ambrig
