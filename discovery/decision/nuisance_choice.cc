#include "discovery/decision/nuisance_choice.h"

#include <algorithm>
#include <cmath>

#include "discovery/decision/drift_test.h"

namespace ambrig {

namespace {

constexpr double kPrice = 20;          // of a kind, in 2 log likelihood, beside 3 for each record
constexpr double kVarying = 0.4;       // share of the gain that only differing amounts explain
constexpr std::size_t kMostKinds = 8;  // kinds

struct Gain {
  double gain = 0, varying = 0;
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
      square += kind.column.segment(first, n).squaredNorm();
      product += kind.column.segment(first, n).dot(residual.segment(first, n));
    }
    if (square * weight < 1e-4) continue;
    out.gain += weight * product * product / (square + 1 / weight);
    out.records += 1;
    value.push_back(product / square);
    information.push_back(weight * square);
  }
  out.varying = TestDrift(value, information).q;
  return out;
}

}  // namespace

std::vector<NuisanceKind> ChooseNuisances(const CaseModel& model,
                                          const std::vector<NuisanceKind>& possible,
                                          const std::vector<double>& residual, double weight) {
  Eigen::VectorXd left = Eigen::Map<const Eigen::VectorXd>(
      residual.data(), static_cast<Eigen::Index>(residual.size()));
  std::vector<NuisanceKind> chosen;
  while (chosen.size() < kMostKinds) {
    const NuisanceKind* best = nullptr;
    double most = 0;
    for (const NuisanceKind& kind : possible) {
      if (std::any_of(chosen.begin(), chosen.end(),
                      [&](const NuisanceKind& c) { return c.name == kind.name; }))
        continue;
      const Gain g = GainOf(model, kind, left, weight);
      const double over = g.gain - kPrice - 3 * static_cast<double>(g.records);
      if (over > most && g.varying > kVarying * g.gain) most = over, best = &kind;
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
