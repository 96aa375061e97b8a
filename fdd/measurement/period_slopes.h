#pragma once
/// One switching period of a bearing, seen through its ADC samples: for every coil and both phases
/// (on: bridge drives up, off: bridge drives down) the least-squares slopes of the linkage and of
/// the current. With the measured currents of all coils in the nominal λ(i, x, y) each coil obeys
///
///   dλ_j/dt = v_j - R i_j        so   e_j = slope(λ_j) + R mean(i_j) - v_j   [V]
///
/// is zero but for noise and tolerances, whatever the neighbours do: what they switch is in their
/// currents. (Plain current slopes of a coupled stator move by tens of percent: published_values.md
/// 1.2.)
#include <array>

#include "actuators/electronics/amplifier_parameters.h"
#include "fdd/model/linkage_model.h"

namespace ambrig {

/// [A] below: a coil carries no current or its diodes may block, offsets of the ADC included
inline constexpr double kConducts = 0.12;

/// [A] above: a coil carries current whatever the zero of its sensor is
inline constexpr double kSurelyConducts = 0.25;

inline constexpr double kZeroCurrent = 0.03;  // [A] below: the diodes may block

/// Bounds of what is not known of the shaft's motion at a bearing plane.
struct MotionUncertainty {
  double velocity = 0;  // [m/s]
  double position = 0;  // [m]
  bool any() const { return velocity > 0 || position > 0; }
};

/// What was measured of one period; positions at the bearing plane at its start and end.
struct MeasuredPeriod {
  double t = 0;               // start [s]
  const Lane* adc = nullptr;  // samples [A]
  const Lane* duty = nullptr;
  const Lane* set_point = nullptr;        // that the current loops followed [A]; may be absent
  double bus = 0;                         // mean over the period [V]
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // [m]
  double angle0 = 0, angle1 = 0;          // of the shaft at its start and end [rad]
  MotionUncertainty uncertainty;          // of these positions
  bool comparable = true;  // false: bus or position unknown, nothing can be concluded
};

/// One phase of all coils.
struct PhaseSlopes {
  Lane samples;   // in the phase
  Lane voltage;   // of the healthy bridge [V]
  Lane linkage;   // slope [V]
  Lane current;   // slope [A/s]
  Lane mean;      // current [A]
  Lane least;     // smallest sample, or of either phase where no coil comes below kZeroCurrent [A]
  Lane residual;  // e [V]
  // 12/(n (n²-1) h) of n samples, 0 below two: the slope's variance is scale/h [1/s]
  Lane scale;
};

/// Sums over the samples k that the slopes are made of: of x and of k x.
struct SlopeSums {
  Lane y_on, ky_on, y, ky;  // linkage: on phase, whole period
  Lane i_on, ki_on, i, ki;  // current
};

struct PeriodSlopes {
  PhaseSlopes phase[2];  // on, off
  SlopeSums sums;
  Lane edge;  // end of the on phase [s]
  MovingPermeance permeance;
  Lane largest;      // sample of the period [A]
  Lane first, last;  // linkage at the first and the last sample [Wb]
  Lane after;        // mean voltage between the last sample and the end of the period [V]
};

/// Geometry of the samples and the amplifier: fixed for a run.
struct SamplingSettings {
  int samples = 18;
  double step = 0;  // between samples [s]
  const AmplifierParameters* amplifier = nullptr;
};

/// Voltages of a healthy bridge: `on` until `edge` [s], `off` after it.
struct BridgeVoltage {
  double edge = 0, on = 0, off = 0;
};
BridgeVoltage VoltageOf(const AmplifierParameters& p, double duty, double bus);

void ComputePeriodSlopes(const LinkageModel& m, const SamplingSettings& s, const MeasuredPeriod& in,
                         PeriodSlopes* out);

/// The same when the magnetomotive force of some coils is not known (false sensor, a closed loop of
/// shorted turns): the error of the rotor's potential U(t) is estimated from the other coils'
/// equations, sample by sample, and taken out of them. Radial bearings.
void ComputePeriodSlopesUnknownMmf(const LinkageModel& m, const SamplingSettings& s,
                                   const MeasuredPeriod& in,
                                   const std::array<bool, kLanes>& excluded, PeriodSlopes* out);

/// 1/(step² n (n²-1)/12): variance of a slope over n samples of unit variance. [1/s²]
double SlopeVariance(double n, double step);

}  // namespace ambrig
