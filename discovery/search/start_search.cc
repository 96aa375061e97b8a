#include "discovery/search/start_search.h"

#include <algorithm>
#include <cmath>

#include "discovery/search/likelihood.h"
#include "discovery/search/resonance_starts.h"
#include "discovery/search/worst_records.h"

namespace ambrig {

namespace {

/// The rows of the two gains of an effect that has them.
std::vector<std::size_t> GainRows(const EffectInstance& e) {
  std::vector<std::size_t> rows;
  const EffectDescription& d = EffectNamed(e.name);
  if (!d.switches_pair) return rows;
  for (std::size_t k = 0; k < e.table.size(); ++k)
    if (d.Switches(e.table[k]) && std::isfinite(e.table[k].null_value)) rows.push_back(k);
  return rows;
}

/// How far the neighbours of a start stand off, coarse to fine.
struct Steps {
  double larger, smaller;  // of the answer
  double frequency;        // share
  double gain;             // of one of two gains, less; 1 over it, more
  double damping;          // less; 1 over it, more. 1: as it was sought
  // of kPart, that a start beside other effects has to explain after these steps to go on
  double least;
};
constexpr Steps kSteps[] = {{1.6, 0.4, 0.06, 0.5, 1, 0.15},
                            {1.25, 0.8, 0.025, 0.8, 0.6, 0.5},
                            {1.08, 0.93, 0.008, 0.92, 0.85, 0}};
// of what is left, that a start beside other effects has to explain
constexpr double kPart = 0.1;

/// Larger, smaller, lower, higher, with more and less at one of two gains, more and less damped.
std::vector<SimulatedStart> Neighbours(const EffectInstance& e, const Steps& steps) {
  std::vector<SimulatedStart> out = {{ScaledResonance(e, steps.larger)},
                                     {ScaledResonance(e, steps.smaller)}};
  const auto add = [&](std::size_t row, double factor) {
    out.push_back({e});
    out.back().effect.values[row] =
        std::clamp(e.values[row] * factor, e.table[row].lo, e.table[row].hi);
  };
  const bool resonance = IsResonance(EffectNamed(e.name));
  for (std::size_t k = 0; k < e.table.size(); ++k) {
    if (e.table[k].name == "frequency")
      for (const double factor : {1 - steps.frequency, 1 + steps.frequency}) add(k, factor);
    if (resonance && steps.damping < 1 && e.table[k].name == "damping")
      for (const double factor : {steps.damping, 1 / steps.damping}) add(k, factor);
  }
  for (const std::size_t row : GainRows(e))
    for (const double factor : {steps.gain, 1 / steps.gain}) add(row, factor);
  return out;
}

bool ExplainsMore(const SimulatedStart& a, const SimulatedStart& b) { return a.score < b.score; }

/// A large and a small size of one probe of a resonance: which frequencies are worth more.
std::vector<SimulatedStart> FewSizesOfResonance(const EffectInstance& e) {
  return {{ScaledResonance(e, 1.0)}, {ScaledResonance(e, 0.0625)}};
}

/// The other sizes and the patterns of its gains.
std::vector<SimulatedStart> MoreSizesOfResonance(const EffectInstance& e) {
  std::vector<SimulatedStart> out = {{ScaledResonance(e, 4.0)}, {ScaledResonance(e, 0.25)}};
  // nearly alone at one of its two gains (a gain of zero would leave the fit no slope)
  for (const std::size_t row : GainRows(e))
    for (const double factor : {1.0, 0.125}) {
      out.push_back({ScaledResonance(e, factor)});
      out.back().effect.values[row] *= 0.25;
    }
  return out;
}

/// Sizes over the usual range of an effect of contact: a rebound that comes a little later changes
/// all that follows, so no size tells what its neighbour would explain.
std::vector<SimulatedStart> SizesOfContact(const EffectInstance& e) {
  constexpr int kSizes = 14;
  std::vector<SimulatedStart> out;
  const EffectDescription& d = EffectNamed(e.name);
  for (std::size_t k = 0; k < e.table.size(); ++k) {
    const EffectParameter& p = e.table[k];
    if (!d.Switches(p)) continue;
    for (int n = 0; n < kSizes; ++n) {
      out.push_back({e});
      out.back().effect.values[k] =
          p.typical_lo * std::pow(p.typical_hi / p.typical_lo, n / (kSizes - 1.0));
    }
  }
  return out;
}

/// Whether a grid of frequencies, none of which is as near, has nothing to add to the starts that
/// were estimated from the records: where one of them explains much, and beside adopted effects,
/// which hide no mode from an estimate.
bool Suffice(const StartSearch& search, const std::vector<SimulatedStart>& estimated) {
  constexpr double kMuch = 0.2;  // of the error above the noise
  if (search.beside_others() && !estimated.empty()) return true;
  return std::any_of(estimated.begin(), estimated.end(), [&](const SimulatedStart& s) {
    return search.Explains(s) && s.share > kMuch;
  });
}

/// Whether neither the least nor the largest size of an effect of contact changes anything: nothing
/// touches in the records that are looked at.
bool ChangeNothing(const StartSearch& search, const std::vector<SimulatedStart>& sizes) {
  if (sizes.empty()) return true;
  std::vector<SimulatedStart> ends = {sizes.front(), sizes.back()};
  search.Simulate(ends);
  return ends[0].score == search.here() && ends[1].score == search.here();
}

/// The size that responses ask for: these tell of much smaller resonances than records over time
/// do.
void AddAskedSize(const StartSearch& search, std::vector<SimulatedStart>& sizes) {
  constexpr double kSmaller = 0.5;  // of the least size
  const SimulatedStart& least = sizes.back();
  if (!(least.amount > 0 && least.amount < kSmaller)) return;
  std::vector<SimulatedStart> asked = {{ScaledResonance(least.effect, least.amount)}};
  search.Simulate(asked);
  sizes.push_back(std::move(asked[0]));
}

/// Every probe in few sizes, then the better half of the resonances in all.
std::vector<SimulatedStart> SimulatedSizes(const StartSearch& search,
                                           const std::vector<ProbeGroup>& groups) {
  std::vector<SimulatedStart> starts, more;
  std::vector<std::pair<double, const EffectInstance*>> resonances;  // best score of each
  for (const ProbeGroup& g : groups) {
    const EffectInstance& e = g.probes[0];
    const bool resonance = IsResonance(EffectNamed(e.name));
    std::vector<SimulatedStart> sizes = resonance ? FewSizesOfResonance(e) : SizesOfContact(e);
    if (!resonance && ChangeNothing(search, sizes)) continue;
    search.Simulate(sizes);
    if (resonance) AddAskedSize(search, sizes);
    if (resonance)
      resonances.emplace_back(std::min_element(sizes.begin(), sizes.end(), ExplainsMore)->score,
                              &e);
    starts.insert(starts.end(), sizes.begin(), sizes.end());
  }
  // where no frequency gains anything in two sizes there is none to be found in more
  constexpr double kAnything = 1;  // of the score
  std::stable_sort(resonances.begin(), resonances.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  if (!resonances.empty() && resonances[0].first > search.here() - kAnything) return starts;
  resonances.resize((resonances.size() + 1) / 2);
  for (const auto& [score, e] : resonances)
    for (const SimulatedStart& s : MoreSizesOfResonance(*e)) more.push_back(s);
  search.Simulate(more);
  starts.insert(starts.end(), more.begin(), more.end());
  return starts;
}

}  // namespace

StartSearch::StartSearch(const CaseModel& model, const FitResult& now, double effective_sample_size)
    : model_(model),
      now_(now),
      effective_sample_size_(effective_sample_size),
      look_(WorstRecords(model, now)),
      beside_others_(HoldsAdopted(model, now)) {
  const auto run = model.PredictAll({now.hypothesis}, ModelFidelity::kCoarse, &look_)[0];
  if (!run) throw InputError("the model does not hold its rotor here");
  const std::vector<double> residual = Residual(model, *run);
  here_ = Score(model, Ratio(model, residual, Which::kFit),
                Ratio(model, residual, Which::kValidate), effective_sample_size, 0, 0);
  excess_ = Excess(residual);
  if (ResponsesShowError(model, now)) residual_ = residual;
}

double StartSearch::AmountOf(const std::vector<double>& residual) const {
  double product = 0, square = 0;
  for (const Target& t : model_.targets()) {
    if (!look_.records[t.record] || residual_.empty()) continue;
    for (std::size_t k = t.first; k < t.first + t.count; ++k) {
      const double change = residual_[k] - residual[k];
      product += residual_[k] * change;
      square += change * change;
    }
  }
  return square > 0 ? product / square : 1;
}

double StartSearch::Excess(const std::vector<double>& residual) const {
  double sum = 0;
  for (const RecordError& e : RecordErrors(model_, residual))
    if (look_.records[e.record]) sum += e.square - e.rows;
  return sum;
}

bool StartSearch::Explains(const SimulatedStart& s) const {
  constexpr double kWorth = 4;  // of the score
  return s.score <= here_ - kWorth && (!beside_others_ || s.share > kPart);
}

void StartSearch::Simulate(std::vector<SimulatedStart>& starts) const {
  constexpr std::size_t kChunk = 32;  // predictions in memory together
  for (std::size_t first = 0; first < starts.size(); first += kChunk) {
    const std::size_t last = std::min(starts.size(), first + kChunk);
    std::vector<Hypothesis> all;
    for (std::size_t k = first; k < last; ++k) {
      all.push_back(now_.hypothesis);
      all.back().AddEffect(starts[k].effect);
    }
    const auto runs = model_.PredictAll(all, ModelFidelity::kCoarse, &look_);
    for (std::size_t k = first; k < last; ++k) {
      if (!runs[k - first]) continue;
      const std::vector<double> residual = Residual(model_, *runs[k - first]);
      starts[k].score =
          Score(model_, Ratio(model_, residual, Which::kFit),
                Ratio(model_, residual, Which::kValidate), effective_sample_size_, 0, 0);
      starts[k].share = excess_ > 0 ? 1 - Excess(residual) / excess_ : 0;
      starts[k].amount = AmountOf(residual);
    }
  }
}

void StartSearch::Climb(std::vector<SimulatedStart>& starts) const {
  constexpr int kMost = 12;  // moves with steps of one kind
  for (SimulatedStart& start : starts)
    for (int shrink = 0; shrink < kMost && start.score > here_; ++shrink) {
      const bool lost = !std::isfinite(start.score);
      std::vector<SimulatedStart> smaller = {
          {ScaledResonance(start.effect, lost ? 1.0 / 6 : 1.0 / 3)}};
      Simulate(smaller);
      if (!lost && smaller[0].score >= start.score) break;
      start = smaller[0];
    }
  std::size_t climbing = starts.size();
  for (const Steps& steps : kSteps) {
    for (std::size_t k = 0; k < climbing; ++k)
      for (int move = 0; move < kMost && std::isfinite(starts[k].score); ++move) {
        std::vector<SimulatedStart> next = Neighbours(starts[k].effect, steps);
        Simulate(next);
        const auto best = std::min_element(next.begin(), next.end(), ExplainsMore);
        if (best->score >= starts[k].score) break;
        starts[k] = *best;
      }
    std::stable_sort(starts.begin(), starts.end(), ExplainsMore);
    if (&steps != &kSteps[0]) climbing = (climbing + 1) / 2;
    while (beside_others_ && climbing > 0 && starts[climbing - 1].share < steps.least * kPart)
      --climbing;
  }
}

bool SameValley(const EffectInstance& a, const EffectInstance& b) {
  for (std::size_t k = 0; k < a.values.size(); ++k)
    if (a.table[k].name == "frequency" ? std::abs(std::log(a.values[k] / b.values[k])) > 0.08
                                       : a.values[k] * b.values[k] < 0)
      return false;
  return true;
}

std::vector<ProbeGroup> ScanStarts(const StartSearch& search, const std::vector<ProbeGroup>& groups,
                                   const std::vector<EffectInstance>& estimated) {
  constexpr std::size_t kKept = 5;
  std::vector<SimulatedStart> starts;
  for (const EffectInstance& e : estimated)
    for (const double size : {1.0, 0.75, 0.5, 0.3}) starts.push_back({ScaledResonance(e, size)});
  search.Simulate(starts);
  if (!Suffice(search, starts)) {
    const std::vector<SimulatedStart> of_grid = SimulatedSizes(search, groups);
    starts.insert(starts.end(), of_grid.begin(), of_grid.end());
  }
  std::stable_sort(starts.begin(), starts.end(), ExplainsMore);
  std::vector<ProbeGroup> out;
  for (const SimulatedStart& s : starts) {
    if (out.size() >= kKept || !search.Explains(s)) break;
    if (std::any_of(out.begin(), out.end(),
                    [&](const ProbeGroup& g) { return SameValley(g.probes[0], s.effect); }))
      continue;
    ProbeGroup g;
    g.linear = false;
    g.narrow = true;
    g.probes.push_back(s.effect);
    out.push_back(std::move(g));
  }
  return out;
}

}  // namespace ambrig
