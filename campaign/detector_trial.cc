#include "campaign/detector_trial.h"

#include <algorithm>
#include <cmath>

#include "scenarios/faults/faulted_plant.h"

namespace ambrig {

struct DetectorTrial::OneDetector {
  std::vector<std::unique_ptr<CoilDetector>> bearings;
  std::vector<Lane> largest;       // in the present window
  double coil = -1, bearing = -1;  // largest since the fault
  DetectorOutcome outcome;
};

DetectorTrial::DetectorTrial(const NominalRig& nominal, const Scenario& scenario,
                             const std::vector<CoilDetectorKind>& kinds,
                             const TrialSettings& settings)
    : rig_(nominal), feed_(nominal) {
  const double f = nominal->amplifier.switching_frequency;
  begin_ = std::llround(settings.begin * f);
  count_from_ = begin_ + std::llround(settings.settle * f);
  window_ = std::max(1LL, std::llround(settings.window * f));
  if (!scenario.faults.empty()) {
    const FaultPlace place = PlaceOf(scenario.faults.front(), *nominal);
    Require(place.coil >= 0, "the fault of a detector trial is one of a coil");
    faulty_ = true;
    bearing_ = place.bearing;
    coil_ = place.coil;
    // The period in which the fault comes may show it.
    count_from_ = static_cast<long long>(std::floor(scenario.faults.front().time * f + 1e-6));
    begin_ = std::max(0LL, count_from_ - std::llround(settings.begin * f));
  }
  for (std::size_t k = 0; k < rig_->bearings.size(); ++k)
    watched_.push_back(faulty_ ? k == bearing_
                               : std::count(settings.kinds.begin(), settings.kinds.end(),
                                            rig_->bearings[k].kind) > 0);
  for (const CoilDetectorKind& kind : kinds) {
    auto d = std::make_unique<OneDetector>();
    for (const BearingParameters& b : rig_->bearings)
      d->bearings.push_back(kind.make(RunDetectorSetupOf(rig_, b)));
    d->largest.resize(rig_->bearings.size());
    detectors_.push_back(std::move(d));
  }
}

DetectorTrial::~DetectorTrial() = default;

void DetectorTrial::AfterPeriod(const PeriodMeasurement& m,
                                const std::vector<BearingControl>& control, SupervisorOutput&) {
  feed_.Read(m);
  if (m.period < begin_ || (faulty_ && m.period >= count_from_ + window_)) return;
  std::vector<MeasuredPeriod> in;
  for (std::size_t k = 0; k < rig_->bearings.size(); ++k) {
    in.push_back(feed_.Period(k, m));
    in.back().set_point = &control[k].commanded;
  }
  const bool counts = m.period >= count_from_;
  if (counts) {
    ++seen_;
    ++in_window_;
  }
  std::vector<Lane> statistic(in.size());
  for (auto& d : detectors_) {
    for (std::size_t k = 0; k < in.size(); ++k)
      if (watched_[k]) statistic[k] = d->bearings[k]->Period(in[k]);
    if (!counts) continue;
    if (faulty_)
      CountFaulty(*d, statistic[bearing_], static_cast<int>(m.period - count_from_));
    else
      CountHealthy(*d, statistic);
  }
  if (in_window_ == window_) in_window_ = 0;
}

void DetectorTrial::CountHealthy(OneDetector& d, const std::vector<Lane>& statistic) {
  for (std::size_t k = 0; k < statistic.size(); ++k)
    for (int j = 0; watched_[k] && j < rig_->bearings[k].coils(); ++j) {
      double& most = d.largest[k][j];
      most = in_window_ == 1 ? statistic[k][j] : std::max(most, statistic[k][j]);
      if (in_window_ == window_) ++d.outcome.windows[LevelOf(most)];
    }
}

void DetectorTrial::CountFaulty(OneDetector& d, const Lane& statistic, int period) {
  const auto add = [period](std::vector<LevelReached>& list, double& most, double value,
                            bool right) {
    if (!(value > most)) return;
    const int before = most < 0 ? -1 : LevelOf(most), now = LevelOf(value);
    most = value;
    if (now > before) list.push_back({period, now, right});
  };
  const int coils = rig_->bearings[bearing_].coils();
  const double* worst = std::max_element(statistic.v, statistic.v + coils);
  add(d.outcome.coil, d.coil, statistic[coil_], true);
  add(d.outcome.bearing, d.bearing, *worst, statistic[coil_] >= *worst);
}

std::vector<DetectorOutcome> DetectorTrial::Take() {
  Require(!faulty_ || seen_ == window_, "the run ended before the window of its fault");
  std::vector<DetectorOutcome> out;
  for (auto& d : detectors_) out.push_back(std::move(d->outcome));
  return out;
}

}  // namespace ambrig
