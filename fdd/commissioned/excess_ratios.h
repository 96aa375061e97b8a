#pragma once
/// How far every coil of a bearing is beyond what is healthy, period by period:
/// the largest |c|/band over the windows (excess_windows.h), and |c| over 0.1 where c of one period
/// alone is gross.
///
/// Nearly every period is calm: no c as it is measured, before its common part is taken
/// off, is beyond a band. That is told without a division, and leaves the ratios of
/// the windows out.
#include <array>

#include "fdd/commissioned/excess_bands.h"
#include "fdd/commissioned/excess_limits.h"
#include "fdd/commissioned/excess_windows.h"

namespace ambrig {

class ExcessRatios {
 public:
  ExcessRatios(const LinkageModel& nominal, const CommissionedBearing& learnt);

  struct Conditions {
    const ExcessBands& bands;
    const Lane& gross_above;  // c > 0 that is gross, of every coil [-]
    bool only_gross;          // no less than gross values count in this period
    bool left;                // for no other reason than that a flux is beyond its range
    long long count;          // of periods so far
  };
  void Update(const SlopeExcess& excess, const Conditions& in);
  /// Completes the ratios of a calm period by those of the windows.
  void CompareWindows(const ExcessBands& bands);
  /// A period begins, of which nothing is known yet.
  void Begin() { calm_ = false; }
  /// No ratio in this period; `gross_before`: c of the period before is not known either.
  void Skip(bool gross_before);
  /// The windows begin again; the ratios of this period are zero.
  void Restart();

  void ClearWindows() { windows_.Clear(); }
  void Leave(int coil) { windows_.Leave(coil); }
  void Return(int coil) { windows_.Return(coil); }
  void TakeSense(bool taken) { windows_.TakeSense(taken); }
  const ExcessWindows& windows() const { return windows_; }

  const Lane& ratio() const { return ratio_; }
  /// c of this period alone, all phases [-].
  const Lane& now() const { return now_; }
  /// No coil gross, none beyond a band, no pattern: nothing needs to be weighed.
  bool calm() const { return calm_; }
  /// c over the last three periods [-].
  double Recent(int coil) const;
  /// Whether c over the last three periods has the sign of the c that stands out. In the noise of
  /// three periods a short of a few percent is, now and then, a reading that is too low.
  bool RecentAgrees(int coil) const { return Recent(coil) * standing_out_[coil] > 0; }
  /// Largest |c| of this period.
  double LargestNow() const;
  int GrossCoils() const;  // with c > 0.5 in this period
  /// Whether c came from below 0.5 to above 2 within two periods and has been gross since.
  bool Jumped(int coil) const { return jumped_[coil] > 0; }
  /// Whether c came from below 0.25 to above 0.5 within two periods, not at the start of the run,
  /// and has been gross since: turns are lost at once.
  bool Sudden(int coil) const { return sudden_[coil] > 0; }
  /// The model's own errors show: several coils at once, or a pattern over the bearing.
  bool Disturbed() const;

 private:
  static constexpr int kLevelWindow = 2;  // over which coils are compared: ten periods
  struct Sums {
    Lane top, bottom;
  };
  void FindJumps();
  void FindSudden(long long count);
  /// Coils whose c became gross at once count where only those beyond the limit of a flux outside
  /// its range would: what iron does there comes slowly. `bottom`: weights of the period. Whether
  /// there is any.
  bool CountSudden(const Lane& bottom);

  int coils_;
  bool relies_;
  double pattern_limit_;  // beyond which a pattern is doubted [-]
  double least_below_;    // least band of c < 0 [-]
  ExcessWindows windows_;
  Lane ratio_, now_, apart_;  // apart_: 1 where only gross values count
  Lane standing_out_;         // c of the window with the largest ratio, of a period not calm
  Lane level_;                // |c|, of gross coils now, else of ten periods
  bool calm_ = false;
  std::array<Sums, ExcessLimits::kInARow> recent_;
  Lane last_now_[2];  // c of the two periods before
  Lane jumped_, sudden_;
};

}  // namespace ambrig
