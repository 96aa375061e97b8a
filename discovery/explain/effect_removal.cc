/// Effects that were adopted and go again: they have no size, or the others make them needless.
#include "core/base/coil_name.h"
#include "discovery/decision/decide.h"
#include "discovery/decision/likelihood.h"
#include "discovery/decision/where_it_acts.h"
#include "discovery/explain/explanation_search.h"
#include "discovery/search/candidate_fit.h"

namespace ambrig {

/// An effect that the last fit leaves without a size goes again.
void Explainer::DropSizeless(const FitResult& base, FitResult& now) {
  std::size_t sizeless = 0;
  while (sizeless < out_.adopted.size() && HasSize(now, rig_.effects.size() + sizeless)) ++sizeless;
  if (sizeless == out_.adopted.size()) return;
  out_.warnings.push_back(Named(out_.adopted[sizeless]) +
                          " lies within 3 sd of nothing: it is not named");
  out_.adopted.erase(out_.adopted.begin() + static_cast<std::ptrdiff_t>(sizeless));
  Hypothesis h = base.hypothesis;
  for (const EffectInstance& e : out_.adopted) h.AddEffect(e);
  const FitResult left =
      out_.adopted.empty() ? base : FitOn(model_, base, h, out_.effective_sample_size);
  now = left.Stands() ? left : base;
  if (!left.Stands()) out_.adopted.clear();
  for (std::size_t k = 0; k < out_.adopted.size(); ++k)
    out_.adopted[k] = FittedEffect(now, rig_.effects.size() + k);
  out_.ladder.push_back({"without an effect of no size", now.ratio_fit, now.ratio_validate});
  DropSizeless(base, now);
}

/// An effect that its successors made needless goes again.
void Explainer::Backward(const FitResult& base, FitResult& now) {
  if (out_.adopted.size() < 2) return;
  for (std::size_t drop = 0; drop < out_.adopted.size() && out_.adopted.size() > 1;) {
    if (IsBesideShape(out_.adopted[drop])) {
      ++drop;
      continue;
    }
    Progress(0.9, "without " + out_.adopted[drop].name);
    std::optional<FitResult> without = FitWithout(base, now, drop);
    const double gain = without ? Gain(*without, now) : kInfinity;
    if (!without || (!CoilErrorsExplain(drop, now, *without) &&
                     (WorthAdopting(*without, now, gain, 1, 0) ||
                      ExplainsItsChannels(model_, *without, now, gain, false)))) {
      ++drop;
      continue;
    }
    TakeOut(drop, std::move(*without), now);
  }
}

/// A further effect in whose place several others explain as much is none that can be named: a detail of the law beside
/// it as a rule.
void Explainer::DropUnnamed(const FitResult& base, FitResult& now) {
  constexpr double kLeastOwn = 0.3;
  for (std::size_t k = 1; k < out_.adopted.size();) {
    const auto judged = out_.beside.find(Named(out_.adopted[k]));
    const bool named = judged == out_.beside.end() ||
                       std::ranges::any_of(judged->second, [&](const RankedEffect& r) {
                         return IsSameName(r.effect, out_.adopted[k]) && r.probability >= kLeastOwn;
                       });
    std::optional<FitResult> without;
    if (!named) without = FitWithout(base, now, k);
    if (!without) {
      ++k;
      continue;
    }
    out_.warnings.push_back(Named(out_.adopted[k]) +
                            " is one of several effects that explain as much: it is not named");
    out_.beside.erase(judged);
    TakeOut(k, std::move(*without), now);
  }
}

std::optional<FitResult> Explainer::FitWithout(const FitResult& base, const FitResult& now,
                                               std::size_t adopted) const {
  constexpr double kShare = 0.9, kGain = 200;  // of the error, of the score: plainly needed
  Hypothesis h = base.hypothesis;
  for (std::size_t k = 0; k < out_.adopted.size(); ++k)
    if (k != adopted) h.AddEffect(out_.adopted[k]);
  const FitResult brief = FitShortly(model_, base, h, out_.effective_sample_size);
  const bool like_errors = !coil_errors_.empty() && NamesCoil(out_.adopted[adopted].target);
  if (brief.converged && !like_errors && Gain(brief, now) > kGain &&
      ExplainedShare(brief.ratio_fit, now.ratio_fit) > kShare &&
      ExplainedShare(brief.ratio_validate, now.ratio_validate) > kShare)
    return {};
  FitResult fit =
      FitOn(model_, base, brief.converged ? brief.hypothesis : h, out_.effective_sample_size);
  if (!fit.Stands()) return {};  // without it the model cannot follow the records at all
  return fit;
}

void Explainer::TakeOut(std::size_t adopted, FitResult without, FitResult& now) {
  out_.adopted.erase(out_.adopted.begin() + static_cast<std::ptrdiff_t>(adopted));
  now = std::move(without);
  out_.ladder.push_back(
      {"without the effect that became needless", now.ratio_fit, now.ratio_validate});
}

}  // namespace ambrig
