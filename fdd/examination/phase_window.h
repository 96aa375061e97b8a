#pragma once
/// What one phase of a switching period tells of a suspected coil: its own voltage equation, and
/// the slope of its flux as the other coils' equations give it, which makes no use of the suspect's
/// current.
#include <vector>

#include "fdd/measurement/kept_period.h"
#include "fdd/model/linkage_model.h"

namespace ambrig {

/// One phase of the suspect in one period.
struct PhaseWindow {
  int phase = 0;
  double v = 0, v_other = 0;   // of this phase and of the other one [V]
  double e = 0, F = 0;         // nominal residual, flux slope told by the other coils [V]
  double x_l = 0, x_r = 0;     // L_l di/dt, R i [V]
  double own = 0;              // L_jj di/dt [V]
  double mean = 0, least = 0;  // current [A]
  double sd_e = 0, sd_f = 0, noise_l = 0, noise_own = 0;  // [V]
  double Rest() const { return e + v - own; }  // what the neighbours, motion and R i take [V]
  /// Off phases that reach zero current obey no equation.
  bool Applies() const { return phase == 0 || least > kZeroCurrent; }
};

/// Slope of the straight line through y[from] .. y[from + count - 1], `step` apart. [1/s of y's
/// unit]
double SlopeOf(const double* y, int from, int count, double step);

/// Windows of coil j in one period that may be used; appended.
void AddWindows(const LinkageModel& m, const DetectorSettings& s, const KeptPeriod& p, int j,
                std::vector<PhaseWindow>* out);

}  // namespace ambrig
