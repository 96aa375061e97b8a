#include "discovery/decision/conclusion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "discovery/decision/drift_test.h"
#include "discovery/decision/evidence.h"
#include "discovery/decision/second_round.h"
#include "discovery/search/likelihood.h"

namespace ambrig {

StageRatios RatiosOf(const CaseModel& model, const FitResult& fit) {
  return {fit.ratio_fit, fit.ratio_validate, WorstRecordRatio(model, fit.residual),
          WorstRatio(model, fit.residual, Which::kAll)};
}

ParameterNeed NeedOf(const CaseModel& model, const FitResult& fit, double effective_sample_size,
                     std::vector<std::string>& warnings) {
  ParameterNeed need;
  need.possible = Possible(fit);
  const double weight = RowWeight(model, fit.ratio_fit, effective_sample_size);
  for (std::size_t k = 0; k < fit.hypothesis.free.size(); ++k) {
    const FreeParameter& p = fit.hypothesis.free[k];
    if (p.effect >= 0 || p.sd <= 0) continue;
    const double shift = std::abs(fit.hypothesis.Coordinate(k));
    need.largest_shift = std::max(need.largest_shift, shift);
    if (shift < 3 || fit.jacobian.cols() <= static_cast<Eigen::Index>(k)) continue;
    const DriftTest test = TestDrift(model, fit, k, weight);
    need.constant = need.constant && test.holds;
    warnings.push_back(fmt::format(
        "{} had to move by {:+.1f} sd; the records {} (Q = {:.1f}, {} degrees of freedom): measure "
        "it, or look for what it stands in for",
        p.path, fit.hypothesis.Coordinate(k),
        test.holds ? "agree on that" : "do not agree on one value", test.q, test.freedom));
  }
  return need;
}

namespace {

constexpr double kNoiseLeft = 1.05;  // ratio up to which nothing but noise is left

/// The sets of the first name and of the further ones that are still adopted.
void SetsWith(Explanation& out, double named) {
  out.set = CredibleSet(out.ranking, named);
  std::erase_if(out.judged_beside, [&](const std::string& name) {
    return std::none_of(out.adopted.begin(), out.adopted.end(),
                        [&](const EffectInstance& a) { return Named(a) == name; });
  });
  for (const EffectInstance& a : out.adopted)
    if (const auto ranking = out.beside.find(Named(a)); ranking != out.beside.end())
      out.further_sets[Named(a)] = CredibleSet(ranking->second, named);
}

/// A name that explains a part only and that other names contest: what it may be expected to
/// explain rightly, its probability times its share of the error, is too little. Other physics
/// makes such names (docs/theory/discovery.md).
bool IsDoubtfulPatch(const Explanation& out, double explained, double named) {
  constexpr double kMost = 0.75;  // share of the error from which a name stands whatever its rivals
  constexpr double kLeast = 0.4;  // of probability times share
  if (explained >= kMost) return false;
  const EffectInstance& first = out.adopted[0];
  for (const RankedEffect& r : out.ranking)
    if (IsSameName(r.effect, first)) return named * r.probability * explained < kLeast;
  return false;
}

/// A law whose size came out with a sign that its usual physics does not have, and which leaves
/// much: another force acts in that direction (a rub holds the shaft back at one place). Where it
/// explains nearly all, the law is right and its sign says of what it is.
bool IsOfAnotherPhysics(const EffectInstance& e, const StageRatios& end, double explained) {
  constexpr double kNearlyAll = 0.9;  // of the squared error above the noise
  return HasImpossibleSign(e) && end.Answered() > kNoiseLeft && explained < kNearlyAll;
}

void SaySigns(const std::vector<EffectInstance>& adopted, std::vector<std::string>& warnings) {
  for (const EffectInstance& e : adopted)
    if (HasImpossibleSign(e))
      warnings.push_back(
          NameAtTarget(e.name, e.target) +
          " has the opposite sign of what usually causes it: it holds the shaft back, as a "
          "spring, a bellows or a passive magnet does");
}

std::string SaidOfUnits(double left, const UnitErrors& of_units) {
  return fmt::format(
      "{:.2f} times the noise stays: the errors of the coils that the rig file allows, taken off "
      "to first order, leave up to {:.2f}",
      left, of_units.largest);
}

/// What the catalogue's law leaves and its free shape does not is a detail of the law.
void SayShape(const FitResult& last, Explanation& out) {
  const StageRatios& s = *out.shaped;
  if (std::hypot(s.fit, s.validate) >= std::hypot(last.ratio_fit, last.ratio_validate) ||
      out.remainder.kind == RemainderKind::kNone)
    return;
  out.remainder.kind = RemainderKind::kLawVariation;
  const bool several = out.adopted.size() > 1;
  const char* advice = out.RefineFollows() ? ": ambrig refine writes it" : "";
  out.remainder.text = fmt::format(
      "{:.2f} times the noise stays with the catalogue's law{}; with {} shape free {:.2f} (fitted "
      "records) and {:.2f} (unseen){}",
      out.closure.floors_after, several ? "s" : "", several ? "one" : "its", s.fit, s.validate,
      advice);
}

/// The members of the set when no effect is named: the verdict itself and the best candidate.
void SetWithout(Explanation& out, double named) {
  out.judged_beside.clear();
  out.set = CredibleSet(out.ranking, out.verdict == ExplanationVerdict::kUnknown ? named : 0);
  for (SetMember& m : out.set)
    if (m.effect == "unknown" && out.verdict != ExplanationVerdict::kUnknown)
      m.effect = ToText(out.verdict);
}

}  // namespace

void Conclude(const CaseModel& model, const FitResult& nominal, const FitResult& base,
              const FitResult& last, const UnitErrors& of_units, Explanation& out) {
  const bool any = !out.adopted.empty();
  out.closure = ClosureOf(model, base.residual, last.residual);
  const StageRatios first = RatiosOf(model, nominal), parameters = RatiosOf(model, base);
  StageRatios end = RatiosOf(model, last);
  double explained = out.closure.explained;
  if (!any) out.shaped.reset();
  if (out.shaped && out.shaped->Answered() < end.Answered()) {
    end = *out.shaped;
    explained = std::max(explained, ShareOfAllRecords(parameters, end));
  }
  const bool within_units = IsWithinUnits(model, base.residual, of_units),
             rest_within_units =
                 !within_units && any && IsWithinUnits(model, last.residual, of_units);
  if (rest_within_units) {  // nothing is left for another effect
    end = {1, 1, 1};
    explained = 1;
  }
  const double share = ShareOfAllRecords(parameters, end);
  const double named = any ? NameProbability(share, std::max(end.fit, end.validate)) : 0;
  // An effect that leaves more than it explains is a patch on something unknown.
  const bool established = any && named >= 0.5 && !IsDoubtfulPatch(out, explained, named) &&
                           !IsOfAnotherPhysics(out.adopted[0], end, explained);
  if (any && !established) {
    out.adopted.clear();
    out.shaped.reset();
  }
  const ParameterNeed need =
      NeedOf(model, established ? last : base, out.effective_sample_size, out.warnings);
  out.verdict = VerdictOf(first, parameters, need,
                          established ? FoundEffect::kEstablished
                          : any       ? FoundEffect::kDoubtful
                                      : FoundEffect::kNone);
  if (within_units && out.verdict == ExplanationVerdict::kUnknown)
    out.verdict = ExplanationVerdict::kParameters;
  if (established)
    SetsWith(out, named), SaySigns(out.adopted, out.warnings);
  else
    SetWithout(out, any ? named : 0.2);
  out.remainder = RemainderOf(model, base.residual, last.residual, out.closure, established);
  if (out.ParametersNotBelieved())
    out.remainder.text =
        "the noise floor is reached only with rig parameters beyond their tolerances, or on whose "
        "values the records do not agree";
  if (out.closure.floors_after > kNoiseLeft &&
      ((within_units && out.verdict == ExplanationVerdict::kParameters) ||
       (rest_within_units && established)))
    out.remainder = {
        RemainderKind::kLawVariation, {}, SaidOfUnits(out.closure.floors_after, of_units)};
  if (out.shaped) SayShape(last, out);
  SettleSecondRound(model.data().rig.effects.size(), out);
}

void BelieveData(Explanation& out) {
  out.verdict = ExplanationVerdict::kData;
  double wrong = 0;
  for (const DataFault& f : out.data) wrong = std::max(wrong, f.probability);
  out.set = {{"data", "", wrong}};
  if (wrong < 0.95) out.set.push_back({"unknown", "", 1 - wrong});
  out.remainder.text = "the data are wrong: mend them before anything is fitted";
}

void ConcludeData(const CaseModel& model, const FitResult& nominal, Explanation& out) {
  out.closure = ClosureOf(model, nominal.residual, nominal.residual);
  out.remainder = RemainderOf(model, nominal.residual, nominal.residual, out.closure, false);
  BelieveData(out);
}

}  // namespace ambrig
