#pragma once
/// What a small current through a coil that was given up, or lies idle, tells of it: its slopes
/// must again be those that its voltage makes (slope_excess.h). Healthy is only what was seen to
/// be: the reading was zero while the bridge was off, and after the current had come, both phases
/// had a small c.
#include "fdd/circuit/slope_excess.h"
#include "fdd/detectors/run_detector.h"

namespace ambrig {

class CoilProbe {
 public:
  /// `idle`: of its reading with the bridge off [A]; `band`: of |c| of a healthy coil [-].
  void Begin(int coil, double idle, double band);
  void End() { coil_ = -1; }
  bool running() const { return coil_ >= 0; }
  int coil() const { return coil_; }

  /// One period of the probe; `largest`: sample of the coil's current in it [A]. Neighbours that
  /// switch with it can give an open coil the slopes of a healthy one: what tells then is that no
  /// current comes.
  void Add(const SlopeExcess& period, double largest);
  /// The same period of all other coils that are judged. A c that becomes gross, for three periods
  /// in a row, ends the probe: that coil has failed meanwhile, and is judged when no probe runs.
  void WatchOthers(const SlopeExcess& period);
  ProbeAnswer answer() const { return answer_; }
  /// Whether the answer is that no current came at all.
  bool no_current() const;
  /// Its c over the settled periods; 0 before [-].
  double excess() const;

 private:
  static constexpr int kInARow = 3;           // periods without a slope: enough if they are sure
  static constexpr int kSettledPeriods = 20;  // of a probe, without current: enough
  int coil_ = -1, periods_ = 0, without_ = 0;
  int idle_ = 0;           // settled periods without current
  double likelihood_ = 0;  // of the periods without a slope (no_current.h)
  double band_ = 0;
  int gross_[kLanes] = {};  // periods in a row, of the other coils
  bool calm_[kLanes] = {};  // whether a period of theirs was not gross
  double top_[2] = {}, bottom_[2] = {};
  ProbeAnswer answer_ = ProbeAnswer::kNone;
};

}  // namespace ambrig
