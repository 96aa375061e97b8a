#include "discovery/decision/pull_back.h"

#include <algorithm>
#include <cmath>

#include "discovery/model/residual.h"
#include "discovery/search/fit_gram.h"
#include "discovery/search/likelihood.h"

namespace ambrig {

namespace {

using Eigen::Index;

constexpr double kFar = 2;   // sd of a rig parameter that are looked at
constexpr double kGain = 2;  // of 2 log posterior that a better point is worth at least
constexpr int kMostMoves = 4;
constexpr double kAlike = 0.9;

/// An effect's parameter that could take the place of a rig parameter, and by how much per unit of
/// it.
struct Replacement {
  std::size_t parameter = 0;
  double per_unit = 0, likeness = 0;  // cosine between the columns
};

/// Those whose columns on the fitted records are much like that of parameter `k`, the most alike
/// first.
std::vector<Replacement> ReplacementsOf(const Hypothesis& h, const Eigen::MatrixXd& gram,
                                        std::size_t k) {
  std::vector<Replacement> out;
  const auto i = static_cast<Index>(k);
  for (std::size_t m = 0; m < h.free.size(); ++m) {
    const auto j = static_cast<Index>(m);
    if (h.free[m].effect < 0 || gram(i, i) <= 0 || gram(j, j) <= 0) continue;
    const double likeness = gram(i, j) / std::sqrt(gram(i, i) * gram(j, j));
    if (std::abs(likeness) > kAlike) out.push_back({m, -gram(i, j) / gram(j, j), likeness});
  }
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) {
    return std::abs(a.likeness) > std::abs(b.likeness);
  });
  return out;
}

Hypothesis WithChange(const Hypothesis& from, std::size_t parameter, double change) {
  Hypothesis h = from;
  h.Set(parameter, h.ValueAt(parameter, from.Coordinate(parameter) + change));
  return h;
}

class Puller {
 public:
  Puller(const CaseModel& model, const FitResult& fit, double effective_sample_size)
      : model_(model),
        best_{fit, false},
        weight_(RowWeight(model, fit.ratio_fit, effective_sample_size)) {
    point_.iterations = 0;
    point_.sensitivities = false;
    point_.effective_sample_size = effective_sample_size;
    for (const Target& t : model.targets())
      if (Counts(model, t, Which::kFit)) rows_ += CountedRows(model, t);
  }

  PulledBack Run() {
    const std::vector<std::size_t> far = FarOff();
    if (best_.fit.jacobian.cols() != static_cast<Index>(best_.fit.hypothesis.free.size()))
      return best_;
    for (int move = 0; move < kMostMoves; ++move)
      if (!std::any_of(far.begin(), far.end(), [this](std::size_t k) { return TryBack(k); })) break;
    return std::move(best_);
  }

 private:
  std::vector<std::size_t> FarOff() const {
    const Hypothesis& h = best_.fit.hypothesis;
    std::vector<std::size_t> far;
    for (std::size_t k = 0; k < h.free.size(); ++k)
      if (h.free[k].sd > 0 && std::abs(h.Coordinate(k)) > kFar) far.push_back(k);
    std::stable_sort(far.begin(), far.end(), [&](std::size_t a, std::size_t b) {
      return std::abs(h.Coordinate(a)) > std::abs(h.Coordinate(b));
    });
    return far;
  }

  double Cost(const FitResult& fit) const {
    return weight_ * rows_ * fit.ratio_fit * fit.ratio_fit + fit.penalty;
  }

  /// Whether the parameter was put back with gain, from the best point so far.
  bool TryBack(std::size_t k) {
    const Hypothesis from = best_.fit.hypothesis;
    const double shift = from.Coordinate(k);
    if (std::abs(shift) <= 1) return false;
    const Eigen::MatrixXd gram =
        FitGram(model_, FittedRecords(model_, point_), best_.fit.jacobian, best_.fit.residual);
    for (const Replacement& r : ReplacementsOf(from, gram, k))
      for (const double part : {0.0, 0.5}) {
        const double change = (part - 1) * shift;
        if (Keeps(WithChange(WithChange(from, k, change), r.parameter, r.per_unit * change),
                  r.parameter))
          return true;
      }
    return false;
  }

  /// Whether the point is better, as it is or with its replacement corrected once by what it
  /// leaves.
  bool Keeps(const Hypothesis& h, std::size_t replacement) {
    FitResult there = Fit(model_, h, point_);
    if (!there.converged) return false;
    const Eigen::MatrixXd column = best_.fit.jacobian.col(static_cast<Index>(replacement));
    const RecordSubset look = FittedRecords(model_, point_);
    const Eigen::MatrixXd left = FitGram(model_, look, column, there.residual),
                          was = FitGram(model_, look, column, best_.fit.residual);
    const double correction = (left(0, 1) - was(0, 1)) / left(0, 0);
    FitResult corrected = Fit(model_, WithChange(h, replacement, correction), point_);
    if (corrected.converged && Cost(corrected) < Cost(there)) there = std::move(corrected);
    if (Cost(there) > Cost(best_.fit) - kGain) return false;
    there.jacobian = best_.fit.jacobian;
    there.sd = best_.fit.sd;
    there.size_sd = best_.fit.size_sd;
    best_ = {std::move(there), true};
    return true;
  }

  const CaseModel& model_;
  PulledBack best_;
  FitOptions point_;
  double weight_, rows_ = 0;
};

}  // namespace

PulledBack PullBack(const CaseModel& model, const FitResult& fit, double effective_sample_size) {
  return Puller(model, fit, effective_sample_size).Run();
}

}  // namespace ambrig
