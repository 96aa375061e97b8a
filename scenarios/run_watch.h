#pragma once
/// Events and figures of a run of the continuous-time engines, once per switching period: contact,
/// touchdown, drop, orbit, currents, copper loss. The rules are the switching engine's.
/// Source: shared/design/physics.md section 8 (verdict terms).
#include <vector>

#include "scenarios/sampled_rig.h"

namespace ambrig {

class RunWatch {
 public:
  RunWatch(const SampledRig& rig, RunResult& result);
  /// After period n: mean copper loss [W] and largest current [A] of the period.
  void Period(long long n, double copper, double peak_current);
  void Finish();

 private:
  void Contact(long long n, std::size_t k);
  void Event(const std::string& kind, const std::string& target);

  const SampledRig& rig_;
  RunResult& result_;
  std::vector<double> contact_since_;  // per auxiliary bearing and the axial stops, -1: none
  double copper_sum_ = 0;
};

}  // namespace ambrig
