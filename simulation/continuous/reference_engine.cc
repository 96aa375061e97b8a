#include "simulation/continuous/reference_engine.h"

#include <algorithm>
#include <cmath>

#include "simulation/continuous/continuous_run.h"

namespace ambrig {

namespace {

/// Every switching edge and every ADC sample is an instant.
class ReferenceRun : public ContinuousRun {
 public:
  ReferenceRun(const RigParameters& rig, const Scenario& scenario, const ReferenceOptions& options)
      : ContinuousRun(rig, scenario, options) {
    Settle();
    samples_.resize(rig_.bearings.size());
    for (auto& s : samples_) s.resize(static_cast<std::size_t>(rig_.samples));
  }

 private:
  void AddInstants(std::vector<double>& instants) override {
    next_sample_ = 0;
    peak_ = 0;
    for (int k = 1; k < rig_.samples; ++k) instants.push_back(k * rig_.h);
  }

  void AddEdges(std::vector<double>& instants) const override {
    for (const SampledBearing& b : rig_.bearings)
      for (int j = 0; j < rig_.control[b.index].coils; ++j)
        for (double t : {voltage_[b.index][static_cast<std::size_t>(j)].t1,
                         voltage_[b.index][static_cast<std::size_t>(j)].t2})
          if (t > kSameInstant && t < rig_.T - kSameInstant) instants.push_back(t);
  }

  void AtInstant(double tau) override {
    const std::size_t k = next_sample_;
    if (k >= static_cast<std::size_t>(rig_.samples) ||
        tau < static_cast<double>(k) * rig_.h - kSameInstant)
      return;
    for (const SampledBearing& b : rig_.bearings)
      for (int j = 0; j < rig_.control[b.index].coils; ++j) {
        samples_[b.index][k][j] = plant_->Current(b.index, j);
        peak_ = std::max(peak_, std::abs(samples_[b.index][k][j]));
      }
    ++next_sample_;
  }

  double Measure(long long n) override {
    for (SampledBearing& b : rig_.bearings) rig_.Measure(n, b, samples_[b.index].data());
    return peak_;
  }

  /// Piece of every coil's pattern that begins at or before tau.
  void SetVoltages(double tau) override {
    for (const SampledBearing& b : rig_.bearings)
      for (int j = 0; j < rig_.control[b.index].coils; ++j) {
        const CoilVoltage& v = voltage_[b.index][static_cast<std::size_t>(j)];
        const int piece = tau < v.t1 - kSameInstant ? 0 : (tau < v.t2 - kSameInstant ? 1 : 2);
        plant_->SetVoltage(b.index, j,
                           {v.gain[piece] * rig_.plant.bus.voltage + v.drop[piece],
                            v.gain[piece] > 0, v.released});
      }
  }

  std::vector<std::vector<Lane>> samples_;
  std::size_t next_sample_ = 0;
  double peak_ = 0;
};

}  // namespace

RunResult RunReference(const RigParameters& rig, const Scenario& scenario,
                       const ReferenceOptions& options) {
  return ReferenceRun(rig, scenario, options).Run(nullptr);
}

RunResult RunReference(const RigParameters& rig, const Scenario& scenario,
                       const ReferenceOptions& options, std::vector<EnergyBalance>* energies) {
  return ReferenceRun(rig, scenario, options).Run(energies);
}

}  // namespace ambrig
