#pragma once
/// A run of a continuous-time fidelity, period by period: the sampled side at t_n, then the plant
/// from instant to instant (loads, faults, a speed let go, and what the fidelity adds), then the
/// measurements.
#include <optional>
#include <vector>

#include "simulation/continuous/fault_injection.h"
#include "simulation/continuous/reference_engine.h"
#include "simulation/sampled/instants.h"
#include "simulation/verdict/run_watch.h"

namespace ambrig {

class ContinuousRun {
 public:
  virtual ~ContinuousRun() = default;
  ContinuousRun(const ContinuousRun&) = delete;
  ContinuousRun& operator=(const ContinuousRun&) = delete;
  /// @throws Interrupted when stopped.
  RunResult Run(std::vector<EnergyBalance>* energies = nullptr);

 protected:
  ContinuousRun(const RigParameters& rig, const Scenario& scenario,
                const ReferenceOptions& options);
  /// The start is final: the plant settles on it.
  void Settle();

  /// Local instants [s] of the period at which this fidelity acts besides the common ones.
  virtual void AddInstants(std::vector<double>&) {}
  /// Local instants [s] at which the bridges switch in this period.
  virtual void AddEdges(std::vector<double>&) const {}
  /// The plant has reached an instant; faults due there are in.
  virtual void AtInstant(double /*tau*/) {}
  /// Voltages of all coils from tau on.
  virtual void SetVoltages(double tau) = 0;
  /// The end of period n: measurements of all bearings. Returns the largest current of the period
  /// [A].
  virtual double Measure(long long n) = 0;

  const ReferenceOptions options_;
  SampledDataLoop rig_;
  std::vector<std::array<CoilVoltage, kLanes>> voltage_;  // of this period, per bearing
  std::optional<ContinuousRig> plant_;
  RunResult result_;

 private:
  void Period(long long n);
  void FillInstants(long long n);
  /// Those from place `from` on are sorted, each stands once and comes after
  /// local time `after` [s].
  void OrderInstants(std::size_t from, double after);
  void SetPatterns();

  std::optional<FaultInjection> faults_;
  std::optional<RunWatch> watch_;
  std::vector<double> instants_;
};

}  // namespace ambrig
