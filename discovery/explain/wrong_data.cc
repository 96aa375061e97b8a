// Wrong data end a search: before any fit, or when what was found lets them be seen.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "discovery/decision/conclusion.h"
#include "discovery/decision/describe.h"
#include "discovery/explain/explanation_search.h"

namespace ambrig {

/// Wrong data: nothing is fitted to them.
void Explainer::Stop(const FitResult& as_filed) {
  out_.base_ratio_fit = out_.final_ratio_fit = as_filed.ratio_fit;
  out_.base_ratio_validate = out_.final_ratio_validate = out_.nominal_ratio_validate;
  out_.final_fit = as_filed;
  ConcludeData(model_, as_filed, out_);
}

/// An effect that moves every column hides what a logger did to one of them until it is in the model. What was fitted
/// beside wrong data is not named. Where nothing was adopted, the wrong data may be why: then the best name is looked at.
bool Explainer::FindWrongData(const FitResult& base, const FitResult& now) {
  std::vector<std::string> names;
  for (const EffectInstance& e : out_.adopted) names.push_back(Named(e));
  const bool best = names.empty() && !out_.ranking.empty();
  if (best) names.push_back(Named(out_.ranking[0].effect));
  if (names.empty()) return false;
  const FitResult all = AllRows(best ? out_.ranking[0].fit : now);
  if (all.predicted.empty()) return false;
  out_.data = InspectData(full_, all.predicted, all.hypothesis);
  if (out_.data.empty()) return false;
  out_.warnings.push_back(
      fmt::format("the wrong data show beside {}, which they may have distorted: mend them and "
                  "explain again",
                  fmt::join(names, " and ")));
  out_.adopted.clear();
  out_.ranking.clear();
  out_.second_round.clear();
  out_.judged_beside.clear();
  out_.beside.clear();
  out_.further_sets.clear();
  out_.shaped.reset();
  out_.final_fit = base;
  out_.final_ratio_fit = base.ratio_fit;
  out_.final_ratio_validate = base.ratio_validate;
  ConcludeData(model_, base, out_);
  return true;
}

}  // namespace ambrig
