#include "discovery/decision/coil_choice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/math/linear_equations.h"
#include "discovery/search/fit_gram.h"
#include "discovery/search/likelihood.h"

namespace ambrig {

using Eigen::Index;

namespace {

constexpr double kBelievable = 4;       // sd: of forty, one lies beyond in every 400th machine
constexpr std::size_t kLeastCoils = 4;  // that can have something in common
constexpr std::size_t kLeftOut = 2;     // errors that may be left out: gain and edge of one coil
constexpr double kSds = 3;              // of the mean square of the amounts about 1
constexpr double kStep = 3;             // of the doubt

/// The errors of one kind of the coils of one bearing, by number.
using Group = std::vector<Index>;

std::vector<Group> GroupsOf(const std::vector<NuisanceKind>& kinds) {
  std::map<std::pair<std::string, NuisanceGroup>, Group> groups;
  for (std::size_t k = 0; k < kinds.size(); ++k)
    groups[{kinds[k].coil.substr(0, kinds[k].coil.find('.')), kinds[k].group}].push_back(
        static_cast<Index>(k));
  std::vector<Group> out;
  for (auto& [name, group] : groups) out.push_back(std::move(group));
  return out;
}

/// The mean of independent errors over its sd, that of the farthest from the median left out.
double SharedPart(std::vector<double> amounts) {
  std::sort(amounts.begin(), amounts.end());
  const double median = amounts[amounts.size() / 2];
  if (median - amounts.front() > amounts.back() - median)
    amounts.erase(amounts.begin());
  else
    amounts.pop_back();
  const double n = static_cast<double>(amounts.size());
  return std::accumulate(amounts.begin(), amounts.end(), 0.0) / std::sqrt(n);
}

/// Least squares of the coils' errors (the first columns) and the free parameters of a fit, under
/// their priors.
class JointStep {
 public:
  JointStep(const CaseModel& model, const std::vector<NuisanceKind>& possible, const FitResult& now)
      : coils_(static_cast<Index>(possible.size())),
        stay_(possible.size()),
        groups_(GroupsOf(possible)) {
    std::iota(stay_.begin(), stay_.end(), Index{0});
    const Index free = now.jacobian.cols(), all = coils_ + free,
                rows = static_cast<Index>(model.size());
    Eigen::MatrixXd columns(rows, all);
    for (Index k = 0; k < coils_; ++k) {
      columns.col(k) = possible[static_cast<std::size_t>(k)].column.Segment(0, rows);
      if (model.nuisances.any()) model.nuisances.Eliminate(columns.col(k).data());
    }
    columns.rightCols(free) = now.jacobian;
    for (Index row = 0; row < rows; ++row)
      if (!model.ok()[static_cast<std::size_t>(row)]) columns.row(row).setZero();
    const Eigen::MatrixXd gram =
        FitGram(model, FittedRecords(model, FitOptions()), columns, now.residual);
    normal_ = gram.topLeftCorner(all, all);
    product_ = gram.topRightCorner(all, 1);
    prior_ = Eigen::VectorXd::Ones(all);
    offset_ = Eigen::VectorXd::Zero(all);
    for (Index k = 0; k < free; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const bool toleranced = now.hypothesis.free[i].sd > 0;
      prior_(coils_ + k) = toleranced ? 1 : 1e-9;
      if (toleranced) offset_(coils_ + k) = -now.hypothesis.Coordinate(i);
      stay_.push_back(coils_ + k);
    }
  }

  /// The errors of coils that are left, by number.
  std::vector<Index> coils() const {
    std::vector<Index> out;
    std::copy_if(stay_.begin(), stay_.end(), std::back_inserter(out),
                 [&](Index k) { return k < coils_; });
    return out;
  }

  /// Groups of which only what differs from their mean is taken for errors of coils.
  const std::vector<Group>& centred() const { return centred_; }

  /// Takes the step with this weight of a squared error, without errors of coils that are not
  /// believable in it, and without what all coils of a bearing have in common where that is not.
  void Take(double weight) {
    for (;;) {
      const Eigen::VectorXd x =
          SolveSymmetric(Information(weight), weight * product_(stay_) + offset_(stay_));
      amounts_ = x.head(static_cast<Index>(coils().size()));
      const Index free = offset_.size() - coils_;
      shifts_ = x.tail(free) - offset_.tail(free);
      if (CentreGroups()) continue;
      Index worst = 0;
      if (amounts_.size() == 0 || amounts_.cwiseAbs().maxCoeff(&worst) <= kBelievable) return;
      stay_.erase(stay_.begin() + worst);
    }
  }

  /// Sd of the errors of coils that are left, over that of their prior.
  Eigen::VectorXd Sds(double weight) const {
    return InverseOf(Information(weight))
        .diagonal()
        .head(static_cast<Index>(coils().size()))
        .cwiseSqrt();
  }

  /// Whether the amounts of the step are what the coils of a machine differ by, all but those of
  /// one coil, and those of the rig parameters what their tolerances allow: with the spreads that
  /// the rig file states.
  bool IsBelievable() const {
    const auto left = static_cast<std::size_t>(amounts_.size());
    if (left == 0 || left + kLeftOut < static_cast<std::size_t>(coils_)) return false;
    double square = amounts_.squaredNorm(), n = static_cast<double>(left);
    for (Index k = 0; k < shifts_.size(); ++k) {
      if (prior_(coils_ + k) < 1) continue;  // of an effect, which has no tolerance
      square += shifts_(k) * shifts_(k);
      ++n;
    }
    return square / n < 1 + kSds * std::sqrt(2 / n);
  }

 private:
  /// Whether some group has in common what independent errors do not have; it is centred.
  bool CentreGroups() {
    const std::vector<Index> left = coils();
    const std::size_t before = centred_.size();
    std::erase_if(groups_, [&](const Group& group) {
      std::vector<double> amounts;
      for (std::size_t k = 0; k < left.size(); ++k)
        if (std::find(group.begin(), group.end(), left[k]) != group.end())
          amounts.push_back(amounts_(static_cast<Index>(k)));
      if (amounts.size() < kLeastCoils || std::abs(SharedPart(amounts)) <= kBelievable)
        return false;
      Eigen::MatrixXd change = Eigen::MatrixXd::Identity(normal_.rows(), normal_.rows());
      change(group, group).array() -= 1 / static_cast<double>(group.size());
      normal_ = change * normal_ * change;
      product_ = change * product_;
      centred_.push_back(group);
      return true;
    });
    return centred_.size() > before;
  }

  /// Of the columns that take part, with their priors.
  Eigen::MatrixXd Information(double weight) const {
    Eigen::MatrixXd A = weight * normal_(stay_, stay_);
    A.diagonal() += prior_(stay_);
    return A;
  }

  Index coils_;
  std::vector<Index> stay_;     // columns that take part, in order
  std::vector<Group> groups_;   // that are left as they are
  std::vector<Group> centred_;  // of which the mean was taken off
  Eigen::MatrixXd normal_;
  Eigen::VectorXd product_, prior_, offset_;  // offset_: from where a column stands to its drawing
  Eigen::VectorXd amounts_, shifts_;  // after the step: of the coils, of the free parameters
};

/// The columns of a group less their mean.
void Centre(const Group& group, std::vector<NuisanceKind>& kinds) {
  const auto whole = [&](Index k) {
    const StretchColumn& column = kinds[static_cast<std::size_t>(k)].column;
    return column.Segment(0, column.rows());
  };
  Eigen::VectorXd mean =
      Eigen::VectorXd::Zero(kinds[static_cast<std::size_t>(group[0])].column.rows());
  for (const Index k : group) mean += whole(k) / static_cast<double>(group.size());
  for (const Index k : group)
    kinds[static_cast<std::size_t>(k)].column = StretchColumn(whole(k) - mean);
}

}  // namespace

CoilErrorChoice ChooseCoilErrors(const CaseModel& model, const std::vector<NuisanceKind>& possible,
                                 const FitResult& now, double effective_sample_size) {
  const JointStep start(model, possible, now);
  const double weight = RowWeight(model, 1, effective_sample_size),
               least =
                   RowWeight(model, Ratio(model, now.residual, Which::kFit), effective_sample_size);
  CoilErrorChoice choice;
  for (;; choice.doubt *= kStep) {
    JointStep step = start;
    step.Take(weight / choice.doubt);
    if (!step.IsBelievable() && weight / choice.doubt > least) continue;
    std::vector<NuisanceKind> kinds = possible;
    for (const Group& group : step.centred()) Centre(group, kinds);
    for (const Index k : step.coils())
      choice.kinds.push_back(std::move(kinds[static_cast<std::size_t>(k)]));
    return choice;
  }
}

std::vector<double> SdOfCoilErrors(const CaseModel& model, const std::vector<NuisanceKind>& kinds,
                                   const FitResult& now, double effective_sample_size,
                                   double doubt) {
  const Eigen::VectorXd sds =
      JointStep(model, kinds, now).Sds(RowWeight(model, 1, effective_sample_size) / doubt);
  std::vector<double> out;
  for (std::size_t k = 0; k < kinds.size(); ++k)
    out.push_back(kinds[k].sd * sds(static_cast<Index>(k)));
  return out;
}

}  // namespace ambrig
