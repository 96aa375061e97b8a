#pragma once
/// Fault detection for the coupled coils of one bearing, once per switching period, from nominal
/// parameters and measurements alone.
///
/// Watching: residuals e [V] of both phases of every coil (period_slopes.h) over their expected
/// size s (ADC noise, tolerances of gap and leakage, position) go into CUSUMs
///   G <- max(0, G + min(|z|, 12) - 2.5),  z = e/s,      alarm at G > 9,
/// for on, off and (z_on - z_off)/√2, the signature of an inductance that changed. One gross
/// residual is enough; noise alone needs e^-40. A step of the linkage between two periods, where no
/// phase sees it, raises the alarm when it is beyond 12 s.
/// Slow adaptation: leakage and gap of the bearing are learned from the residuals
/// (model_learning.h; what is not learned yet widens s), and s follows each coil's long-term
/// residual. Suspect: the coil without whose current all other coils obey their equations best.
/// Examining: after an alarm the raw samples of the last periods are tested against all fault
/// hypotheses (coil_examination.h) until one is certain or the alarm is cleared; shorts of several
/// coils at once are tested together (shorted_coils.h).
/// Afterwards the model knows the fault (masked coil, fewer turns) and watching goes on.
///
/// Where the MMF of a coil is not known (false or clipped reading, current in shorted turns), its
/// change within a period is estimated from the other coils (period_slopes.h); what it was before
/// is not, and widens s by n (dP/dt) δU, δU from a current as large as the reading.
///
/// A coil with a false sensor carries nothing once its bridge has been kept off for 1 ms: its MMF
/// is known again, and its reading is taken as zero, also when a second fault is examined.
///
/// Another detector may watch instead (examined_detector.h): then its flags raise the
/// alarm, and the sums serve to tell when the bearing was healthy last.
///
/// A residual counts only where its equation holds: at least 4 samples in the phase, no current at
/// zero in the off phase (diodes block), no clipped ADC, a known bus and position, no gap nearly
/// closed.
#include <array>
#include <vector>

#include "fdd/detectors/run_detector.h"
#include "fdd/learning/model_learning.h"

namespace ambrig {

class BearingDetector : public RunDetector {
 public:
  enum class Coil { kHealthy, kLost, kShort, kUnknownMmf };
  using Alarm = DetectorAlarm;

  BearingDetector(const LinkageModel& model, const DetectorSettings& settings);

  Alarm Period(const MeasuredPeriod& in) override { return Next(in, nullptr); }
  /// The same when another detector watches: `flagged` is the coil that it finds faulty in this
  /// period, from 0, -1: none.
  Alarm PeriodWatchedBy(int flagged, const MeasuredPeriod& in) { return Next(in, &flagged); }
  /// Nothing is concluded from the next periods (a switch-over of currents, a start).
  void Pause(int periods) { paused_ = periods; }

  /// Expected on-phase slope of a healthy coil given everything else that was measured, and the
  /// half-width of its band [A/s]; from the last period.
  SlopeBand Band(int coil) const override;
  const PeriodSlopes& slopes() const { return slopes_; }
  const Lane& z(int phase) const { return chart_.z[phase]; }
  const ResidualChart& chart() const { return chart_; }
  Coil state(int j) const { return state_[static_cast<std::size_t>(j)]; }
  /// Nominal circuit with the faults that were diagnosed so far.
  const LinkageModel& model() const { return model_; }
  double leakage_error() const { return learning_.known().leakage; }  // learned [H]
  double gap_error() const { return learning_.known().gap; }          // learned, relative

 private:
  static constexpr int kRing = 20;                // periods kept
  static constexpr int kLongestExamination = 12;  // [periods]

  /// `flagged`: nullptr where the sums of the chart raise the alarm.
  Alarm Next(const MeasuredPeriod& measured, const int* flagged);
  /// While nothing is examined: whether this period raises the alarm, and for which coil.
  Alarm Watch(const MeasuredPeriod& in, int stepped, const int* flagged);
  void Residuals(const MeasuredPeriod& in);
  /// By how much the rotor's potential may be wrong for coils of unknown MMF [A turns].
  double UnknownPotential() const;
  /// Coil with the largest unexplained step of its linkage, -1: none.
  int StepBetweenPeriods(const Lane& last_linkage, const Lane& last_voltage,
                         const MeasuredPeriod& in);
  bool Holds(int phase, int coil) const { return chart_.valid[phase][coil] > 0; }
  void Keep(const MeasuredPeriod& in);
  /// Coils with a false reading whose bridge the controller has kept off carry nothing: zero
  /// replaces the reading in the period just kept, and the coil counts as lost.
  void MaskFaultyCurrentReadings();
  LinkageModel LearnedModel() const;
  int Largest() const;  // coil of the largest residual
  /// Coil without whose current all other coils' equations hold best; `clear`: by far.
  int Suspect(const std::vector<const KeptPeriod*>& periods, bool* clear) const;
  std::vector<const KeptPeriod*> LastPeriods(long long n) const;
  Diagnosis Examine();
  /// Coils whose turns were shorted together, when that explains all that is seen; else empty.
  std::vector<Diagnosis> ExamineTogether();
  /// Whether the coils beside the diagnosed one obey their equations when it is as `d` says.
  bool OthersHold(const LinkageModel& learned, const Diagnosis& d, bool closed_loop) const;
  void Accept(const Diagnosis& d, bool closed_loop);

  LinkageModel model_;
  DetectorSettings s_;
  PeriodSlopes slopes_;
  ResidualChart chart_;
  ModelLearning learning_;
  Lane watched_;  // 1: coils that may be judged
  std::array<Coil, kLanes> state_{};
  std::array<bool, kLanes> unknown_mmf_{};
  bool any_unknown_ = false;
  std::array<bool, kLanes> false_reading_{};
  bool any_false_reading_ = false;
  Lane off_for_;  // periods without duty
  std::vector<KeptPeriod> ring_;
  double centred_ = 0;  // largest permeance at the centre [H]
  long long count_ = 0, alarm_at_ = -1;
  long long calm_at_ = 0;  // last period without suspicion
  int paused_ = 8, suspect_ = -1;
  bool raised_ = false, suspect_clear_ = false;
  bool follows_ = false;  // the previous period is known
};

}  // namespace ambrig
