#include "discovery/explain/name_rankings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "discovery/decision/law_scatter.h"

namespace ambrig {

namespace {

bool HoldsName(const std::vector<EffectInstance>& list, const EffectInstance& e) {
  return std::ranges::any_of(list, [&](const EffectInstance& a) { return IsSameName(a, e); });
}

/// A ranking is copied while the search goes on: its sensitivities are most of its size, and no
/// reader asks for them.
std::vector<RankedEffect> WithoutSensitivities(std::vector<RankedEffect> ranking) {
  for (RankedEffect& r : ranking) r.fit.jacobian.resize(0, 0);
  return ranking;
}

}  // namespace

void NameRankings::KeepNames(const std::vector<RankedEffect>& ranking) {
  rounds_.emplace_back();
  for (const RankedEffect& r : ranking)
    rounds_.back().push_back(
        {r.effect, r.probability, r.RatioFit(), r.shaped.has_value(), r.shares_curve});
}

void NameRankings::NoteRound(int round, const std::vector<RankedEffect>& ranking) {
  (round == 0 ? first_ : last_round_) = ranking;
  KeepNames(ranking);
}

void NameRankings::NoteRoundBesideShape(const EffectInstance& found,
                                        const std::vector<RankedEffect>& ranking) {
  last_round_ = beside_[Named(found)] = ranking;
  KeepNames(ranking);
}

void NameRankings::NoteComparison(const AdoptedEffects& adopted, std::size_t index,
                                  std::vector<RankedEffect> ranking) {
  if (index > 0) {
    beside_[Named(adopted[index])] = std::move(ranking);
    return;
  }
  const std::vector<RankedEffect> before = std::move(first_);
  first_ = std::move(ranking);
  const auto judged = static_cast<std::ptrdiff_t>(first_.size());
  for (const RankedEffect& r : before) {
    const auto named = [&](const RankedEffect& o) { return IsSameName(o.effect, r.effect); };
    if (std::any_of(first_.begin(), first_.begin() + judged, named)) continue;
    first_.push_back(r);
    first_.back().probability = 0;
  }
}

void NameRankings::NoteJudgedBeside(const AdoptedEffects& adopted) {
  for (std::size_t k = 1; k < adopted.size(); ++k) judged_beside_.push_back(Named(adopted[k]));
}

std::vector<EffectInstance> NameRankings::RivalsOf(const AdoptedEffects& adopted,
                                                   std::size_t index) const {
  constexpr double kOpen = 0.02, kNear = 1.05;
  const EffectInstance& self = adopted[index];
  const std::vector<RankedName>* own = index == 0 && !rounds_.empty() ? &rounds_[0] : nullptr;
  const bool own_channels = adopted.IsOfOwnChannels(self);
  double most = 0;
  for (const auto& round : rounds_)
    for (const RankedName& n : round)
      if (IsSameName(n.effect, self) && n.probability > most) most = n.probability, own = &round;
  std::vector<EffectInstance> out;
  for (const auto& round : rounds_) {
    double best = kInfinity;
    for (const RankedName& n : round)
      if (n.ratio > 0) best = std::min(best, n.ratio);
    for (const RankedName& n : round) {
      const bool open =
          &round == own ? n.probability >= kOpen : n.ratio > 0 && n.ratio < kNear * best;
      const bool elsewhere = own_channels && n.effect.target != self.target;
      if (open && !elsewhere && !HoldsName(adopted.all(), n.effect) && !HoldsName(out, n.effect))
        out.push_back(n.effect);
    }
  }
  return out;
}

bool NameRankings::ComparedByShape(const EffectInstance& a, const EffectInstance& b) const {
  return std::ranges::any_of(rounds_, [&](const std::vector<RankedName>& round) {
    const auto by_shape = [&](const EffectInstance& e) {
      return std::ranges::any_of(
          round, [&](const RankedName& n) { return n.by_shape && IsSameName(n.effect, e); });
    };
    return by_shape(a) && by_shape(b);
  });
}

bool NameRankings::KeepSharedCurve(std::vector<RankedEffect>& ranking) const {
  bool changed = false;
  for (const std::vector<RankedName>& round : rounds_) {
    std::vector<std::pair<RankedEffect*, double>> sharing;  // with their probabilities in the round
    for (const RankedName& n : round)
      for (RankedEffect& r : ranking)
        if (n.shares_curve && n.probability > 0 && IsSameName(n.effect, r.effect))
          sharing.emplace_back(&r, n.probability);
    if (sharing.size() < 2) continue;
    const auto [nearer, share] =
        *std::ranges::min_element(sharing, {}, [](const auto& s) { return s.first->score; });
    for (const auto& [r, probability] : sharing) {
      r->shares_curve = true;
      r->shaped = nearer->shaped;
      const double score = nearer->score + 2 * std::log(share / probability);
      if (r == nearer || score >= r->score) continue;
      r->score = score;
      changed = true;
    }
  }
  return changed;
}

bool NameRankings::IsDoubtful(const EffectInstance& e, double least) const {
  const auto judged = beside_.find(Named(e));
  return judged != beside_.end() &&
         std::ranges::none_of(judged->second, [&](const RankedEffect& r) {
           return IsSameName(r.effect, e) && r.probability >= least;
         });
}

void NameRankings::BackTo(State before) {
  rounds_.resize(before.rounds);
  last_round_ = std::move(before.last_round);
}

void NameRankings::StateSizes(const SearchModels& models, const AdoptedEffects& adopted) {
  for (std::vector<RankedEffect>* list : {&first_, &last_round_})
    for (RankedEffect& r : *list) {
      const auto same = [&](const EffectInstance& e) { return IsSameName(e, r.effect); };
      const auto found = std::ranges::find_if(adopted.all(), same);
      const std::vector<EffectInstance>& fitted = r.fit.hypothesis.rig.effects;
      const auto place = std::ranges::find_if(fitted, same);
      if (found != adopted.all().end()) {
        r.effect = *found;
      } else if (r.fit.jacobian.size() > 0 && place != fitted.end()) {
        r.fit.sd = SdUnderDoubt(models.thinned(), r.fit, models.effective_sample_size());
        r.effect = FittedEffect(r.fit, static_cast<std::size_t>(place - fitted.begin()));
      }
    }
}

void NameRankings::CopyTo(Explanation& out) const {
  out.ranking = WithoutSensitivities(first_);
  out.second_round = WithoutSensitivities(last_round_);
  for (const auto& [name, ranking] : beside_) out.beside[name] = WithoutSensitivities(ranking);
  out.judged_beside = judged_beside_;
}

void NameRankings::MoveTo(Explanation& out) {
  out.ranking = std::move(first_);
  out.second_round = std::move(last_round_);
  out.beside = std::move(beside_);
  out.judged_beside = std::move(judged_beside_);
}

}  // namespace ambrig
