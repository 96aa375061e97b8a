#include "discovery/plan/planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/base/errors.h"
#include "discovery/decision/prepared_models.h"
#include "discovery/model/floor.h"
#include "discovery/model/nuisance_kinds.h"

namespace ambrig {

namespace {

constexpr std::size_t kTrialRows = 60000;  // of a trial record that are looked at
constexpr double kSizes[] = {1, 0.6, 0.35, 0.2};

}  // namespace

Planner::Planner(const RigParameters& rig, const Abilities& abilities, Surroundings surroundings,
                 std::vector<Rival> rivals, Hypothesis nothing, const PlanOptions& options)
    : rig_(rig),
      abilities_(abilities),
      surroundings_(std::move(surroundings)),
      rivals_(std::move(rivals)),
      nothing_(std::move(nothing)),
      options_(options) {
  if (rivals_.size() < 2)
    throw InputError("a plan needs two names to tell apart, allowed: at least two");
}

void Planner::Progress(double f, const std::string& text) const {
  if (options_.stop && options_.stop->load()) throw Interrupted();
  if (options_.progress) options_.progress(f, text);
}

std::vector<std::pair<std::size_t, std::size_t>> Planner::Pairs() const {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < rivals_.size(); ++a)
    for (std::size_t b = a + 1; b < rivals_.size(); ++b) pairs.emplace_back(a, b);
  return pairs;
}

TrialRecord Planner::Trial(const std::string& toml, const PlanCandidate& c) const {
  TrialRecord trial;
  trial.data = std::make_unique<Case>(EmptyCase(rig_, {{c.title, toml, false, c.burst}}));
  trial.data->noise = surroundings_.noise;
  trial.data->nuisances = surroundings_.nuisances;
  if (!abilities_.channels.empty()) KeepChannels(trial.data->records[0], abilities_.channels);
  trial.model = std::make_unique<CaseModel>(*trial.data, ThinningTo(*trial.data, kTrialRows));
  trial.model->stop = options_.stop;
  return trial;
}

void Planner::Prepare(TrialRecord* trial) const {
  CaseModel& model = *trial->model;
  const Hypothesis& h = rivals_[0].hypothesis;
  const NoiseFloor floor = FindFloor(model, h);
  trial->row_weight =
      std::min(floor.effective_sample_size / static_cast<double>(model.size()), 1.0);
  const bool declared = true;  // here those to expect
  const std::vector<NuisanceKind> kinds = NuisanceKindsOf(model, h, floor.clean, declared);
  trial->nuisances.resize(static_cast<Eigen::Index>(model.size()),
                          static_cast<Eigen::Index>(kinds.size()));
  for (std::size_t k = 0; k < kinds.size(); ++k)
    trial->nuisances.col(static_cast<Eigen::Index>(k)) =
        kinds[k].column.Segment(0, kinds[k].column.rows());
}

std::optional<std::vector<RivalView>> Planner::Views(const TrialRecord& trial) const {
  const auto nothing = trial.model->Predict(nothing_);
  // a rotor that only the effect holds has nothing to compare with: the effect is all there is
  const std::vector<double> base =
      nothing ? *nothing : std::vector<double>(trial.model->size(), 0.0);
  std::vector<RivalView> views;
  for (const Rival& rival : rivals_) {
    std::optional<RivalView> view = ViewOf(trial, rival, base);
    if (!view) return {};
    views.push_back(std::move(*view));
  }
  return views;
}

/// The candidate at the largest size that every rival survives.
std::optional<Planner::Scored> Planner::Score(const PlanCandidate& c, TriedScenario* tried) {
  tried->title = c.title;
  for (const double size : kSizes) {
    Scored s;
    s.candidate = c;
    s.size = size;
    TrialRecord trial;
    try {
      trial = Trial(c.toml(size), c);
    } catch (const InputError& e) {
      tried->refused = e.what();  // this rig cannot run it
      return std::nullopt;
    }
    s.safety.safe = true;
    for (const Rival& r : rivals_) {
      const SafetyResult one = CheckSafety(trial, r, {});
      if (one.largest_orbit > s.safety.largest_orbit) {
        s.safety.largest_orbit = one.largest_orbit;
        s.safety.orbit_at = one.orbit_at;
      }
      s.safety.orbit_share = std::max(s.safety.orbit_share, one.orbit_share);
      s.safety.largest_current = std::max(s.safety.largest_current, one.largest_current);
      if (!one.safe) s.safety = one;
      if (!one.safe) break;
    }
    tried->size = size;
    tried->largest_orbit = s.safety.largest_orbit;
    tried->orbit_at = s.safety.orbit_at;
    tried->orbit_share = s.safety.orbit_share;
    tried->refused = s.safety.reason;
    if (!s.safety.safe && c.toml(size) == c.toml(1) && size < 1) return std::nullopt;
    if (!s.safety.safe) continue;
    Prepare(&trial);
    const std::optional<std::vector<RivalView>> views = Views(trial);
    runs_ += trial.model->runs;
    if (!views) {
      tried->refused = "the rotor is lost near one of the models";
      return std::nullopt;
    }
    s.least = kInfinity;
    for (const auto& [a, b] : Pairs()) {
      s.probabilities.push_back(
          ProbabilityRight(SquaredDistances(trial, (*views)[a], (*views)[b])));
      s.least = std::min(s.least, s.probabilities.back());
    }
    tried->least_distance = DistanceOf(s.least);
    return s;
  }
  return std::nullopt;
}

Plan Planner::Run() {
  Plan plan;
  for (const Rival& r : rivals_) plan.names.push_back(r.Name());
  const std::vector<PlanCandidate> candidates = PlanCandidates(rig_, abilities_, options_.seed);
  if (candidates.empty())
    throw InputError(
        "the records of this case show nothing that the rig could be asked to do "
        "again, allowed: levitated records, or held ones with commanded coils");
  std::optional<Scored> best;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    Progress(0.3 + 0.5 * static_cast<double>(k) / static_cast<double>(candidates.size()),
             candidates[k].title);
    TriedScenario tried;
    std::optional<Scored> s = Score(candidates[k], &tried);
    plan.tried.push_back(tried);
    // of those that tell the names apart equally well the one that moves the rotor least
    if (s && (!best || std::pair(s->least, -s->safety.orbit_share) >
                           std::pair(best->least, -best->safety.orbit_share)))
      best = std::move(s);
  }
  std::stable_sort(plan.tried.begin(), plan.tried.end(),
                   [](const TriedScenario& a, const TriedScenario& b) {
                     return std::tuple(a.refused.empty(), a.least_distance, -a.orbit_share) >
                            std::tuple(b.refused.empty(), b.least_distance, -b.orbit_share);
                   });
  if (!best)
    throw InputError(
        fmt::format("no scenario is safe with every model that may be true; the "
                    "first was refused because {}",
                    plan.tried.front().refused));
  plan.title = best->candidate.title;
  plan.toml = best->candidate.toml(best->size);
  plan.duration = best->candidate.duration;
  plan.largest_orbit = best->safety.largest_orbit;
  plan.largest_current = best->safety.largest_current;
  Confirm(*best, plan);
  plan.text = Card(plan, *best);
  plan.runs = runs_;
  return plan;
}

}  // namespace ambrig
