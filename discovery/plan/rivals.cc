#include "discovery/plan/rivals.h"

#include <algorithm>
#include <cmath>

#include "core/math/linear_equations.h"
#include "discovery/model/jacobian.h"

namespace ambrig {

using Eigen::Index;

namespace {

constexpr double kRigDifference = 0.3, kEffectDifference = 0.05;  // of a natural step

/// (a - b) over the floor, 0 where a row does not count.
Eigen::VectorXd Difference(const TrialRecord& trial, const std::vector<double>& a,
                           const std::vector<double>& b) {
  Eigen::VectorXd d = Eigen::VectorXd::Zero(static_cast<Index>(a.size()));
  for (const Target& t : trial.model->targets())
    for (std::size_t k = t.first; k < t.first + t.count; ++k)
      if (trial.model->ok()[k]) d(static_cast<Index>(k)) = (a[k] - b[k]) / t.floor;
  return d;
}

/// The signature of the law, in blocks of time.
Eigen::MatrixXd LawBlocks(const TrialRecord& trial, const Eigen::VectorXd& signature) {
  Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(signature.size(), kLawBlocks);
  for (const Target& t : trial.model->targets())
    for (std::size_t k = 0; k < t.count; ++k)
      blocks(static_cast<Index>(t.first + k),
             static_cast<Index>(k * kLawBlocks / std::max<std::size_t>(t.count, 1))) =
          signature(static_cast<Index>(t.first + k));
  return blocks;
}

double LogDeterminant(const Eigen::MatrixXd& M) {
  return 2 * Eigen::MatrixXd(M.llt().matrixL()).diagonal().array().log().sum();
}

}  // namespace

bool ViewOf(const TrialRecord& trial, const Rival& rival, const std::vector<double>& nothing,
            RivalView* view) {
  const auto predicted = trial.model->Predict(rival.hypothesis);
  if (!predicted) return false;
  view->predicted = *predicted;
  std::vector<std::size_t> rig, effects;
  for (std::size_t k = 0; k < rival.hypothesis.free.size(); ++k)
    (rival.hypothesis.free[k].effect < 0 ? rig : effects).push_back(k);
  const Eigen::MatrixXd of_rig = Jacobian(*trial.model, rival.hypothesis, rig, kRigDifference),
                        of_effects =
                            Jacobian(*trial.model, rival.hypothesis, effects, kEffectDifference);
  const auto n = static_cast<Index>(rival.hypothesis.free.size());
  const bool law = !rival.target.empty();
  view->columns.resize(static_cast<Index>(predicted->size()), n + (law ? kLawBlocks : 0));
  for (std::size_t k = 0; k < rig.size(); ++k)
    view->columns.col(static_cast<Index>(rig[k])) = of_rig.col(static_cast<Index>(k));
  for (std::size_t k = 0; k < effects.size(); ++k)
    view->columns.col(static_cast<Index>(effects[k])) = of_effects.col(static_cast<Index>(k));
  view->weight = Eigen::MatrixXd::Zero(view->columns.cols(), view->columns.cols());
  view->weight.topLeftCorner(n, n) = rival.precision;
  if (!law) return true;
  view->columns.rightCols(kLawBlocks) = LawBlocks(trial, Difference(trial, *predicted, nothing));
  view->weight.bottomRightCorner(kLawBlocks, kLawBlocks) =
      Eigen::MatrixXd::Identity(kLawBlocks, kLawBlocks) / (kLawVariation * kLawVariation);
  return true;
}

double SquaredDistance(const TrialRecord& trial, const RivalView& a, const RivalView& b) {
  const Index na = a.columns.cols(), nb = b.columns.cols();
  Eigen::MatrixXd all(a.columns.rows(), na + nb + 1);
  all << a.columns, b.columns, Difference(trial, a.predicted, b.predicted);
  const Eigen::MatrixXd gram = trial.row_weight * (all.transpose() * all);
  Eigen::MatrixXd A = gram.topLeftCorner(na + nb, na + nb);
  A.topLeftCorner(na, na) += a.weight;
  A.bottomRightCorner(nb, nb) += b.weight;
  const Eigen::VectorXd with = gram.topRightCorner(na + nb, 1);
  return std::max(0.0, gram(na + nb, na + nb) - with.dot(SolveSymmetric(A, with)));
}

double Disbelief(const TrialRecord& trial, const RivalView& view, const std::vector<double>& data) {
  const Index n = view.columns.cols();
  Eigen::MatrixXd all(view.columns.rows(), n + 1);
  all << view.columns, Difference(trial, data, view.predicted);
  const Eigen::MatrixXd gram = trial.row_weight * (all.transpose() * all);
  const Eigen::MatrixXd A = gram.topLeftCorner(n, n) + view.weight;
  const Eigen::VectorXd with = gram.topRightCorner(n, 1);
  return gram(n, n) - with.dot(SolveSymmetric(A, with)) + LogDeterminant(A) -
         LogDeterminant(view.weight);
}

double ProbabilityRight(double squared_distance) {
  return 0.5 * std::erfc(-0.5 * std::sqrt(squared_distance) / std::sqrt(2.0));
}

}  // namespace ambrig
