#include "discovery/model/stretch_column.h"

#include <algorithm>
#include <cassert>

namespace ambrig {

using Eigen::Index;

StretchColumn::StretchColumn(Eigen::VectorXd values) : rows_(values.size()) {
  Append(0, std::move(values));
}

void StretchColumn::Append(Index first, Eigen::VectorXd values) {
  assert(first + values.size() <= rows_);
  assert(stretches_.empty() || stretches_.back().end() <= first);
  stretches_.push_back({first, std::make_shared<const Eigen::VectorXd>(std::move(values))});
}

template <class Use>
void StretchColumn::ForEach(Index first, Index count, const Use& use) const {
  const Index end = first + count;
  auto s =
      std::ranges::upper_bound(stretches_, first, {}, [](const Stretch& x) { return x.end(); });
  for (; s != stretches_.end() && s->first < end; ++s) {
    const Index from = std::max(s->first, first), to = std::min(s->end(), end);
    use(from, s->values->segment(from - s->first, to - from));
  }
}

Eigen::VectorXd StretchColumn::Segment(Index first, Index count) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(count);
  ForEach(first, count,
          [&](Index row, const auto& values) { out.segment(row - first, values.size()) = values; });
  return out;
}

double StretchColumn::SquaredNorm(Index first, Index count) const {
  double sum = 0;
  ForEach(first, count, [&](Index, const auto& values) { sum += values.squaredNorm(); });
  return sum;
}

double StretchColumn::Dot(Index first, Index count, const Eigen::VectorXd& others) const {
  double sum = 0;
  ForEach(first, count, [&](Index row, const auto& values) {
    sum += values.dot(others.segment(row, values.size()));
  });
  return sum;
}

}  // namespace ambrig
