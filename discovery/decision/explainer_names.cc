// Names of several effects, each judged anew beside the others.
#include <algorithm>

#include "discovery/decision/explainer.h"
#include "discovery/decision/law_scatter.h"
#include "discovery/decision/rejudge.h"
#include "discovery/search/candidate_fit.h"
#include "discovery/shape/shape_names.h"

namespace ambrig {

/// Members of the round in which the effect was most probable that are still open (of the first effect, where no
/// round ranked it, those of the first round), and of the other rounds those that came within a twentieth of the
/// best fit: what went into the second place nearly as well as its owner may belong into the first one beside it.
/// An effect that was adopted for its own channels has rivals at its own place only.
std::vector<EffectInstance> Explainer::RivalsOf(std::size_t adopted) const {
  constexpr double kOpen = 0.02, kNear = 1.05;
  const EffectInstance& self = out_.adopted[adopted];
  const std::vector<RankedName>* own = adopted == 0 && !rounds_.empty() ? &rounds_[0] : nullptr;
  const bool own_channels = std::find(of_own_channels_.begin(), of_own_channels_.end(),
                                      Named(self)) != of_own_channels_.end();
  double most = 0;
  for (const auto& round : rounds_)
    for (const RankedName& n : round)
      if (IsSameName(n.effect, self) && n.probability > most) most = n.probability, own = &round;
  std::vector<EffectInstance> out;
  const auto named = [](const std::vector<EffectInstance>& list, const EffectInstance& e) {
    return std::any_of(list.begin(), list.end(),
                       [&](const EffectInstance& a) { return IsSameName(a, e); });
  };
  for (const auto& round : rounds_) {
    double best = kInfinity;
    for (const RankedName& n : round)
      if (n.ratio > 0) best = std::min(best, n.ratio);
    for (const RankedName& n : round) {
      const bool open =
          &round == own ? n.probability >= kOpen : n.ratio > 0 && n.ratio < kNear * best;
      const bool elsewhere = own_channels && n.effect.target != self.target;
      if (open && !elsewhere && !named(out_.adopted, n.effect) && !named(out, n.effect))
        out.push_back(n.effect);
    }
  }
  return out;
}

/// Whether a round compared both names with the shapes of their laws free: no law of the catalogue tells more than these.
bool Explainer::ComparedByShape(const EffectInstance& a, const EffectInstance& b) const {
  return std::any_of(rounds_.begin(), rounds_.end(), [&](const std::vector<RankedName>& round) {
    const auto by_shape = [&](const EffectInstance& e) {
      return std::any_of(round.begin(), round.end(), [&](const RankedName& n) {
        return n.by_shape && IsSameName(n.effect, e);
      });
    };
    return by_shape(a) && by_shape(b);
  });
}

/// The only effect against its rivals, and with the shapes of the laws.
void Explainer::JudgeOnlyName(const FitResult& base, FitResult& now) {
  const EffectInstance only = out_.adopted[0];
  Progress(0.92, "names in place of " + Named(only));
  std::vector<RankedEffect> ranking =
      RankBeside(model_, {base, now, out_.adopted}, 0, RivalsOf(0), out_.effective_sample_size);
  JudgeByShape(SettingFrom(0.92, 0.02), base, 0, ranking);
  // a name whose effect has no size is none
  const RankedEffect& best = *std::ranges::find_if(ranking, [&](const RankedEffect& r) {
    return IsSameName(r.effect, only) || HasSize(r.fit, rig_.effects.size());
  });
  if (!IsSameName(best.effect, only)) {
    now = FittedToTheEnd(base, best);
    out_.adopted[0] = FittedEffect(now, rig_.effects.size());
    out_.ladder.push_back(
        {Named(best.effect) + " in place of " + Named(only), now.ratio_fit, now.ratio_validate});
  }
  out_.shaped = best.shaped;
  NoteNames(0, std::move(ranking));
}

/// Each effect against its rivals beside the others; where a better one takes a place, once more. What is left alone of
/// a pair was found by the pair's fit: no round has compared it with other names.
void Explainer::RejudgeNames(const FitResult& base, FitResult& now, Names which) {
  constexpr int kPasses = 2;
  if (out_.adopted.size() == 1 && (which == Names::kAllAnew || out_.ranking.empty() ||
                                   !IsSameName(out_.ranking[0].effect, out_.adopted[0])))
    JudgeOnlyName(base, now);
  out_.judged_beside.clear();
  if (out_.adopted.size() < 2) return;
  bool swapped = true;
  for (int pass = 0; swapped && pass < kPasses; ++pass) {
    swapped = false;
    for (std::size_t k = 0; k < out_.adopted.size(); ++k) {
      if (IsBesideShape(out_.adopted[k])) continue;  // its own round tells more than plain laws do
      const std::vector<EffectInstance> rivals = RivalsOf(k);
      if (rivals.empty() && k > 0) continue;
      Progress(0.92, "names beside " + Named(out_.adopted[k == 0 ? 1 : 0]));
      std::vector<RankedEffect> ranking =
          RankBeside(model_, {base, now, out_.adopted}, k, rivals, out_.effective_sample_size);
      const RankedEffect& best = ranking[0];
      const std::size_t place = rig_.effects.size() + k;
      if (!IsSameName(best.effect, out_.adopted[k]) &&
          !ComparedByShape(best.effect, out_.adopted[k]) && HasSize(best.fit, place) &&
          (Believable(best.fit) || !Believable(now))) {
        out_.ladder.push_back({Named(best.effect) + " in place of " + Named(out_.adopted[k]),
                               best.fit.ratio_fit, best.fit.ratio_validate});
        now = best.fit;
        for (std::size_t e = 0; e < out_.adopted.size(); ++e)
          out_.adopted[e] = FittedEffect(now, rig_.effects.size() + e);
        swapped = true;
      }
      NoteNames(k, std::move(ranking));
    }
  }
  for (std::size_t k = 1; k < out_.adopted.size(); ++k)
    out_.judged_beside.push_back(Named(out_.adopted[k]));
}

/// The ranking of the first effect is the one beside the others; what was not judged there follows it.
void Explainer::NoteNames(std::size_t adopted, std::vector<RankedEffect> ranking) {
  if (adopted > 0) {
    out_.beside[Named(out_.adopted[adopted])] = std::move(ranking);
    return;
  }
  const std::vector<RankedEffect> before = std::move(out_.ranking);
  out_.ranking = std::move(ranking);
  const std::size_t judged = out_.ranking.size();
  for (const RankedEffect& r : before) {
    const auto named = [&](const RankedEffect& o) { return IsSameName(o.effect, r.effect); };
    if (std::any_of(out_.ranking.begin(),
                    out_.ranking.begin() + static_cast<std::ptrdiff_t>(judged), named))
      continue;
    out_.ranking.push_back(r);
    out_.ranking.back().probability = 0;
  }
}

/// An adopted effect has one size, that of the last fit. The sd of others is stated under the same doubt.
void Explainer::StateSizes() {
  for (std::vector<RankedEffect>* list : {&out_.ranking, &out_.second_round})
    for (RankedEffect& r : *list) {
      const auto same = [&](const EffectInstance& e) { return IsSameName(e, r.effect); };
      const auto adopted = std::ranges::find_if(out_.adopted, same);
      const std::vector<EffectInstance>& fitted = r.fit.hypothesis.rig.effects;
      const auto place = std::ranges::find_if(fitted, same);
      if (adopted != out_.adopted.end()) {
        r.effect = *adopted;
      } else if (r.fit.jacobian.size() > 0 && place != fitted.end()) {
        r.fit.sd = SdUnderDoubt(model_, r.fit, out_.effective_sample_size);
        r.effect = FittedEffect(r.fit, static_cast<std::size_t>(place - fitted.begin()));
      }
    }
}

}  // namespace ambrig
