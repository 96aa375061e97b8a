#pragma once
/// The commissioned detector of one bearing: which coil's linkage moves by more or less than its
/// voltage accounts for (slope_excess.h), against what this bearing did when it was healthy.
///
/// A coil's ratio is the largest |c|/band over the windows, band = max(floor, 1.5 times the largest
/// of commissioning), at least 0.08 below zero, 0.15 for the windings of a thrust side. The coil of the largest ratio is
/// blamed when it stays above 1 in three periods in a row and a second indication agrees: either c of the on and of the off phase have one
/// sign and the smaller is at least 0.35 of the larger, or the current misses its set-point, or its
/// reading is zero while the bridge drives.
///
/// Where c is gross, the shares of the turns of all coils are solved for together
/// (joint_turns.h): several coils that fail at one instant move the c of each other and of healthy
/// neighbours. All coils that have lost turns by that solution, and all without current, are
/// blamed at once, unless what healthy running leaves of c could make up the loss.
///
/// Only gross values count in a period in which a phase starts at zero current, the shaft may be
/// touching (|c| > 0.5), or the flux leaves the range that was commissioned (c < -0.5 or c > 2; of coils
/// that stay inside while no more than two leave it c > 1). Lost turns make the flux that is computed too large, and
/// that alone takes a coil outside which was near the end of its range: where it leaves the range with a jump that no
/// voltage makes, the range is wider by that jump for the next 250 periods. Iron that saturates makes no jump.
///
/// Doubtful: not commissioned, grade too bad, outside the range, three coils beyond their bands at
/// once, or a pattern common to the coils beyond three times that of commissioning. Then a coil is
/// blamed only where c < -0.5 or > 2; unless the flux alone is outside the range, also its current
/// must be false, and fewer than three coils may have c > 0.5: what a nominal circuit does not know
/// keeps flux out, which makes c positive in many coils alike. Where the fit was learnt and refused, phases that agree
/// are enough for lost turns: its errors are tenths of c, and grow with the motion. Without a model that is relied on no
/// coil is blamed until 10 ms after the last possible contact, and for lost turns only where its c came from below 0.5
/// to above 2 within two periods: where iron that no model knows saturates, c grows over many.
///
/// A coil without current is one that is asked for some, or whose linkage moves by less than a
/// quarter of what its voltage would do: the diodes of a coil that is asked for none block. The c of a winding of a
/// thrust side without current is hardly below zero, as its partner moves the flux of both: it is one that misses
/// its set-point although it is driven at least as hard as its partner, and whose reading stands still beside the
/// partner's ripple.
///
/// After a coil was given up or lost turns, the others carry other currents than commissioned:
/// their bands are 2.5 times as wide from then on, and at least 0.25 where a coil lost turns; a current
/// misses its set-point by 2.5 times as much before it counts. Losses below 0.3 of the turns do that in proportion. A loss
/// that turns out to be none does it, too: the model has erred by what was taken for one.
///
/// Slow drift (heating, a sensor's zero) is followed within bounds that leave a fault visible
/// (slow_drift.h), as long as nothing is doubted and every ratio of the long windows is below 0.5. What has drifted while
/// the machine stood still is in c from the start: after the first 40 undisturbed periods, and after 160 more, it is taken
/// off at once, unless a shorter window is beyond its band or this one beyond 1.5 of it.
///
/// Nearly every period is calm: no c as it stands, before its common part is taken off, is beyond a band. That is
/// told without a division, and ends what is done in it.
///
/// A reading that steps by what no voltage can make, without a slope that is wrong afterwards, is a
/// current sensor's fault (jump_watch.h).
#include "fdd/detectors/coil_detector.h"
#include "fdd/detectors/coil_probe.h"
#include "fdd/detectors/excess_windows.h"
#include "fdd/detectors/jump_watch.h"
#include "fdd/detectors/slow_drift.h"
#include "fdd/examination/joint_turns.h"

namespace ambrig {

class CommissionedDetector : public CoilDetector {
 public:
  struct Outcome {
    bool alarm = false;     // some coil's ratio is above 1 in this period
    bool decided = false;   // `diagnosis` holds
    bool doubtful = false;  // of the model, in this period
    Diagnosis diagnosis;
    std::vector<Diagnosis> more;  // of other coils, decided together with it
    double excess = 0;            // c of the decided coil, the periods of the decision [-]
    // share of its turns that the decided coil truly has, where it had been taken for one with
    // fewer; 0: not so
    double turns = 0;

    /// Blames all of them, one at least, the first by name.
    void Blame(const std::vector<Diagnosis>& failed) {
      diagnosis = failed[0];
      more.assign(failed.begin() + 1, failed.end());
    }
  };

  CommissionedDetector(const CoilDetectorSetup& setup, const CommissionedBearing& commissioned);

  Outcome Watch(const MeasuredPeriod& in);
  /// Ratio of every coil.
  Lane Period(const MeasuredPeriod& in) override;

  /// A coil that is not judged any more; `share` of its turns carries on, 0: none.
  void SetTurns(int coil, double share);
  /// Nothing is concluded from the next periods but that a coil has no current.
  void Pause(int periods) { paused_ = std::max(paused_, periods); }
  /// Takes back what SetTurns said, and forgets what was seen of it; `share` of the turns carries.
  void Restore(int coil, double share = 1);
  /// A current is asked of a coil that has no turns, or is asked for none: its slopes are watched, no
  /// coil is judged.
  void BeginProbe(int coil);
  /// What it showed of a coil that had turns: no current, or a gross short; else class none.
  Diagnosis EndProbe(double t);
  const CoilProbe& probe() const { return probe_; }
  /// In commissioning nothing is taken for drift.
  void IgnoreDrift() { follows_drift_ = false; }
  const SlowDrift& drift() const { return drift_; }

  const Lane& ratio() const { return ratio_; }
  Lane Excess(int window) const { return windows_.Used(window, 1); }
  const CommissionedBearing& commissioned() const { return model_; }
  const ExcessWindows& windows() const { return windows_; }
  double band(int window, int coil) const { return band_[window][coil]; }
  const FluxPeriod& period() const { return period_; }
  const Lane& current_error() const { return current_error_; }
  /// |c| of this period alone, all phases [-].
  const Lane& now() const { return now_; }

 private:
  static constexpr std::size_t kInARow = 3;  // periods
  static constexpr double kGross = 0.5;      // |c|
  static constexpr double kGrossAbove = 2;   // c, of a coil outside the commissioned range
  // c, of a coil inside while one or two others are outside
  static constexpr double kGrossBeside = 1;
  static constexpr double kCompanion = 0.5;  // of the largest |c|: a fault of its own
  static constexpr int kLevelWindow = 2;     // over which coils are compared: ten periods
  static constexpr int kCoilsAtOnce = 3;     // that stand out: the model's fault
  static constexpr double kNoiseOfBand = 6;  // a window's noise is below its band over this
  struct Recent {
    Lane top, bottom;
  };
  void SetBands();
  void SetWider();
  /// How much what a coil has lost of its turns widens the bands: 1 from a great loss on, 0 without one.
  double LossOf(int coil) const;
  /// What a band of this coil is at least, because some coil has fewer turns than it had [-].
  double LeastBand(int coil, int window) const;
  /// Whether both are windings of one thrust side (or one and the same).
  bool SharesCore(int coil, int other) const;
  /// A coil has other turns left than believed: means and bands begin again.
  void TakeShare(int coil, double share);
  void WatchCurrents(const MeasuredPeriod& in);
  void WatchRange(const MeasuredPeriod& in);
  /// Whether a coil whose flux is beyond what was commissioned is outside the range of the model: not where lost turns
  /// account for it.
  bool LeavesRange(int coil);
  /// Whether its linkage moves by far more than its voltage accounts for, or its reading jumps up, in this period.
  bool FluxJumps(int coil) const;
  /// Ratios of this period; of a calm one those of the windows are left out.
  void Ratios();
  /// Of the windows, against their bands.
  void RatiosOfWindows();
  double RecentExcess(int coil) const;
  double MoreTurns(int coil, double excess) const;
  Outcome Judge(const MeasuredPeriod& in);
  /// The model's own errors show: several coils at once, or a pattern over the bearing.
  bool Disturbed() const;
  double PatternLimit() const;  // beyond which a pattern is doubted
  /// Whether the learnt model holds: usable, and the coils are those it was learnt on.
  bool Relies() const { return model_.usable(); }
  int GrossCoils() const;  // with c > 0.5 in this period
  /// Largest |c| of this period.
  double LargestNow() const;
  void CountStreaks(const MeasuredPeriod& in);
  void CountDead(const MeasuredPeriod& in);
  /// Whether any coil misses its set-point in this period, or had no current in the last.
  bool SomeMissItsCurrent() const;
  /// Whether a winding of a thrust side misses current that its voltage would give it, had it any: the winding that is
  /// driven at least as hard as its partner takes over what that carries more, whatever flux both share.
  bool LeftToPartner(const MeasuredPeriod& in, int coil) const;
  /// Coils without current, which no other coil's turns can feign: concluded in a pause, too.
  Outcome WithoutCurrent(double t) const;
  /// Without a model of this machine, what a rotor that bounces does to the currents is not known.
  bool MayBounce() const { return !Relies() && bounces_; }
  /// Where c became gross at once, and has been so since.
  void WatchJumps();
  void FollowDrift(bool doubtful);
  /// What the first 40 undisturbed periods show, and then the first 160, is drift since the commissioning, within its
  /// bounds: taken off at once, and the windows begin again. Whether this is such a period.
  bool TakesFirstDrift();
  /// Which coils have failed, all judged together: no current, or shares of their turns that explain
  /// all c. False: no such explanation.
  bool JudgedTogether(const MeasuredPeriod& in, Outcome* out) const;
  /// So small an excess is of less than a turn, which no short bypasses.
  bool LessThanATurn(int coil, double excess) const;
  /// Share of the turns that a coil must have lost to be one of several that failed; `per_excess` of
  /// JointShares.
  double LeastLost(int coil, double per_excess) const;
  std::vector<Diagnosis> CoilsWithoutCurrent(double t) const;
  /// Its reading is zero although the bridge drives.
  bool HasNoCurrent(int coil) const;
  /// Whether turns were lost on the same thrust core a short time ago. Two windings of one flux that are named in turns say
  /// that the model errs.
  bool ShortedAgain(const Diagnosis& d) const;
  /// Whether a small short is not named yet, because another coil is about to stand out as much: of two that lost turns
  /// at one instant each hides a part of the other, and after the first is named the windows of the second begin again.
  bool AwaitsCompanion(const Diagnosis& d, double excess) const;
  /// Other coils whose own c is as gross as that of the coil that was decided.
  std::vector<Diagnosis> Companions(int decided, double excess, double time) const;
  bool Decided(int coil, double excess) const;
  bool PhasesAgree(int coil) const;
  bool CurrentIsFalse(int coil) const;
  Diagnosis Classify(int coil, double excess, double time) const;

  CommissionedBearing model_;
  SamplingSettings sampling_;
  ExcessSettings settings_;
  double gap_ = 0;  // nominal [m]
  FluxFilter filter_;
  ExcessWindows windows_;
  FluxPeriod period_;
  SlopeExcess excess_;
  Lane share_;                          // of the turns; 0: not judged
  long long share_taken_[kLanes] = {};  // period in which
  Lane band_[kExcessWindows];           // of |c|
  Lane ratio_, now_, apart_;            // apart_: 1 where only gross values count
  // Of this period: no coil gross, none beyond a band, no pattern. Nothing needs to be weighed then.
  bool calm_ = false;
  Lane level_;                                      // |c|, of gross coils now, else of ten periods
  Lane most_missed_;                                // |set-point - mean| of a healthy current [A]
  Lane last_miss_, current_error_, false_current_;  // [A], [A], periods in a row
  std::array<Recent, kInARow> recent_;
  bool out_of_range_ = false, touching_ = false;
  Lane last_flux_;                      // largest of the period before [A]
  Lane wider_range_;                    // where lost turns account for more flux [A]
  long long wider_until_[kLanes] = {};  // period up to which that holds
  Lane gross_above_;                    // c > 0 that is gross, of this period
  double touched_ = -kInfinity;         // start of the last period that touched [s]
  bool bounces_ = false;                // that was not long ago
  double wider_ = 1;                    // of the bands, since coils were given up or lost turns
  bool erred_ = false;                  // a loss of turns was none
  Lane idle_;                           // mean reading of coils without turns [A]
  CoilProbe probe_;
  JumpWatch jumps_;
  JointTurns joint_;
  SlowDrift drift_;
  bool follows_drift_ = true;
  std::size_t first_drifts_ = 0;  // how many of both were looked at
  long long steady_ = 0;          // undisturbed periods in a row, until then
  Lane streak_, onset_;           // periods in a row that a coil was suspect; since [s]
  Lane dead_, dead_since_;        // periods in a row without current though driven; since [s]
  Lane last_now_[2];              // c of the two periods before
  Lane jumped_;                   // 1: c became gross at once, and has been so since
  int waited_ = 0;                // periods for a companion, since nothing stood out
  int paused_ = 8;
  long long count_ = 0;
};

}  // namespace ambrig
