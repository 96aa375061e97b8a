// The promise of a plan: records simulated with models drawn from what is known, decided as the
// distance says they would be; and the card.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/math/noise.h"
#include "core/math/normal_distribution.h"
#include "core/record/channels.h"
#include "discovery/plan/planner.h"

namespace ambrig {

using Eigen::Index;

namespace {

enum Stream : std::uint32_t { kNumbers = 211, kLawNumbers, kLoadCell, kVariation };

/// The rival with its numbers drawn from their distribution, within their limits.
Hypothesis Drawn(const Rival& rival, std::uint64_t seed) {
  Hypothesis h = rival.hypothesis;
  const auto n = static_cast<Index>(h.free.size());
  Eigen::VectorXd z(n);
  for (Index k = 0; k < n; ++k)
    z(k) = std::clamp(Normal(seed, kNumbers, static_cast<std::uint64_t>(k)), -2.5, 2.5);
  const Eigen::VectorXd move = rival.drawn.llt().matrixU().solve(z);
  for (Index k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    h.Set(i, h.ValueAt(i, h.Coordinate(i) + move(k)));
  }
  return h;
}

/// Size of a law's variation, as often as each is to be expected.
double DrawnVariation(std::uint64_t seed) {
  double share = NormalProbability(Normal(seed, kVariation, 0));
  for (const LawVariation& v : kLawVariations) {
    if (share < v.share) return v.size;
    share -= v.share;
  }
  return std::end(kLawVariations)[-1].size;
}

/// Adds what a law of another form would change, in eighths of the record, and the noise that is
/// the load cells' own.
void Disturb(const TrialRecord& trial, const RivalView& truth, std::uint64_t seed,
             std::vector<double>& data) {
  const CaseModel& model = *trial.model;
  Eigen::VectorXd amount = Eigen::VectorXd::Zero(truth.columns.cols());
  const double size = DrawnVariation(seed);
  for (Index k = 0; k < truth.law; ++k)
    amount(amount.size() - truth.law + k) =
        size * Normal(seed, kLawNumbers, static_cast<std::uint64_t>(k));
  const Eigen::VectorXd change = truth.columns * amount;
  std::uint64_t cell = 0;
  for (const Target& t : model.targets()) {
    const std::string& name = model.data().records[0].data.channels[t.channel].name;
    const bool own = IsOfKind(name, ChannelKind::kLoadCell);
    const double used = own ? model.noise_model.Used(name) : 0;
    for (std::size_t k = t.first; k < t.first + t.count; ++k) {
      data[k] += t.floor * change(static_cast<Index>(k));
      if (own && std::isfinite(used)) data[k] += used * Normal(seed, kLoadCell, (cell << 32) + k);
    }
    ++cell;
  }
}

}  // namespace

std::optional<bool> Planner::Decide(const TrialRecord& trial, const std::vector<RivalView>& views,
                                    std::size_t truth, std::size_t other,
                                    std::uint64_t seed) const {
  auto data = trial.model->PredictNoisy(Drawn(rivals_[truth], seed), seed);
  if (!data) return std::nullopt;  // this draw loses the rotor
  Disturb(trial, views[truth], seed, *data);
  return Disbelief(trial, views[truth], *data) < Disbelief(trial, views[other], *data);
}

void Planner::Confirm(const Scored& best, Plan& plan) {
  TrialRecord trial = Trial(plan.toml, best.candidate);
  Prepare(&trial);
  plan.record_rate = trial.data->records[0].data.rate;
  for (const Channel& ch : trial.data->records[0].data.channels) plan.channels.push_back(ch.name);
  const std::optional<std::vector<RivalView>> found = Views(trial);
  if (!found) throw InputError("the planned record loses the rotor");
  const std::vector<RivalView>& views = *found;
  const auto pairs = Pairs();
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const auto [a, b] = pairs[p];
    Progress(0.8 + 0.2 * static_cast<double>(p) / static_cast<double>(pairs.size()),
             "simulated records");
    PlannedPair out;
    out.a = rivals_[a].Name();
    out.b = rivals_[b].Name();
    out.distance = DistanceOf(best.probabilities[p]);
    for (int k = 0; k < options_.draws; ++k) {
      const bool second = k % 2 == 1;
      const auto right = Decide(trial, views, second ? b : a, second ? a : b,
                                options_.seed * 100003 + 1000 * p + static_cast<std::size_t>(k));
      if (!right) continue;
      ++out.draws;
      out.right += *right ? 1 : 0;
    }
    out.probability = std::min(best.probabilities[p], 0.999);
    // what the simulated records contradict is not promised
    if (out.draws > 0 && out.right < out.draws)
      out.probability = std::min(out.probability, static_cast<double>(out.right) / out.draws);
    out.probability = std::max(out.probability, 0.5);
    plan.separates.push_back(out);
  }
  runs_ += trial.model->runs;
}

std::string Planner::Card(const Plan& plan, const Scored& best) const {
  std::string text = fmt::format("Record \"{}\": {} for {:.3g} s at {:.0f} Hz, channels {}.\n",
                                 plan.title, best.candidate.what, plan.duration, plan.record_rate,
                                 fmt::join(plan.channels, ", "));
  for (const PlannedPair& p : plan.separates) {
    const bool nothing = p.a == "nothing";
    text += fmt::format("- tells {} from {} with a probability of {:.1f} % ({})\n",
                        nothing ? p.b : p.a, nothing ? "no effect" : p.b, 100 * p.probability,
                        p.draws > 0 ? fmt::format("{} of {} simulated records were decided rightly",
                                                  p.right, p.draws)
                                    : "not checked with simulated records");
  }
  if (!best.candidate.clamped)
    text += fmt::format("- largest orbit expected: {:.3g} um\n", 1e6 * plan.largest_orbit);
  text += fmt::format("- largest coil current expected: {:.3g} A\n", plan.largest_current);
  const bool weak = std::any_of(plan.separates.begin(), plan.separates.end(),
                                [](const PlannedPair& p) { return p.probability < 0.9; });
  if (weak)
    text +=
        "- no record that this rig can make safely separates all of them: treat the names "
        "below 90 % as one\n";
  text +=
      "- if none of the names fits the new record, the missing physics is none of them: run "
      "`ambrig explain` with it added as a fit record and read what is said to be unexplained";
  return text;
}

}  // namespace ambrig
