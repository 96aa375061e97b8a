#include "discovery/model/nuisances.h"

#include <algorithm>
#include <cmath>

#include "discovery/model/in_parallel.h"
#include "discovery/model/model.h"

namespace ambrig {

using Eigen::Index;

void Nuisances::Use(const CaseModel& model, const std::vector<NuisanceKind>& kinds, double weight) {
  kinds_ = kinds;
  weight_ = weight;
  records_.clear();
  for (std::size_t r = 0; r < model.data().records.size(); ++r) {
    Index first = -1, end = 0;
    for (const Target& t : model.targets())
      if (t.record == r) {
        if (first < 0) first = static_cast<Index>(t.first);
        end = static_cast<Index>(t.first + t.count);
      }
    if (first < 0) continue;
    OfRecord o;
    o.first = first;
    o.count = end - first;
    o.record = r;
    for (std::size_t k = 0; k < kinds.size(); ++k)  // one that this record feels
      if (kinds[k].column.SquaredNorm(o.first, o.count) * weight > 1e-4) o.kinds.push_back(k);
    if (o.kinds.empty()) continue;
    o.columns.resize(o.count, static_cast<Index>(o.kinds.size()));
    for (std::size_t k = 0; k < o.kinds.size(); ++k)
      o.columns.col(static_cast<Index>(k)) = kinds[o.kinds[k]].column.Segment(o.first, o.count);
    Eigen::MatrixXd normal = o.columns.transpose() * o.columns;
    normal.diagonal().array() += 1 / weight;
    o.solve.compute(normal);
    records_.push_back(std::move(o));
  }
}

Eigen::VectorXd Nuisances::Fit(const OfRecord& r, const double* rows) const {
  const Eigen::Map<const Eigen::VectorXd> part(rows + r.first, r.count);
  return r.solve.solve(r.columns.transpose() * part);
}

void Nuisances::Eliminate(double* rows) const {
  for (const OfRecord& r : records_)
    Eigen::Map<Eigen::VectorXd>(rows + r.first, r.count) -= r.columns * Fit(r, rows);
}

void Nuisances::Eliminate(Eigen::MatrixXd& columns) const {
  InParallel(static_cast<std::size_t>(columns.cols()),
             [&](std::size_t c) { Eliminate(columns.col(static_cast<Index>(c)).data()); });
}

std::size_t Nuisances::count() const {
  std::size_t n = 0;
  for (const OfRecord& r : records_) n += r.kinds.size();
  return n;
}

std::vector<NuisanceFound> Nuisances::Amounts(const CaseModel& model,
                                              const std::vector<double>& residual) const {
  std::vector<NuisanceFound> out;
  for (const OfRecord& r : records_) {
    const Eigen::VectorXd amount = Fit(r, residual.data());
    const Eigen::MatrixXd covariance =
        r.solve.solve(Eigen::MatrixXd::Identity(amount.size(), amount.size())) / weight_;
    for (std::size_t k = 0; k < r.kinds.size(); ++k) {
      const NuisanceKind& kind = kinds_[r.kinds[k]];
      const auto i = static_cast<Index>(k);
      out.push_back({model.data().records[r.record].data_file, kind.name, kind.unit,
                     amount(i) * kind.sd, std::sqrt(covariance(i, i)) * kind.sd});
    }
  }
  return out;
}

std::vector<NuisanceKind> Thinned(const std::vector<NuisanceKind>& kinds, const CaseModel& full,
                                  const CaseModel& thin) {
  std::vector<NuisanceKind> out;
  for (const NuisanceKind& kind : kinds) {
    StretchColumn column(static_cast<Index>(thin.size()));
    for (std::size_t t = 0; t < thin.targets().size(); ++t) {
      const Target &few = thin.targets()[t], &all = full.targets()[t];
      const Eigen::VectorXd there =
          kind.column.Segment(static_cast<Index>(all.first), static_cast<Index>(all.count));
      if (there.isZero(0)) continue;
      Eigen::VectorXd left(static_cast<Index>(few.count));
      for (std::size_t k = 0; k < few.count; ++k)
        left(static_cast<Index>(k)) = there(static_cast<Index>(thin.sample(few.first + k)));
      column.Append(static_cast<Index>(few.first), std::move(left));
    }
    out.push_back({kind.name, kind.group, kind.unit, kind.sd, std::move(column)});
  }
  return out;
}

}  // namespace ambrig
