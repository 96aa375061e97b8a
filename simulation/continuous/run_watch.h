#pragma once
/// Events and figures of a run of the continuous-time engines, once per switching period: contact,
/// touchdown, drop, orbit, currents, copper loss. The rules are the switching engine's.
/// Source: docs/theory/base_model.md section 8 (verdict terms).
#include "simulation/sampled/sampled_rig.h"
#include "simulation/verdict/contact_watch.h"

namespace ambrig {

class RunWatch {
 public:
  RunWatch(const SampledRig& rig, RunResult& result);
  /// After period n: mean copper loss [W] and largest current [A] of the period.
  void Period(long long n, double copper, double peak_current);
  void Finish();

 private:
  const SampledRig& rig_;
  RunResult& result_;
  ContactWatch contacts_;
  double copper_sum_ = 0;
};

}  // namespace ambrig
