#pragma once
/// The paper's detector for one uncoupled coil: slope of the sampled load current in both phases of
/// the switching period against theoretical limits.
///
///   k_n  = G_f (a_(n+1) - a_n) U_ref / (2^m R_a T_n)            Eq. 19, ADC codes a to A/s
///   kept: k_n whose two neighbours have its sign; others are singular and cancelled
///   k̄    = mean of the kept slopes of a phase                   Eq. 20
///   k_inc = (U_d - 2 U_s)/L - i0/τ,   k_dec = -(U_d + 2 U_c)/L - i0/τ       Eq. 4, 8, τ = L/R
///   k_max at t = 0, k_min at t = T/2: times exp(-T/(2 τ))                   Eq. 9
///
/// 18 samples a period at 450 kHz and 25 kHz. The algorithm looks once per cycle (1.75 ms in the
/// paper; 0: every period). In a coupled stator neighbours and motion move these slopes by far more
/// than the limits: there use bearing_detector.h.
/// Source: [loadcurrentslope] (docs/references.bib), sections 2 to 4.
#include <vector>

#include "fdd/diagnosis.h"

namespace ambrig {

/// Error budget of a mean slope, section 4.1 of the paper. [A/s]
inline constexpr double kSlopeErrorBudget = 700;

/// Analogue path and converter of one coil's current.
struct SlopeConverter {
  double attenuation = 1;          // G_f
  double sampling_resistance = 1;  // R_a [ohm]
  double reference = 10;           // U_ref [V]
  int bits = 12;                   // m
  double period = 1 / 450e3;       // T_n [s]

  /// Eq. 19. [A/s]
  double Slope(long a, long next) const;
  /// Code of a current, rounded. [A] -> codes
  long Code(double current) const;
};

/// The coil and its bridge.
struct SlopeCircuit {
  double bus = 30, switch_drop = 0, diode_drop = 0;  // U_d, U_s, U_c [V]
  double inductance = 1.75e-3, resistance = 0.5;     // [H], [ohm]
  double switching_period = 40e-6;                   // T [s]
};

struct SlopeRange {
  double low = 0, high = 0;  // [A/s]
  bool Contains(double k) const { return k >= low && k <= high; }
};

/// Eq. 4 and 8: slope at the start of the phase for an initial current i0 [A]. [A/s]
double IncreasingSlope(const SlopeCircuit& c, double i0);
double DecreasingSlope(const SlopeCircuit& c, double i0);
/// Eq. 9, widened by `margin` [A/s] on both sides.
SlopeRange IncreasingRange(const SlopeCircuit& c, double i0, double margin = 0);
SlopeRange DecreasingRange(const SlopeCircuit& c, double i0, double margin = 0);

struct MeanSlopes {
  double increasing = 0, decreasing = 0;  // k̄ of the kept slopes, 0 when none [A/s]
  int kept_increasing = 0, kept_decreasing = 0, cancelled = 0;
};

/// Singularity rule: +1 for a slope that is kept as increasing, -1 as decreasing, 0 for a cancelled
/// one.
std::vector<int> KeptSlopes(const std::vector<double>& k);
/// Singularity rule and Eq. 20 over a queue of codes.
MeanSlopes MeanSlopesOf(const SlopeConverter& converter, const std::vector<long>& codes);

struct SlopeDetectorSettings {
  SlopeConverter converter;
  SlopeCircuit circuit;
  int samples_per_period = 18;
  double margin = 700;  // total error of the paper's section 4.1 [A/s]
  double cycle = 0;     // [s], 1.75e-3 in the paper; 0: every period
};

/// One instance per coil.
class SlopeDetector {
 public:
  explicit SlopeDetector(const SlopeDetectorSettings& settings) : s_(settings) {}

  /// One ADC sample; i0: current at the start of the switching period [A]. True when a fault is
  /// first flagged.
  bool Sample(long code, double i0);
  bool flagged() const { return cls_ != FaultClass::kNone; }
  /// Slope too small: open; too large: partial short.
  FaultClass fault_class() const { return cls_; }
  const MeanSlopes& slopes() const { return last_; }

 private:
  bool EvaluateStatistic(double i0);

  SlopeDetectorSettings s_;
  std::vector<long> queue_;
  MeanSlopes last_;
  FaultClass cls_ = FaultClass::kNone;
  double since_ = 0;  // last look [s]
};

}  // namespace ambrig
