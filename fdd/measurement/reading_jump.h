#pragma once
/// Steps of a current reading between two ADC samples that no voltage can make. Two limits:
///
///   V h/L_leak   anywhere: the inductance of a coil is never below its leakage; beside edges at
///                least 1.25 times what was seen there, of a coil with less leakage than nominal
///   s h + half   but for three intervals after the edge in a period: there the current goes on by
///                the steps that it made in the period before, however small the inductance is that
///                the iron's eddy currents leave
///
/// A sensor whose offset or gain steps shows such a step, and so does a coil whose current or turns
/// vanish at once; the slopes afterwards tell which.
#include "fdd/measurement/period_slopes.h"

namespace ambrig {

class ReadingJump {
 public:
  /// `noise`: of a sample, quantisation included [A rms].
  ReadingJump(const LinkageModel& nominal, const SamplingSettings& sampling, double noise);

  /// Net sum of the impossible steps of every coil in this period, that from the last sample of the
  /// period before included, if at least 0.2 A; 0: none [A]. A single wrong sample steps there and
  /// back: nothing. `conducts`: every sample of every coil is known to be above kSurelyConducts.
  Lane Period(const MeasuredPeriod& in, bool conducts = false);

  /// Largest steps of the last period, up or down [A].
  const Lane& largest() const { return state_.largest; }

  /// Mean step of a phase, or of one interval, in the last period; count 0: not known.
  struct PhaseStep {
    Lane mean, count;  // [A], intervals
  };
  struct State {
    Lane last;           // sample [A]
    PhaseStep known[4];  // on, off, intervals 1 and 2 of a period
    Lane fall, rise;     // largest steps beside edges [A]
    Lane largest;        // step of the last period [A]
  };

 private:
  SamplingSettings sampling_;
  Lane coils_;     // 1; 0 in lanes without one
  Lane per_volt_;  // largest step over the bus voltage [A/V]
  double noise_ = 0;
  State state_;
  bool started_ = false;
};

}  // namespace ambrig
