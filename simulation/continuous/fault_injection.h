#pragma once
/// Faults of a scenario for the continuous-time engines, at the ADC instant nearest to their time
/// (the switching engine's instants). Source: docs/theory/base_model.md section 6.
#include <vector>

#include "scenarios/faults/fault_ends.h"
#include "simulation/continuous/continuous_rig.h"

namespace ambrig {

class FaultInjection {
 public:
  FaultInjection(SampledDataLoop& rig, ContinuousRig& plant, RunResult& result);
  /// Local instants [s] of period n at which something happens.
  void Instants(long long n, std::vector<double>& out) const;
  /// Injects what is due at local time tau of period n; true when a bridge or the bus changed, so
  /// that voltages must be set again.
  bool Due(long long n, double tau);

 private:
  double Snapped(const FaultSpec& f) const;
  bool Inject(const FaultSpec& f);

  SampledDataLoop& rig_;
  ContinuousRig& plant_;
  RunResult& result_;
  std::size_t next_ = 0;
  FaultEnds ends_;
};

}  // namespace ambrig
