#include "discovery/decision/decide.h"

#include <algorithm>
#include <cmath>

#include "core/math/chi_squared.h"

namespace ambrig {

namespace {
constexpr double kAgrees = 1.05;  // ratio on unseen records that counts as the floor
// discovery.md: what an effect of the catalogue should reach
constexpr double kGood = 1.5;
constexpr double kCompelling = 200;  // gain of the score that no detail of another law brings
constexpr double kDoubtfulShift = 3, kNeverParameter = 5;  // sd
// what a law's own detail leaves of the squared ratio that it explains, and at most
constexpr double kDetail = 0.02, kMostDetail = 0.1;
constexpr double kIntegratorsDiffer = 0.015;  // of the squared ratio
constexpr double kMostExplained = 0.9;        // of the squared error above the floor

/// What a sum of n squared normal numbers exceeds once in 1000.
double OnceInAThousand(double n) {
  constexpr double kNormal = 3.0902;
  return n * QuantileOfMeanSquare(n, kNormal);
}

double PriorsOf(const FitResult& fit) {
  return static_cast<double>(std::count_if(fit.hypothesis.free.begin(), fit.hypothesis.free.end(),
                                           [](const FreeParameter& p) { return p.sd > 0; }));
}

}  // namespace

bool Believable(const FitResult& fit) { return fit.penalty <= 2.2 * PriorsOf(fit); }

bool Possible(const FitResult& fit) {
  const double priors = PriorsOf(fit);
  return priors == 0 || fit.penalty <= OnceInAThousand(priors);
}

bool WorthAdopting(const FitResult& before, const FitResult& after, double score_gain, int round,
                   double first_fall) {
  const double b = before.ratio_validate, a = after.ratio_validate;
  if (!after.converged || score_gain < 20) return false;
  if (!Believable(before) && Believable(after) && a < 1.01 * b) return true;
  // What only the fit records show cannot be seen to hold elsewhere: it must be plain, and do no
  // harm.
  if (round == 0 && score_gain > kCompelling &&
      ExplainedShare(before.ratio_fit, after.ratio_fit) > 0.5 && a < 1.005 * b)
    return true;
  // The same of a second effect that explains most of what the fit records leave.
  if (round > 0 && score_gain > kCompelling && a < b &&
      ExplainedShare(before.ratio_fit, after.ratio_fit) > 0.75)
    return true;
  // Unseen records decide: the error must fall by more than integrators differ (1 % of the floor's
  // power), and by a good part of what is left; a second effect by more than a law's own detail.
  const double fall = b * b - a * a;
  if (fall < kIntegratorsDiffer + 0.01 * round) return false;
  if (round > 0 && fall < std::min(kDetail * first_fall, kMostDetail)) return false;
  const double share = ExplainedShare(b, a);
  if (round == 0) return share > 0.25;
  return share > 0.75 || (share > 0.4 && (fall > 0.1 * first_fall || score_gain > kCompelling));
}

bool ClosesAlone(const FitResult& before, const FitResult& after, double score_gain,
                 double next_gain) {
  constexpr double kLeft = 1.01, kShare = 0.9, kGain = 100, kOfNext = 0.1;
  const double b = before.ratio_validate, a = after.ratio_validate;
  return after.converged && Believable(after) && std::max(after.ratio_fit, a) < kLeft &&
         b * b - a * a > kIntegratorsDiffer && ExplainedShare(b, a) > kShare &&
         score_gain > kGain && next_gain < kOfNext * score_gain;
}

ExplanationVerdict VerdictOf(const StageRatios& nominal, const StageRatios& base,
                             const ParameterNeed& need, FoundEffect found) {
  if (found == FoundEffect::kEstablished) return ExplanationVerdict::kEffect;
  const double after = base.Answered(), before = nominal.Answered();
  // A channel among many may say that the numbers differ: parameters that bring it to the noise are
  // needed.
  constexpr double kShowsInChannel = 1.5, kCured = 0.75;
  const bool channel_needs = nominal.worst_channel > kShowsInChannel &&
                             base.worst_channel < kCured * nominal.worst_channel;
  if (before < kAgrees * 1.02 && !channel_needs) return ExplanationVerdict::kNone;
  const bool possible = need.largest_shift < kNeverParameter && need.possible &&
                        (need.largest_shift < kDoubtfulShift || need.constant);
  if (!possible) return ExplanationVerdict::kUnknown;
  if (after < kAgrees * 1.05) return ExplanationVerdict::kParameters;
  // Parameters explain all but a trace of a large misfit, and nothing else helps.
  if (found == FoundEffect::kNone && after < kGood &&
      ExplainedShare(before, after) > kMostExplained)
    return ExplanationVerdict::kParameters;
  return ExplanationVerdict::kUnknown;
}

}  // namespace ambrig
