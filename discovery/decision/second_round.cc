#include "discovery/decision/second_round.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace ambrig {

namespace {

const RankedEffect* AdoptedOf(const Explanation& e) {
  for (const RankedEffect& r : e.second_round)
    if (std::ranges::any_of(e.adopted, [&](const auto& a) { return IsSameName(a, r.effect); }))
      return &r;
  return nullptr;
}

}  // namespace

bool SecondRoundAdopted(const Explanation& e) { return AdoptedOf(e) != nullptr; }

void SettleSecondRound(std::size_t own, Explanation& out) {
  out.second_beside.clear();
  if (out.second_round.empty()) return;
  const std::vector<EffectInstance>& effects =
      out.second_round.front().fit.hypothesis.rig.effects;  // the candidate is the last
  for (std::size_t k = own; k + 1 < effects.size(); ++k)
    out.second_beside.push_back(Named(effects[k]));
  const RankedEffect* adopted = AdoptedOf(out);
  // the first effect's ranking is the explanation's
  const std::vector<RankedEffect>* judged = nullptr;
  if (adopted && IsSameName(adopted->effect, out.adopted[0]))
    judged = &out.ranking;
  else if (const auto it = out.beside.find(adopted ? Named(adopted->effect) : "");
           it != out.beside.end())
    judged = &it->second;
  for (RankedEffect& r : out.second_round) {
    if (!adopted) {
      r.probability = 0;
      continue;
    }
    // an effect that was not compared again has the probability of its round
    if (!judged) continue;
    const auto same = std::ranges::find_if(
        *judged, [&](const RankedEffect& j) { return IsSameName(j.effect, r.effect); });
    r.probability = same == judged->end() ? 0 : same->probability;
  }
}

std::string SecondRoundTitle(const Explanation& e) {
  return fmt::format("candidates for one more effect{}{}: {}",
                     e.second_beside.empty() ? "" : " beside ", fmt::join(e.second_beside, " and "),
                     SecondRoundAdopted(e) ? "one of them was adopted"
                                           : "none of them was needed, none is adopted");
}

}  // namespace ambrig
