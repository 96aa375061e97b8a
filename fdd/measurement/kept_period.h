#pragma once
/// What the detector of one bearing is set to, and what it keeps of a switching period for an
/// examination.
#include <algorithm>
#include <array>

#include "fdd/measurement/residual_chart.h"

namespace ambrig {

struct DetectorSettings : ChartSettings {
  SamplingSettings sampling;
  double gap_sd = 0.01;            // relative
  double leakage_sd = 2e-5;        // [H]
  double current_quantum = 0.005;  // of the ADC [A]
  bool watch_only = false;         // no alarm: the sums go on (detector studies)
};

/// One period as kept for an examination.
struct KeptPeriod {
  MeasuredPeriod in;  // its samples and duties are the ones beside it
  std::array<Lane, 64> adc;
  Lane duty;

  void Keep(const MeasuredPeriod& period, int samples) {
    in = period;
    std::copy(period.adc, period.adc + samples, adc.begin());
    duty = *period.duty;
    in.adc = adc.data();
    in.duty = &duty;
  }
};

}  // namespace ambrig
