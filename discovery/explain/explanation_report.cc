#include "discovery/explain/explanation_report.h"

#include <fmt/format.h>

#include <cmath>

#include "discovery/decision/conclusion.h"
#include "discovery/decision/describe.h"
#include "discovery/decision/parameter_shifts.h"
#include "discovery/search/visible_size.h"

namespace ambrig {

Explanation ExplanationReport::Parts() const {
  Explanation out;
  out.data = data_;
  out.noise = models_.noise();
  out.nominal_ratio_validate = nominal_ratio_validate_;
  out.base_ratio_fit = base_ratio_fit_;
  out.base_ratio_validate = base_ratio_validate_;
  out.ladder = log_.ladder;
  out.warnings = log_.warnings;
  out.screened = names_.screened();
  out.effective_sample_size = models_.effective_sample_size();
  return out;
}

Explanation ExplanationReport::SoFar() const {
  Explanation out = Parts();
  out.adopted = adopted_.all();
  out.shaped = adopted_.shaped;
  names_.CopyTo(out);
  return out;
}

Explanation ExplanationReport::OfWrongData(const FitResult& base, double ratio_validate) const {
  Explanation out = Parts();
  out.final_fit = base;
  out.final_ratio_fit = base.ratio_fit;
  out.final_ratio_validate = ratio_validate;
  ConcludeData(models_.thinned(), base, out);
  return out;
}

Explanation ExplanationReport::Final(const FitResult& as_filed, const FitResult& base,
                                     const FitResult& now,
                                     const std::vector<NuisanceFound>& nuisances,
                                     const UnitErrors& of_units) {
  names_.StateSizes(models_, adopted_);
  Explanation out = Parts();
  out.adopted = adopted_.all();
  out.shaped = adopted_.shaped;
  names_.MoveTo(out);
  out.base = base.hypothesis;
  out.final_fit = now;
  out.final_ratio_fit = now.ratio_fit;
  out.final_ratio_validate = now.ratio_validate;
  out.nuisances = nuisances;
  Conclude(models_.thinned(), as_filed, base, now, of_units, out);
  AddToVerdict(base, now, out);
  return out;
}

void ExplanationReport::AddToVerdict(const FitResult& base, const FitResult& now,
                                     Explanation& out) const {
  constexpr double kReportedShift = 1;  // [sd]
  out.parameter_shifts = ParameterShifts(
      (out.verdict == ExplanationVerdict::kEffect ? now : base).hypothesis, kReportedShift);
  if (out.verdict == ExplanationVerdict::kUnknown && !out.ParametersNotBelieved()) {
    // The model may just hold the rotor on the rows that were fitted.
    const FitResult all = models_.AtAllRows(now);
    if (all.Stands())
      out.unexplained = Describe(models_.full(), all);
    else if (now.Stands())
      out.unexplained = Describe(models_.thinned(), now);
  }
  if (out.verdict == ExplanationVerdict::kNone || out.verdict == ExplanationVerdict::kParameters)
    out.hidden = FindHidden(now);
  if (out.verdict == ExplanationVerdict::kEffect || out.verdict == ExplanationVerdict::kUnknown)
    out.confusable = FindConfusable(out.ranking);
}

std::vector<VisibleSize> ExplanationReport::FindHidden(const FitResult& now) const {
  progress_(0.96, "how large could an effect be without being seen?");
  const double independent = models_.effective_sample_size();
  SignatureBank& signatures = models_.signatures();
  if (signatures.entries().empty() || signatures.partial()) {
    models_.ForgetSignatures();
    ScreenOptions coarse;
    coarse.effective_sample_size = independent;
    coarse.coarse = true;
    Screen(models_.thinned(), now, ResidualPeaks(), coarse, signatures);
  }
  return VisibleSizes(models_.thinned(), now, independent, signatures);
}

std::vector<Confusable> ExplanationReport::FindConfusable(
    const std::vector<RankedEffect>& ranking) const {
  std::vector<Confusable> out;
  for (std::size_t k = 1; k < ranking.size() && out.size() < 2; ++k) {
    const RankedEffect &best = ranking[0], &other = ranking[k];
    if (other.effect.name == best.effect.name || other.probability < 0.02) continue;
    progress_(0.97, "what would tell " + best.effect.name + " from " + other.effect.name);
    out.push_back({best.effect.name, other.effect.name,
                   SeparatingRecord(models_.thinned(), best.fit.hypothesis, other.fit.hypothesis)});
  }
  return out;
}

}  // namespace ambrig
