#include "discovery/model/nuisances.h"

#include <algorithm>
#include <cmath>

#include "core/math/linear_equations.h"
#include "discovery/model/case_model.h"
#include "discovery/model/in_parallel.h"

namespace ambrig {

using Eigen::Index;

namespace {

constexpr double kFelt = 1e-4;  // least information on an amount, in 1/sd^2, for it to count

/// The columns of these kinds in `count` rows from `first` on; zero where a row does not count.
Eigen::MatrixXd Columns(const CaseModel& model, const std::vector<NuisanceKind>& kinds,
                        const std::vector<std::size_t>& which, Index first, Index count) {
  Eigen::MatrixXd out(count, static_cast<Index>(which.size()));
  for (std::size_t k = 0; k < which.size(); ++k)
    out.col(static_cast<Index>(k)) = kinds[which[k]].column.Segment(first, count);
  for (Index row = 0; row < count; ++row)
    if (!model.ok()[static_cast<std::size_t>(first + row)]) out.row(row).setZero();
  return out;
}

/// The kinds of `from` as kinds of `to`, a model of the same case. `rows` makes the rows of a
/// target out of those that the column has there.
template <class Rows>
std::vector<NuisanceKind> WithColumns(const std::vector<NuisanceKind>& kinds, const CaseModel& from,
                                      const CaseModel& to, const Rows& rows) {
  std::vector<NuisanceKind> out;
  for (const NuisanceKind& kind : kinds) {
    StretchColumn column(static_cast<Index>(to.size()));
    for (std::size_t t = 0; t < to.targets().size(); ++t) {
      const Target& all = from.targets()[t];
      const Eigen::VectorXd there =
          kind.column.Segment(static_cast<Index>(all.first), static_cast<Index>(all.count));
      if (there.isZero(0)) continue;
      column.Append(static_cast<Index>(to.targets()[t].first), rows(t, there));
    }
    out.push_back(kind);
    out.back().column = std::move(column);
  }
  return out;
}

}  // namespace

void Nuisances::Use(const CaseModel& model, const std::vector<NuisanceKind>& kinds, double weight,
                    double weight_in_all) {
  kinds_ = kinds;
  weight_ = weight;
  weight_in_all_ = weight_in_all;
  records_.clear();
  for (std::size_t r = 0; r < model.data().records.size(); ++r) UseRecord(model, r);
  UseInAll(model);
}

void Nuisances::UseRecord(const CaseModel& model, std::size_t record) {
  OfRecord o;
  const auto [first, end] = model.RowsOf(record);
  o.first = static_cast<Index>(first);
  o.count = static_cast<Index>(end - first);
  o.record = record;
  for (std::size_t k = 0; k < kinds_.size(); ++k)
    if (!kinds_[k].in_all_records &&
        kinds_[k].column.SquaredNorm(o.first, o.count) * weight_ > kFelt)
      o.kinds.push_back(k);
  if (o.kinds.empty()) return;
  o.columns = Columns(model, kinds_, o.kinds, o.first, o.count);
  Eigen::MatrixXd normal = o.columns.transpose() * o.columns;
  normal.diagonal().array() += 1 / weight_;
  o.solve.compute(normal);
  records_.push_back(std::move(o));
}

void Nuisances::UseInAll(const CaseModel& model) {
  in_all_ = InAll();
  const auto rows = static_cast<Index>(model.size());
  for (std::size_t k = 0; k < kinds_.size(); ++k)
    if (kinds_[k].in_all_records && kinds_[k].column.SquaredNorm(0, rows) * weight_in_all_ > kFelt)
      in_all_.kinds.push_back(k);
  if (in_all_.kinds.empty()) return;
  in_all_.columns = Columns(model, kinds_, in_all_.kinds, 0, rows);
  for (Index k = 0; k < in_all_.columns.cols(); ++k)
    EliminateRecords(in_all_.columns.col(k).data());
  for (std::size_t r = 0; r < model.data().records.size(); ++r) {
    const auto [from, end] = model.RowsOf(r);
    const auto first = static_cast<Index>(from), count = static_cast<Index>(end - from);
    const auto part = in_all_.columns.middleRows(first, count);
    in_all_.spans.push_back(
        {first, count, r, !model.data().records[r].validate, part.transpose() * part});
  }
  weighing_ = WeighingOf(nullptr);
}

Nuisances::Weighing Nuisances::WeighingOf(const std::vector<char>* records) const {
  const Index n = in_all_.columns.cols();
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  for (const InAll::Span& span : in_all_.spans)
    if (Tells(span, records)) normal += span.normal;
  const SymmetricEigen modes = EigenOfSymmetric(normal);
  // of a mode of squared length s: (1 - 1/sqrt(1 + weight s))/s, which is weight/2 where s is
  // little
  const Eigen::VectorXd share = modes.values.unaryExpr([&](double s) {
    const double x = weight_in_all_ * std::max(0.0, s);
    return x < 1e-6 ? 0.5 * weight_in_all_ : weight_in_all_ * (1 - 1 / std::sqrt(1 + x)) / x;
  });
  return {modes.vectors * share.asDiagonal() * modes.vectors.transpose(),
          InverseOf(normal + Eigen::MatrixXd::Identity(n, n) / weight_in_all_)};
}

bool Nuisances::AllTell(const std::vector<char>* records) const {
  return std::ranges::all_of(
      in_all_.spans, [&](const InAll::Span& span) { return !span.fitted || Tells(span, records); });
}

Eigen::VectorXd Nuisances::Product(const double* rows, const std::vector<char>* records) const {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(in_all_.columns.cols());
  for (const InAll::Span& span : in_all_.spans)
    if (Tells(span, records))
      product.noalias() += in_all_.columns.middleRows(span.first, span.count).transpose() *
                           Eigen::Map<const Eigen::VectorXd>(rows + span.first, span.count);
  return product;
}

void Nuisances::EliminateInAll(double* rows, const std::vector<char>* records,
                               const Weighing& weighing) const {
  const Eigen::VectorXd product = Product(rows, records), shrunk = weighing.shrink * product,
                        estimate = weighing.inverse * product;
  for (const InAll::Span& span : in_all_.spans)
    Eigen::Map<Eigen::VectorXd>(rows + span.first, span.count).noalias() -=
        in_all_.columns.middleRows(span.first, span.count) *
        (Tells(span, records) ? shrunk : estimate);
}

Eigen::VectorXd Nuisances::Fit(const OfRecord& r, const double* rows) const {
  const Eigen::Map<const Eigen::VectorXd> part(rows + r.first, r.count);
  return r.solve.solve(r.columns.transpose() * part);
}

void Nuisances::EliminateRecords(double* rows) const {
  for (const OfRecord& r : records_)
    Eigen::Map<Eigen::VectorXd>(rows + r.first, r.count) -= r.columns * Fit(r, rows);
}

void Nuisances::Eliminate(double* rows, const std::vector<char>* records) const {
  EliminateRecords(rows);
  if (!in_all_.kinds.empty())
    EliminateInAll(rows, records, AllTell(records) ? weighing_ : WeighingOf(records));
}

void Nuisances::Eliminate(Eigen::MatrixXd& columns, const std::vector<char>* records) const {
  const Weighing weighing = AllTell(records) ? weighing_ : WeighingOf(records);
  InParallel(static_cast<std::size_t>(columns.cols()), [&](std::size_t c) {
    double* rows = columns.col(static_cast<Index>(c)).data();
    EliminateRecords(rows);
    if (!in_all_.kinds.empty()) EliminateInAll(rows, records, weighing);
  });
}

std::size_t Nuisances::count() const {
  std::size_t n = 0;
  for (const OfRecord& r : records_) n += r.kinds.size();
  return n;
}

std::vector<NuisanceFound> Nuisances::Amounts(const CaseModel& model,
                                              const std::vector<double>& residual) const {
  std::vector<NuisanceFound> out;
  const auto add = [&](const std::string& record, const std::vector<std::size_t>& kinds,
                       const Eigen::VectorXd& amount, const Eigen::MatrixXd& covariance) {
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const NuisanceKind& kind = kinds_[kinds[k]];
      const auto i = static_cast<Index>(k);
      out.push_back({record, kind.name, kind.unit, amount(i) * kind.sd,
                     std::sqrt(covariance(i, i)) * kind.sd, kind.group, kind.coil});
    }
  };
  std::vector<double> rest = residual;
  if (!in_all_.kinds.empty()) {
    std::vector<double> left = residual;
    EliminateRecords(left.data());
    const Eigen::VectorXd amount = weighing_.inverse * Product(left.data(), nullptr);
    add("", in_all_.kinds, amount, weighing_.inverse / weight_in_all_);
    Eigen::Map<Eigen::VectorXd> all(rest.data(), static_cast<Index>(rest.size()));
    all -= Columns(model, kinds_, in_all_.kinds, 0, all.size()) * amount;
  }
  for (const OfRecord& r : records_) {
    const Index n = r.columns.cols();
    add(model.data().records[r.record].data_file, r.kinds, Fit(r, rest.data()),
        r.solve.solve(Eigen::MatrixXd::Identity(n, n)) / weight_);
  }
  return out;
}

std::vector<NuisanceKind> OverNewFloors(const std::vector<NuisanceKind>& kinds,
                                        const CaseModel& model, const std::vector<Target>& before) {
  return WithColumns(kinds, model, model, [&](std::size_t t, const Eigen::VectorXd& there) {
    return Eigen::VectorXd(before[t].floor / model.targets()[t].floor * there);
  });
}

std::vector<NuisanceKind> Thinned(const std::vector<NuisanceKind>& kinds, const CaseModel& full,
                                  const CaseModel& thin) {
  return WithColumns(kinds, full, thin, [&](std::size_t t, const Eigen::VectorXd& there) {
    const Target& few = thin.targets()[t];
    Eigen::VectorXd left(static_cast<Index>(few.count));
    for (std::size_t k = 0; k < few.count; ++k)
      left(static_cast<Index>(k)) = there(static_cast<Index>(thin.sample(few.first + k)));
    return left;
  });
}

}  // namespace ambrig
