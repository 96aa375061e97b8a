#pragma once
/// Kalman filter of the coupled coils of one bearing and the chi-square test of its innovations.
///
///   state        λ, linkages of all coils [Wb]
///   prediction   λ(k+1) = λ(k) + ∫v dt - R i h,  i = L(x, y)^-1 λ          per ADC sample, h
///                v of the healthy bridges;
///                  a coil that a diode keeps from going negative stays at 0 A
///   measurement  y = L^-1 λ + ADC noise
///   process      voltage error per sample, sd σ_v: drops,
///     bus and the tolerances of gap and leakage
///                times the bus (a constant error taken as a white one: it makes the filter quick)
///   innovation   ν = y - L^-1 λ(k|k-1),  covariance S = C P C' + r I
///   statistic    Σ ν_j² / S_jj over the samples of a period, over their number: 1 without a fault,
///                chi-square with 18 degrees of freedom over 18
///
/// Covariance and gain follow the Riccati recursion of the sample rate, one step a period: the gap
/// moves by less than a thousandth in a sample, and the steady state is reached within some
/// periods. Between periods L^-1 runs linearly from the sensed position at the start to that at the
/// end. Source: Mehra and Peschon, Automatica 7 (1971), innovations as a fault test; Noel, Tammi,
/// Buckner 2008 (Kalman filter on magnetic bearings).
#include "fdd/circuit/inductance_matrix.h"
#include "fdd/detectors/coil_detector.h"

namespace ambrig {

class LinkageKalman : public CoilDetector {
 public:
  explicit LinkageKalman(const CoilDetectorSetup& setup);
  Lane Period(const MeasuredPeriod& in) override;

  /// Of the last period: ν/sqrt(S_jj) of coil j at sample k.
  double innovation(int k, int j) const { return scaled_[k][j]; }
  double process_sd() const { return process_sd_; }  // of λ, per sample [Wb]

 private:
  void StepCovariance(const LinkageMatrix& C);
  void Begin(const MeasuredPeriod& in, const LinkageMatrix& L);
  /// Linkages from sample k to the next one.
  void Predict(const MeasuredPeriod& in, const LinkageVector& current, int k);

  LinkageModel model_;
  DetectorSettings s_;
  double process_sd_ = 0;
  LinkageVector lambda_;    // predicted for the next sample [Wb]
  LinkageMatrix P_, gain_;  // covariance of λ [Wb²]; [H]
  LinkageVector sd_;        // sqrt of the diagonal of S [A]
  Lane scaled_[64];
  bool running_ = false;
};

}  // namespace ambrig
