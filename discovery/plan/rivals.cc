#include "discovery/plan/rivals.h"

#include <algorithm>
#include <cmath>

#include "core/math/linear_equations.h"
#include "core/math/normal_distribution.h"
#include "discovery/model/jacobian.h"
#include "discovery/model/residual.h"

namespace ambrig {

using Eigen::Index;

namespace {

constexpr double kRigDifference = 0.3, kEffectDifference = 0.05;  // of a natural step

/// (a - b) over the floor, 0 where a row does not count.
Eigen::VectorXd Difference(const TrialRecord& trial, const std::vector<double>& a,
                           const std::vector<double>& b) {
  Eigen::VectorXd d = Eigen::VectorXd::Zero(static_cast<Index>(a.size()));
  ChangeOverFloor(*trial.model, b, a, d.data());
  return d;
}

/// Targets by how much of the signature they hold, the largest first, as many as vary by
/// themselves.
std::vector<const Target*> LargestTargets(const TrialRecord& trial,
                                          const Eigen::VectorXd& signature) {
  const auto squares = [&](const Target* t) {
    return signature.segment(static_cast<Index>(t->first), static_cast<Index>(t->count))
        .squaredNorm();
  };
  std::vector<const Target*> out;
  for (const Target& t : trial.model->targets())
    if (squares(&t) > 0) out.push_back(&t);
  std::ranges::stable_sort(out, std::greater(), squares);
  if (out.size() > kLawChannels) out.resize(kLawChannels);
  return out;
}

/// The signature of the law, in blocks of time and in channels.
Eigen::MatrixXd LawBlocks(const TrialRecord& trial, const Eigen::VectorXd& signature) {
  const std::vector<const Target*> channels = LargestTargets(trial, signature);
  Eigen::MatrixXd blocks =
      Eigen::MatrixXd::Zero(signature.size(), kLawBlocks + static_cast<Index>(channels.size()));
  for (const Target& t : trial.model->targets())
    for (std::size_t k = 0; k < t.count; ++k)
      blocks(static_cast<Index>(t.first + k),
             static_cast<Index>(k * kLawBlocks / std::max<std::size_t>(t.count, 1))) =
          signature(static_cast<Index>(t.first + k));
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const auto first = static_cast<Index>(channels[c]->first),
               count = static_cast<Index>(channels[c]->count);
    blocks.col(kLawBlocks + static_cast<Index>(c)).segment(first, count) =
        signature.segment(first, count);
  }
  return blocks;
}

/// Prior precision of all columns, the law as variable as that.
Eigen::MatrixXd WeightOf(const RivalView& view, const LawVariation& v) {
  Eigen::MatrixXd weight = view.weight;
  weight.bottomRightCorner(view.law, view.law) /= v.size * v.size;
  return weight;
}

double LogDeterminant(const Eigen::MatrixXd& M) {
  return 2 * Eigen::MatrixXd(M.llt().matrixL()).diagonal().array().log().sum();
}

}  // namespace

std::optional<RivalView> ViewOf(const TrialRecord& trial, const Rival& rival,
                                const std::vector<double>& nothing) {
  const auto predicted = trial.model->Predict(rival.hypothesis);
  if (!predicted) return {};
  RivalView view;
  view.predicted = *predicted;
  std::vector<std::size_t> rig, effects;
  for (std::size_t k = 0; k < rival.hypothesis.free.size(); ++k)
    (rival.hypothesis.free[k].effect < 0 ? rig : effects).push_back(k);
  const Eigen::MatrixXd of_rig = Jacobian(*trial.model, rival.hypothesis, rig, kRigDifference),
                        of_effects =
                            Jacobian(*trial.model, rival.hypothesis, effects, kEffectDifference);
  const auto n = static_cast<Index>(rival.hypothesis.free.size());
  const Eigen::MatrixXd law = rival.target.empty()
                                  ? Eigen::MatrixXd(static_cast<Index>(predicted->size()), 0)
                                  : LawBlocks(trial, Difference(trial, *predicted, nothing));
  view.law = law.cols();
  const Index own = n + trial.nuisances.cols(), all = own + view.law;
  view.columns.resize(static_cast<Index>(predicted->size()), all);
  for (std::size_t k = 0; k < rig.size(); ++k)
    view.columns.col(static_cast<Index>(rig[k])) = of_rig.col(static_cast<Index>(k));
  for (std::size_t k = 0; k < effects.size(); ++k)
    view.columns.col(static_cast<Index>(effects[k])) = of_effects.col(static_cast<Index>(k));
  view.columns.middleCols(n, own - n) = trial.nuisances;
  view.columns.rightCols(view.law) = law;
  view.weight = Eigen::MatrixXd::Identity(all, all);
  view.weight.topLeftCorner(n, n) = rival.precision;
  return view;
}

std::vector<double> SquaredDistances(const TrialRecord& trial, const RivalView& a,
                                     const RivalView& b) {
  const Index na = a.columns.cols(), nb = b.columns.cols();
  Eigen::MatrixXd all(a.columns.rows(), na + nb + 1);
  all << a.columns, b.columns, Difference(trial, a.predicted, b.predicted);
  const Eigen::MatrixXd gram = trial.row_weight * (all.transpose() * all);
  const Eigen::VectorXd with = gram.topRightCorner(na + nb, 1);
  std::vector<double> out;
  for (const LawVariation& v : kLawVariations) {
    Eigen::MatrixXd A = gram.topLeftCorner(na + nb, na + nb);
    A.topLeftCorner(na, na) += WeightOf(a, v);
    A.bottomRightCorner(nb, nb) += WeightOf(b, v);
    out.push_back(std::max(0.0, gram(na + nb, na + nb) - with.dot(SolveSymmetric(A, with))));
  }
  return out;
}

double Disbelief(const TrialRecord& trial, const RivalView& view, const std::vector<double>& data) {
  const Index n = view.columns.cols();
  Eigen::MatrixXd all(view.columns.rows(), n + 1);
  all << view.columns, Difference(trial, data, view.predicted);
  const Eigen::MatrixXd gram = trial.row_weight * (all.transpose() * all);
  const Eigen::VectorXd with = gram.topRightCorner(n, 1);
  std::vector<double> each;
  for (const LawVariation& v : kLawVariations) {
    const Eigen::MatrixXd weight = WeightOf(view, v), A = gram.topLeftCorner(n, n) + weight;
    each.push_back(gram(n, n) - with.dot(SolveSymmetric(A, with)) + LogDeterminant(A) -
                   LogDeterminant(weight) - 2 * std::log(v.share));
  }
  const double least = *std::min_element(each.begin(), each.end());
  double sum = 0;
  for (const double d : each) sum += std::exp(0.5 * (least - d));
  return least - 2 * std::log(sum);
}

double ProbabilityRight(double squared_distance) {
  return NormalProbability(0.5 * std::sqrt(squared_distance));
}

double ProbabilityRight(const std::vector<double>& squared_distances) {
  double sum = 0;
  for (std::size_t k = 0; k < squared_distances.size(); ++k)
    sum += kLawVariations[k].share * ProbabilityRight(squared_distances[k]);
  return sum;
}

double DistanceOf(double probability) {
  constexpr double kMost = 1 - 1e-9;
  return 2 * std::max(0.0, NormalQuantile(std::clamp(probability, 0.5, kMost)));
}

}  // namespace ambrig
