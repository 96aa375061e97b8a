#include "scenarios/reference_engine.h"

#include <algorithm>
#include <cmath>

#include "scenarios/fault_injection.h"
#include "scenarios/run_watch.h"

namespace ambrig {

namespace {

constexpr double kSame = 1e-14;  // [s] two instants of a period that are one

/// One run; its own object so that period and voltages share their working memory.
class ReferenceRun {
 public:
  ReferenceRun(const RigParameters& rig, const Scenario& scenario, const ReferenceOptions& options)
      : options_(options), rig_(rig, scenario, options.sampled) {
    rig_.Start();
    plant_.emplace(rig_, options.integrator);
    plant_->Settle();
    faults_.emplace(rig_, *plant_, result_);
    watch_.emplace(rig_, result_);
    samples_.resize(rig_.bearings.size());
    for (auto& s : samples_) s.resize(static_cast<std::size_t>(rig_.samples));
  }

  RunResult Run(std::vector<EnergyBalance>* energies) {
    rig_.RecordStart();
    for (long long n = -rig_.warm; n < rig_.periods; ++n) {
      if (options_.stop && options_.stop->load()) throw Interrupted();
      if (options_.progress && (n & 63) == 0)
        options_.progress(static_cast<double>(n + rig_.warm) /
                          static_cast<double>(rig_.periods + rig_.warm));
      Period(n);
      if (energies) energies->push_back(plant_->Energies());
    }
    watch_->Finish();
    result_.record = rig_.TakeRecord();
    if (options_.sampled.supervisor) options_.sampled.supervisor->Finish(result_);
    return std::move(result_);
  }

 private:
  void Period(long long n) {
    rig_.AtPeriodStart(n);
    plant_->BeginPeriod(n);
    const double copper = plant_->Energies().copper;
    FillInstants(n);
    double peak = 0;
    std::size_t sample = 0;
    for (double tau : instants_) {
      plant_->AdvanceTo(tau);
      if (faults_->Due(n, tau)) Rebuild();
      if (sample < static_cast<std::size_t>(rig_.samples) &&
          tau >= static_cast<double>(sample) * rig_.h - kSame)
        Sample(sample++, &peak);
      SetVoltages(tau);
    }
    plant_->AdvanceTo(rig_.T);
    std::vector<const Lane*> truth;
    for (const auto& s : samples_) truth.push_back(s.data());
    rig_.Measure(n, truth, rig_.samples);
    rig_.RecordBurst(n);
    plant_->EndPeriod();
    rig_.UpdatePositions();
    watch_->Period(n, (plant_->Energies().copper - copper) / rig_.T, peak);
    rig_.AfterPeriod(n, result_);
  }

  /// Everything that happens in this period, in order of local time.
  void FillInstants(long long n) {
    instants_.clear();
    for (int k = 0; k < rig_.samples; ++k) instants_.push_back(k * rig_.h);
    for (const SampledBearing& b : rig_.bearings)
      for (int j = 0; j < rig_.control[b.index].coils; ++j)
        for (double t :
             {b.voltage[static_cast<std::size_t>(j)].t1, b.voltage[static_cast<std::size_t>(j)].t2})
          if (t > kSame && t < rig_.T - kSame) instants_.push_back(t);
    const double t0 = static_cast<double>(n) * rig_.T;
    const auto at = [&](double t) {
      if (t > t0 + kSame && t < t0 + rig_.T - kSame) instants_.push_back(t - t0);
    };
    for (const LoadSpec& l : rig_.scenario.loads) {
      at(l.start);
      at(l.stop);
    }
    at(rig_.scenario.speed_free_from);
    faults_->Instants(n, instants_);
    std::sort(instants_.begin(), instants_.end());
    const auto same = [](double a, double b) { return b - a <= kSame; };
    instants_.erase(std::unique(instants_.begin(), instants_.end(), same), instants_.end());
  }

  void Rebuild() {
    for (SampledBearing& b : rig_.bearings)
      for (int j = 0; j < rig_.control[b.index].coils; ++j)
        b.voltage[static_cast<std::size_t>(j)] = rig_.PatternOf(b, j);
  }

  void Sample(std::size_t k, double* peak) {
    for (const SampledBearing& b : rig_.bearings)
      for (int j = 0; j < rig_.control[b.index].coils; ++j) {
        samples_[b.index][k][j] = plant_->Current(b.index, j);
        *peak = std::max(*peak, samples_[b.index][k][j]);
      }
  }

  /// Piece of every coil's pattern that begins at or before tau.
  void SetVoltages(double tau) {
    for (const SampledBearing& b : rig_.bearings)
      for (int j = 0; j < rig_.control[b.index].coils; ++j) {
        const CoilVoltage& v = b.voltage[static_cast<std::size_t>(j)];
        const int piece = tau < v.t1 - kSame ? 0 : (tau < v.t2 - kSame ? 1 : 2);
        plant_->SetVoltage(b.index, j, v.gain[piece] * rig_.plant.bus.voltage + v.drop[piece],
                           v.gain[piece] > 0);
      }
  }

  ReferenceOptions options_;
  SampledRig rig_;
  std::optional<ContinuousRig> plant_;
  RunResult result_;
  std::optional<FaultInjection> faults_;
  std::optional<RunWatch> watch_;
  std::vector<double> instants_;
  std::vector<std::vector<Lane>> samples_;
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
