#include "discovery/search/linear_judge.h"

#include <algorithm>
#include <cmath>

#include "core/math/linear_equations.h"
#include "discovery/model/residual.h"
#include "discovery/search/likelihood.h"

namespace ambrig {

using Eigen::Index;

namespace {
int Priced(const SignatureBank::Entry& entry) {
  return PricedParameters(static_cast<int>(entry.group.probes[0].table.size()));
}
}  // namespace

LinearJudge::LinearJudge(const CaseModel& model, const FitResult& base, SignatureBank& bank,
                         double effective_sample_size)
    : model_(model),
      base_(base),
      effective_sample_size_(effective_sample_size),
      nb_(base.jacobian.cols()),
      signatures_(bank),
      bank_(bank.Products(model)) {
  Eigen::MatrixXd columns(static_cast<Index>(model.size()), nb_ + 1);
  columns.leftCols(nb_) = base.jacobian;
  columns.col(nb_) =
      Eigen::Map<const Eigen::VectorXd>(base.residual.data(), static_cast<Index>(model.size()));
  own_ = RowProducts(model, columns, columns);
  with_ = bank.ProductsWith(model, columns);
  worth_of_point_ = WorthOfPoint(model);
  for (const Target& t : model.targets()) {
    ErrorSums& counted = counted_[Counts(model, t, Which::kFit) ? 0 : 1];
    (OverTime(model.data().records[t.record]) ? counted.rows : counted.points) +=
        CountedRows(model, t);
  }
}

double LinearJudge::RatioLeft(const Gram& g, const Eigen::VectorXd& c, Which which) const {
  const bool fit = which == Which::kFit;
  ErrorSums sums = counted_[fit ? 0 : 1];
  sums.square = std::max(0.0, c.dot((fit ? g.fit : g.validate) * c));
  if (sums.points > 0) {
    sums.square_points = std::max(0.0, c.dot((fit ? g.fit_points : g.validate_points) * c));
    sums.square = std::max(0.0, sums.square - sums.square_points);
  }
  return RatioOf(sums, worth_of_point_);
}

std::vector<LinearJudge::Column> LinearJudge::ColumnsOf(const SignatureBank::Entry& entry) {
  std::vector<Column> out;
  const ProbeGroup& g = entry.group;
  for (Index k = 0; k < entry.count(); ++k) {
    Column c = {entry.first + k, 0, 0};
    if (g.linear) {
      const std::size_t row = g.rows[static_cast<std::size_t>(k)];
      const EffectParameter& p = g.probes[0].table[row];
      const double size = g.probes[static_cast<std::size_t>(k)].values[row] - p.null_value;
      c.lo = (p.lo - p.null_value) / size;
      c.hi = (p.hi - p.null_value) / size;
      if (size < 0) std::swap(c.lo, c.hi);
    } else {
      c.lo = g.least;
      c.hi = g.most;
    }
    out.push_back(c);
  }
  return out;
}

Gram LinearJudge::Assemble(const std::vector<Column>& columns) const {
  const Index m = static_cast<Index>(columns.size()), n = nb_ + 1 + m;
  Gram g = Gram::Zero(model_, n, n);
  for (const auto part : {&Gram::fit, &Gram::validate, &Gram::fit_points, &Gram::validate_points}) {
    if ((g.*part).size() == 0) continue;
    Eigen::MatrixXd* const all = &(g.*part);
    const Eigen::MatrixXd *const own = &(own_.*part), *const with = &(with_.*part),
                                 *const bank = &(bank_.*part);
    all->topLeftCorner(nb_ + 1, nb_ + 1) = *own;
    for (Index i = 0; i < m; ++i) {
      const Index a = columns[static_cast<std::size_t>(i)].at;
      all->block(0, nb_ + 1 + i, nb_ + 1, 1) = with->col(a);
      all->block(nb_ + 1 + i, 0, 1, nb_ + 1) = with->col(a).transpose();
      for (Index j = 0; j < m; ++j)
        (*all)(nb_ + 1 + i, nb_ + 1 + j) = (*bank)(a, columns[static_cast<std::size_t>(j)].at);
    }
  }
  return g;
}

namespace {

/// The free amount furthest outside its limits; -1: all are inside.
template <class Columns>
Index WorstOutside(const Columns& columns, const Eigen::VectorXd& amount,
                   const std::vector<double>& fixed) {
  Index worst = -1;
  double most = 1e-9;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const double a = amount(static_cast<Index>(k));
    const double outside = std::max(columns[k].lo - a, a - columns[k].hi);
    if (std::isnan(fixed[k]) && outside > most) most = outside, worst = static_cast<Index>(k);
  }
  return worst;
}

}  // namespace

LinearJudge::Solution LinearJudge::Solve(const std::vector<Column>& columns, int parameters) const {
  const Gram g = Assemble(columns);
  const Index m = static_cast<Index>(columns.size());
  Solution s;
  double ratio = std::max(1.0, base_.ratio_fit), penalty = 0;
  std::vector<double> fixed(columns.size(), std::nan(""));
  for (int pass = 0; pass < 3 + static_cast<int>(m); ++pass) {
    // Coefficients c = [-shift, 1, -amount] of [rig columns, residual, signatures] with the least
    // error.
    Eigen::VectorXd c = Eigen::VectorXd::Zero(nb_ + 1 + m);
    c(nb_) = 1;
    std::vector<Index> free;
    for (Index k = 0; k < nb_; ++k) free.push_back(k);
    for (Index k = 0; k < m; ++k)
      if (std::isnan(fixed[static_cast<std::size_t>(k)]))
        free.push_back(nb_ + 1 + k);
      else
        c(nb_ + 1 + k) = -fixed[static_cast<std::size_t>(k)];
    const double weight = RowWeight(model_, ratio, effective_sample_size_);
    const Eigen::VectorXd known = g.fit * c;
    Eigen::MatrixXd A = weight * g.fit(free, free);
    Eigen::VectorXd b = -weight * known(free);
    for (Index i = 0; i < static_cast<Index>(free.size()); ++i) {
      const Index k = free[static_cast<std::size_t>(i)];
      const bool prior = k < nb_ && base_.hypothesis.free[static_cast<std::size_t>(k)].sd > 0;
      A(i, i) += prior ? 1 : 1e-9 * A(i, i) + 1e-12;
      if (prior) b(i) += base_.hypothesis.Coordinate(static_cast<std::size_t>(k));
    }
    const Eigen::VectorXd x = SolveSymmetric(A, b);
    c(free) = x;
    penalty = 0;
    for (Index k = 0; k < nb_; ++k)
      if (base_.hypothesis.free[static_cast<std::size_t>(k)].sd > 0)
        penalty += std::pow(base_.hypothesis.Coordinate(static_cast<std::size_t>(k)) - c(k), 2);
    s.amount = -c.tail(m);
    s.shift = -c.head(nb_);
    s.ratio_fit = RatioLeft(g, c, Which::kFit);
    s.ratio_validate =
        counted_[1].rows + counted_[1].points > 0 ? RatioLeft(g, c, Which::kValidate) : s.ratio_fit;
    // The amount furthest outside its limits stays at the limit.
    const Index worst = WorstOutside(columns, s.amount, fixed);
    if (worst >= 0) {
      const Column& l = columns[static_cast<std::size_t>(worst)];
      fixed[static_cast<std::size_t>(worst)] = std::clamp(s.amount(worst), l.lo, l.hi);
    } else if (s.ratio_fit > 0.95 * ratio) {
      break;
    }
    ratio = std::max(1.0, s.ratio_fit);
  }
  s.score =
      Score(model_, s.ratio_fit, s.ratio_validate, effective_sample_size_, parameters, penalty);
  return s;
}

EffectInstance LinearJudge::Start(const SignatureBank::Entry& entry, const Eigen::VectorXd& amount,
                                  Index first) {
  const ProbeGroup& g = entry.group;
  EffectInstance e = g.probes[0];
  for (const auto& [row, power] : g.scaling)
    e.values[row] = std::clamp(e.values[row] * std::pow(amount(first), power), e.table[row].lo,
                               e.table[row].hi);
  if (!g.linear) return e;
  for (std::size_t k = 0; k < g.rows.size(); ++k) {
    const std::size_t row = g.rows[k];
    const EffectParameter& p = e.table[row];
    const double size = g.probes[k].values[row] - p.null_value,
                 a = amount(first + static_cast<Index>(k));
    double value = p.null_value + a * size;
    const double margin = 1e-3 * std::abs(size);  // a start off the null, inside the bounds
    if (std::abs(value - p.null_value) < margin) value = p.null_value + (a < 0 ? -margin : margin);
    e.values[row] = std::clamp(value, p.lo, p.hi);
    if (e.values[row] == p.null_value)
      e.values[row] = std::clamp(p.null_value + 0.1 * size, p.lo, p.hi);
  }
  return e;
}

Candidate LinearJudge::Single(const SignatureBank::Entry& entry) const {
  const Solution s = Solve(ColumnsOf(entry), Priced(entry));
  Candidate c = {Start(entry, s.amount, 0), s.score, s.ratio_fit, s.ratio_validate,
                 entry.group.narrow,        0,       false,       {}};
  // Beside its true frequency a resonance seems smaller than it is.
  if (c.narrow && !entry.group.scaling.empty())
    c.other_starts.push_back(Start(entry, 2 * s.amount, 0));
  return c;
}

Eigen::VectorXd LinearJudge::LeftBy(const SignatureBank::Entry& entry) const {
  const Solution s = Solve(ColumnsOf(entry), Priced(entry));
  const auto rows = static_cast<Index>(base_.residual.size());
  Eigen::VectorXd left = Eigen::Map<const Eigen::VectorXd>(base_.residual.data(), rows) -
                         signatures_.Sum(entry, s.amount);
  if (nb_ > 0) left -= base_.jacobian * s.shift;
  return left;
}

LocalShare LinearJudge::ShareWhereItActs(const SignatureBank::Entry& entry) const {
  const Eigen::VectorXd left = LeftBy(entry);
  return ambrig::ShareWhereItActs(model_, base_.residual, {left.begin(), left.end()},
                                  [this](std::size_t r) { return signatures_.LooksAt(r); });
}

double LinearJudge::MotionShare(const SignatureBank::Entry& entry) const {
  constexpr double kMostSeen = 0.5;  // of the motion's error, by the bank's records
  const Eigen::Map<const Eigen::VectorXd> before(base_.residual.data(),
                                                 static_cast<Index>(base_.residual.size()));
  const Eigen::VectorXd after = LeftBy(entry);
  double all = 0, seen = 0, left = 0;
  for (const Target& t : model_.targets()) {
    if (!ShowsMotion(model_, t) && OverTime(model_.data().records[t.record])) continue;
    const auto first = static_cast<Index>(t.first), count = static_cast<Index>(t.count);
    const double rows = CountedRows(model_, t);
    const double excess = before.segment(first, count).squaredNorm() - rows;
    all += excess;
    if (!signatures_.LooksAt(t.record)) continue;
    seen += excess;
    left += after.segment(first, count).squaredNorm() - rows;
  }
  if (all <= 0) return 1;
  return seen < kMostSeen * all ? 0 : std::clamp(1 - left / seen, 0.0, 1.0);
}

double LinearJudge::LeastVisible(const SignatureBank::Entry& entry, Index column) const {
  const Index at = entry.first + column;
  const double weight = RowWeight(model_, base_.ratio_fit, effective_sample_size_);
  Eigen::MatrixXd own = weight * own_.fit.topLeftCorner(nb_, nb_);
  AddPriorInformation(base_.hypothesis, own);
  const Eigen::VectorXd with = weight * with_.fit.col(at).head(nb_);
  const double information = weight * bank_.fit(at, at) - with.dot(SolveSymmetric(own, with));
  return information > 0 ? 3 / std::sqrt(information) : kInfinity;
}

double LinearJudge::SignatureSize(const SignatureBank::Entry& entry, Index column) const {
  const Index at = entry.first + column;
  return std::sqrt(
      (bank_.fit(at, at) + bank_.validate(at, at)) /
      std::max(1.0, counted_[0].rows + counted_[0].points + counted_[1].rows + counted_[1].points));
}

CandidatePair LinearJudge::Pair(const SignatureBank::Entry& first,
                                const SignatureBank::Entry& second) const {
  std::vector<Column> columns = ColumnsOf(first);
  const std::vector<Column> more = ColumnsOf(second);
  columns.insert(columns.end(), more.begin(), more.end());
  const Solution s = Solve(columns, Priced(first) + Priced(second));
  return {Start(first, s.amount, 0), Start(second, s.amount, first.count()), s.score, s.ratio_fit,
          s.ratio_validate};
}

}  // namespace ambrig
