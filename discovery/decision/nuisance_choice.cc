#include "discovery/decision/nuisance_choice.h"

#include <algorithm>
#include <cmath>

#include "discovery/decision/drift_test.h"

namespace ambrig {

namespace {

constexpr double kPrice = 20;  // of a kind, in 2 log likelihood, beside 3 for each record
// Least part of the mean square of the amounts that is their spread.
constexpr double kVarying = 0.5;
// Or the part of the squared error that one amount for all records leaves: an effect that is there
// too may resemble the kind in every record.
constexpr double kMuchVarying = 0.1;
constexpr double kMostOfError = 0.5;  // of the squared error, which no further effect explains
// Of the squared error that is left: least that a kind explains which only the logger sees. There
// are many of these, and an effect elsewhere resembles one or the other a little.
constexpr double kWorth = 0.05;
constexpr std::size_t kMostKinds = 10;  // kinds

struct Gain {
  double gain = 0;     // in 2 log likelihood
  double varying = 0;  // of that: what one amount for all records would not explain
  double spread = 0;   // part of the mean square of the amounts
  std::size_t records = 0;
};

/// What one kind explains of a residual, each record with its own amount.
Gain GainOf(const CaseModel& model, const NuisanceKind& kind, const Eigen::VectorXd& residual,
            double weight) {
  std::vector<double> value, information;
  Gain out;
  for (std::size_t r = 0; r < model.data().records.size(); ++r) {
    double square = 0, product = 0;
    for (const Target& t : model.targets()) {
      if (t.record != r) continue;
      const auto first = static_cast<Eigen::Index>(t.first), n = static_cast<Eigen::Index>(t.count);
      square += kind.column.SquaredNorm(first, n);
      product += kind.column.Dot(first, n, residual);
    }
    if (square * weight < 1e-4) continue;
    out.gain += weight * product * product / (square + 1 / weight);
    out.records += 1;
    value.push_back(product / square);
    information.push_back(weight * square);
  }
  if (value.size() < 2) return out;
  out.varying = TestDrift(value, information).q;
  out.spread = SpreadOf(value, information, out.varying);
  return out;
}

/// Whether most kinds of a group were chosen: what moved the zeros of three sensors from record to
/// record moves the fourth one's, too.
bool MostAreChosen(const std::vector<NuisanceKind>& possible,
                   const std::vector<NuisanceKind>& chosen, NuisanceGroup group) {
  const auto of_group = [&](const NuisanceKind& k) { return k.group == group; };
  return 2 * std::count_if(chosen.begin(), chosen.end(), of_group) >
         std::count_if(possible.begin(), possible.end(), of_group);
}

}  // namespace

double SpreadOf(const std::vector<double>& value, const std::vector<double>& information,
                double q) {
  double sum = 0, square = 0;
  for (const double i : information) sum += i, square += i * i;
  const double freedom = static_cast<double>(value.size()) - 1, scale = sum - square / sum;
  const double variance = scale > 0 ? std::max(0.0, (q - freedom) / scale) : 0;
  double weights = 0, mean = 0, total = 0;
  for (std::size_t r = 0; r < value.size(); ++r) {
    const double w = 1 / (1 / information[r] + variance);
    weights += w;
    mean += w * value[r];
    total += w * value[r] * value[r];
  }
  mean /= weights;
  return total > 0 ? 1 - weights * mean * mean / total : 0;
}

std::vector<NuisanceKind> ChooseNuisances(const CaseModel& model,
                                          const std::vector<NuisanceKind>& possible,
                                          const std::vector<double>& residual, double weight,
                                          bool effects_found) {
  Eigen::VectorXd left = Eigen::Map<const Eigen::VectorXd>(
      residual.data(), static_cast<Eigen::Index>(residual.size()));
  std::vector<NuisanceKind> chosen;
  while (chosen.size() < kMostKinds) {
    const NuisanceKind* best = nullptr;
    double most = 0;
    const double worth = kWorth * weight * left.squaredNorm();
    for (const NuisanceKind& kind : possible) {
      if (std::any_of(chosen.begin(), chosen.end(),
                      [&](const NuisanceKind& c) { return c.name == kind.name; }))
        continue;
      const Gain g = GainOf(model, kind, left, weight);
      const double price = kPrice + 3 * static_cast<double>(g.records), over = g.gain - price;
      const bool logger =
          kind.group == NuisanceGroup::kLoggerZero || kind.group == NuisanceGroup::kDrift;
      if (over > (logger ? std::max(most, worth) : most) && g.varying > price &&
          (g.spread > kVarying || g.varying > kMuchVarying * weight * left.squaredNorm() ||
           (effects_found && g.gain > kMostOfError * weight * left.squaredNorm()) ||
           (!logger && MostAreChosen(possible, chosen, kind.group))))
        most = over, best = &kind;
    }
    if (!best) break;
    chosen.push_back(*best);
    Nuisances so_far;
    so_far.Use(model, chosen, weight);
    left = Eigen::Map<const Eigen::VectorXd>(residual.data(),
                                             static_cast<Eigen::Index>(residual.size()));
    so_far.Eliminate(left.data());
  }
  return chosen;
}

}  // namespace ambrig
