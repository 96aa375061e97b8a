#include "simulation/continuous/continuous_run.h"

#include <algorithm>

namespace ambrig {

ContinuousRun::ContinuousRun(const RigParameters& rig, const Scenario& scenario,
                             const ReferenceOptions& options)
    : options_(options), rig_(rig, scenario, options.sampled), voltage_(rig_.bearings.size()) {
  rig_.Start();
}

void ContinuousRun::Settle() {
  plant_.emplace(rig_, options_.integrator);
  plant_->Settle();
  faults_.emplace(rig_, *plant_, result_);
  watch_.emplace(rig_, result_);
}

RunResult ContinuousRun::Run(std::vector<EnergyBalance>* energies) {
  rig_.StartRecord();
  rig_.ForEachPeriod(options_, 4, [&](long long n) {
    Period(n);
    if (energies) energies->push_back(plant_->Energies());
  });
  watch_->Finish();
  result_.record = rig_.TakeRecord();
  AddSummary(options_.sampled.supervisor, result_);
  return std::move(result_);
}

void ContinuousRun::Period(long long n) {
  rig_.AtPeriodStart(n);
  SetPatterns();
  plant_->BeginPeriod(n);
  const double copper = plant_->Energies().copper;
  FillInstants(n);
  for (std::size_t k = 0; k < instants_.size(); ++k) {
    const double tau = instants_[k];
    plant_->AdvanceTo(tau);
    if (faults_->Due(n, tau)) {
      SetPatterns();
      AddEdges(instants_);  // the bridge switches where it would not have
      OrderInstants(k + 1, tau);
    }
    AtInstant(tau);
    SetVoltages(tau);
  }
  plant_->AdvanceTo(rig_.T);
  const double peak = Measure(n);
  rig_.EndMeasurement(n);
  plant_->EndPeriod();
  rig_.UpdatePositions();
  if (n < 0) return;
  watch_->Coils((plant_->Energies().copper - copper) / rig_.T, peak);
  watch_->Period(n);
  rig_.Supervise(n, result_);
}

void ContinuousRun::FillInstants(long long n) {
  instants_.assign(1, 0.0);
  AddInstants(instants_);
  AddEdges(instants_);
  const double t0 = static_cast<double>(n) * rig_.T;
  const auto at = [&](double t) {
    if (t > t0 + kSameInstant && t < t0 + rig_.T - kSameInstant) instants_.push_back(t - t0);
  };
  for (const LoadSpec& l : rig_.scenario.loads) {
    at(l.start);
    at(l.stop);
  }
  at(rig_.scenario.speed_free_from);
  faults_->Instants(n, instants_);
  OrderInstants(0, -1);
}

void ContinuousRun::OrderInstants(std::size_t from, double after) {
  std::erase_if(instants_, [&, k = std::size_t{0}](double t) mutable {
    return k++ >= from && t <= after + kSameInstant;
  });
  const auto begin = instants_.begin() + static_cast<std::ptrdiff_t>(from);
  std::sort(begin, instants_.end());
  const auto same = [](double a, double b) { return b - a <= kSameInstant; };
  instants_.erase(std::unique(begin, instants_.end(), same), instants_.end());
}

void ContinuousRun::SetPatterns() {
  for (const SampledBearing& b : rig_.bearings)
    for (int j = 0; j < rig_.control[b.index].coils; ++j)
      voltage_[b.index][static_cast<std::size_t>(j)] =
          rig_.PatternOf(b, j, rig_.control[b.index].feedback[j]);
}

}  // namespace ambrig
