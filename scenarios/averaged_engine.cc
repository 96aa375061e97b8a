#include "scenarios/averaged_engine.h"

#include <algorithm>
#include <cmath>

#include "scenarios/fault_injection.h"
#include "scenarios/run_watch.h"

namespace ambrig {

namespace {

constexpr double kSame = 1e-14;  // [s] two instants of a period that are one

double MeanVoltage(const CoilVoltage& v, double bus, double T, bool* driven) {
  const double length[3] = {v.t1, v.t2 - v.t1, T - v.t2};
  double sum = 0;
  *driven = false;
  for (int q = 0; q < 3; ++q) {
    sum += length[q] * (v.gain[q] * bus + v.drop[q]);
    *driven = *driven || (length[q] > 0 && v.gain[q] > 0);
  }
  return sum / T;
}

class AveragedRun {
 public:
  AveragedRun(const RigParameters& rig, const Scenario& scenario, const AveragedOptions& options)
      : options_(options), rig_(rig, scenario, options.sampled), mean_(rig_.bearings.size()) {
    Require(!options.sampled.supervisor, "no detector: averaged currents have no slopes");
    const double rate =
        options.sampled.record_rate > 0 ? options.sampled.record_rate : scenario.record_rate;
    if (rate * rig_.T > 1 + 1e-9)
      throw InputError(
          "a record_rate above the switching frequency needs --fidelity switching or reference");
    rig_.Start();
    if (scenario.start == StartState::kLevitated) {
      const Equilibrium e = LevitatedEquilibrium(rig_);
      if (e.usable())
        rig_.StartFrom(e.force, e.q);
      else
        result_.notes.push_back("no unique equilibrium (" + e.message +
                                "): started from the centre");
    }
    plant_.emplace(rig_, options.integrator);
    plant_->Settle();
    faults_.emplace(rig_, *plant_, result_);
    watch_.emplace(rig_, result_);
  }

  RunResult Run() {
    rig_.RecordStart();
    for (long long n = -rig_.warm; n < rig_.periods; ++n) {
      if (options_.stop && options_.stop->load()) throw Interrupted();
      if (options_.progress && (n & 255) == 0)
        options_.progress(static_cast<double>(n + rig_.warm) /
                          static_cast<double>(rig_.periods + rig_.warm));
      Period(n);
    }
    watch_->Finish();
    result_.record = rig_.TakeRecord();
    return std::move(result_);
  }

 private:
  void Period(long long n) {
    rig_.AtPeriodStart(n);
    plant_->BeginPeriod(n);
    const double copper = plant_->Energies().copper;
    for (double tau : Instants(n)) {
      plant_->AdvanceTo(tau);
      if (faults_->Due(n, tau))
        for (SampledBearing& b : rig_.bearings)
          for (int j = 0; j < rig_.control[b.index].coils; ++j)
            b.voltage[static_cast<std::size_t>(j)] = rig_.PatternOf(b, j);
      SetVoltages();
    }
    plant_->AdvanceTo(rig_.T);
    double peak = 0;
    std::vector<const Lane*> truth;
    for (SampledBearing& b : rig_.bearings) {
      b.measurement.noisy = false;
      for (int j = 0; j < rig_.control[b.index].coils; ++j) {
        mean_[b.index][j] = plant_->MeanCurrent(b.index, j, rig_.T);
        peak = std::max(peak, mean_[b.index][j]);
      }
      truth.push_back(&mean_[b.index]);
    }
    rig_.Measure(n, truth, 1);
    plant_->EndPeriod();
    rig_.UpdatePositions();
    watch_->Period(n, (plant_->Energies().copper - copper) / rig_.T, peak);
  }

  std::vector<double> Instants(long long n) const {
    std::vector<double> out = {0.0};
    const double t0 = static_cast<double>(n) * rig_.T;
    const auto at = [&](double t) {
      if (t > t0 + kSame && t < t0 + rig_.T - kSame) out.push_back(t - t0);
    };
    for (const LoadSpec& l : rig_.scenario.loads) {
      at(l.start);
      at(l.stop);
    }
    at(rig_.scenario.speed_free_from);
    faults_->Instants(n, out);
    std::sort(out.begin(), out.end());
    return out;
  }

  void SetVoltages() {
    for (const SampledBearing& b : rig_.bearings)
      for (int j = 0; j < rig_.control[b.index].coils; ++j) {
        bool driven;
        const double v = MeanVoltage(b.voltage[static_cast<std::size_t>(j)], rig_.plant.bus.voltage,
                                     rig_.T, &driven);
        plant_->SetVoltage(b.index, j, v, driven);
      }
  }

  AveragedOptions options_;
  SampledRig rig_;
  std::optional<ContinuousRig> plant_;
  RunResult result_;
  std::optional<FaultInjection> faults_;
  std::optional<RunWatch> watch_;
  std::vector<Lane> mean_;
};

}  // namespace

AveragedOptions DefaultAveragedOptions() {
  AveragedOptions o;
  o.integrator.tolerance = 1e-7;
  o.integrator.order = 4;
  return o;
}

RunResult RunAveraged(const RigParameters& rig, const Scenario& scenario,
                      const AveragedOptions& options) {
  return AveragedRun(rig, scenario, options).Run();
}

}  // namespace ambrig
