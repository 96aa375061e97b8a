#pragma once
/// What the detector of one bearing is set to, and what it keeps of a switching period for an
/// examination.
#include <array>

#include "fdd/detectors/residual_chart.h"

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
  MeasuredPeriod in;
  std::array<Lane, 64> adc;
  Lane duty;
};

}  // namespace ambrig
