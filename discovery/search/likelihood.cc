#include "discovery/search/likelihood.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace ambrig {

namespace {
// price of one more kind of effect: the same cause twice is likelier than two
constexpr double kLaw = 4;
// sd of the share that a law with other details explains, over what the best law leaves
constexpr double kLawVariation = 0.35;
constexpr double kExtra = 4;  // price of a number that only shapes a law further
}  // namespace

int PricedParameters(int count) { return std::min(count, 6); }

double MisfitWeight(double ratio, double n, double model_numbers) {
  return n / (1 + std::max(0.0, ratio * ratio - 1) * n / model_numbers);
}

double RowWeight(const CaseModel& model, double ratio, double n, double model_numbers) {
  return MisfitWeight(ratio, n, model_numbers) /
         static_cast<double>(std::max<std::size_t>(1, model.size()));
}

double Misfit(double ratio, double n) {
  const double excess = ratio * ratio - 1;
  return excess < 0 ? n * excess : kModelNumbers * std::log1p(excess * n / kModelNumbers);
}

double Score(const CaseModel& model, double ratio_fit, double ratio_validate,
             double effective_sample_size, int parameters, double penalty) {
  double fit = 0, validate = 0;
  const double worth_of_point = WorthOfPoint(model);
  for (const Target& t : model.targets())
    (Counts(model, t, Which::kFit) ? fit : validate) +=
        static_cast<double>(t.count) *
        (OverTime(model.data().records[t.record]) ? 1 : worth_of_point);
  const double share = fit / (fit + validate);
  const double n = std::min(effective_sample_size, kFloorNumbers);
  const auto misfit = [n](double ratio) { return Misfit(std::max(1.0, ratio), n); };
  return share * misfit(ratio_fit) + (1 - share) * misfit(ratio_validate) + penalty +
         parameters * std::log(std::min(effective_sample_size, kModelNumbers));
}

double Score(const CaseModel& model, const FitResult& fit, double effective_sample_size) {
  int of_effects = 0;
  for (std::size_t k = 0; k < fit.hypothesis.rig.effects.size(); ++k) {
    const auto n =
        std::count_if(fit.hypothesis.free.begin(), fit.hypothesis.free.end(),
                      [&](const FreeParameter& p) { return p.effect == static_cast<int>(k); });
    of_effects += PricedParameters(static_cast<int>(n));
  }
  std::set<std::string> laws;
  for (const EffectInstance& e : fit.hypothesis.rig.effects) laws.insert(e.name);
  return Score(model, fit.ratio_fit, fit.ratio_validate, effective_sample_size, of_effects,
               fit.penalty) +
         kLaw * static_cast<double>(laws.size());
}

std::vector<double> Probabilities(const std::vector<double>& scores,
                                  const std::vector<double>& shares,
                                  const std::vector<int>& extras) {
  std::vector<double> out;
  double sum = 0;
  for (std::size_t k = 0; k < scores.size(); ++k) {
    const double sd = kLawVariation * (1 - shares[0]), less = std::max(0.0, shares[0] - shares[k]);
    const double by_score = -0.5 * (scores[k] - scores[0]),
                 room = kExtra * std::max(0, extras[k] - extras[0]),
                 by_share = sd > 0 ? -0.5 * (std::pow(less / sd, 2) + room) : by_score;
    out.push_back(std::exp(std::max(by_score, by_share)));
    sum += out.back();
  }
  for (double& p : out) p /= sum;
  return out;
}

}  // namespace ambrig
