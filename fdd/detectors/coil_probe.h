#pragma once
/// What a small current through a coil that was given up tells of it: its slopes must again be
/// those that its voltage makes (slope_excess.h). Healthy is only what was seen to be: the reading
/// was zero while the bridge was off, and after the current had come, both phases had a small c.
#include "fdd/detectors/run_detector.h"
#include "fdd/model/slope_excess.h"

namespace ambrig {

class CoilProbe {
 public:
  /// `idle`: of its reading with the bridge off [A]; `band`: of |c| of a healthy coil [-].
  void Begin(int coil, double idle, double band);
  void End() { coil_ = -1; }
  bool running() const { return coil_ >= 0; }
  int coil() const { return coil_; }

  /// One period of the probe.
  void Add(const SlopeExcess& period);
  ProbeAnswer answer() const { return answer_; }

 private:
  int coil_ = -1, periods_ = 0, without_ = 0;
  double band_ = 0;
  double top_[2] = {}, bottom_[2] = {};
  ProbeAnswer answer_ = ProbeAnswer::kNone;
};

}  // namespace ambrig
