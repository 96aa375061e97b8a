#pragma once
/// Coils of any stator whose slopes are wrong although they carry current, from the linkages
/// between ADC samples:
///
///   E = λ(i, r) at sample k+1 - at sample k - D,   D = ∫ (v - R i) dt of a healthy bridge   [Wb]
///   c = Σ E D/Σ D²  over a window, separately where the bridge drives up (D > 0) and down
///
/// λ is the nominal network's with the measured currents of all coils (pole_network.h). A healthy
/// coil has c = 0 in both phases; a share s of its turns bypassed (1 - s)^-2 - 1; a current sensor
/// with the gain g about g - 1, a frozen one -1; a switch that stays on 0 up and -2 down. Gross
/// ones are told, twice in a row: tolerances of gap and leakage leave tenths. The window is as long
/// as the noise of the samples asks for. Source: docs/theory/stators.md.
#include <array>

#include "fdd/diagnosis.h"
#include "fdd/measurement/period_slopes.h"
#include "fdd/model/linkage_model.h"

namespace ambrig {

class LinkagePhases {
 public:
  /// `noise`: rms of an ADC sample [A]. The model must have a network.
  LinkagePhases(const LinkageModel& model, const SamplingSettings& sampling, double noise);

  /// One period. Returns the fault of the coil that is farthest from health, or none.
  /// `lost`: coils that are not judged.
  Diagnosis Period(const MeasuredPeriod& in, const std::array<bool, kLanes>& lost);
  /// Of coil j's turns, as far as they were diagnosed.
  double share(int j) const { return share_[static_cast<std::size_t>(j)]; }
  /// Linkages for currents [A] with the shaft at (x, y) [m].
  Lane Linkages(const Lane& current, double x, double y) const;
  /// Periods of a window.
  int window() const { return window_; }

 private:
  struct Phase {
    double product = 0, square = 0;  // Σ E D, Σ D² [Wb²]
    double c() const { return square > 0 ? product / square : 0; }
  };
  WindingMatrix InductanceAt(double x, double y) const;
  Lane LinkagesOf(const WindingMatrix& L, const Lane& current) const;
  void Add(const MeasuredPeriod& in);
  Diagnosis Decide(double end, const std::array<bool, kLanes>& lost);
  /// Of one coil in the window that ends.
  FaultClass ClassOf(int j, double* fraction) const;
  void Begin();

  LinkageModel model_;
  SamplingSettings sampling_;
  int window_ = 3, seen_ = 0;
  double start_ = 0;
  std::array<Phase, kLanes> up_{}, down_{};
  double least_square_ = 0;                  // of a phase whose c tells something [Wb²]
  Lane current_;                             // Σ |i| of the window's samples [A]
  Lane least_current_;                       // of |i| in the window [A]
  std::array<FaultClass, kLanes> before_{};  // of the last window
  std::array<double, kLanes> onset_{};
  std::array<double, kLanes> share_{};
};

}  // namespace ambrig
