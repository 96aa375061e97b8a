#include "discovery/data/signal_match.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

namespace ambrig {

Match MatchOf(const MatchedColumn& c) { return MatchLater(c, 0, 0); }

Match MatchLater(const MatchedColumn& c, long late, long first) {
  double n = 0, sy = 0, sp = 0, syy = 0, spp = 0, syp = 0, see = 0;
  const auto rows = static_cast<long>(c.size());
  for (long row = 0; row < rows; ++row) {
    const long from = row < first ? row : row - late;
    const auto k = static_cast<std::size_t>(row);
    if (!c.ok[k] || from < 0 || from >= rows) continue;
    const double y = c.measured[k], p = c.predicted[static_cast<std::size_t>(from)];
    n += 1;
    sy += y;
    sp += p;
    syy += y * y;
    spp += p * p;
    syp += y * p;
    see += (y - p) * (y - p);
  }
  Match m;
  if (n < 2) return m;
  const double vy = std::max(0.0, syy / n - sy * sy / n / n),
               vp = std::max(0.0, spp / n - sp * sp / n / n), cov = syp / n - sy * sp / n / n;
  m.gain = vp > 0 ? cov / vp : 0;
  m.correlation = vy > 0 && vp > 0 ? cov / std::sqrt(vy * vp) : 0;
  m.measured_rms = std::sqrt(syy / n);
  m.predicted_rms = std::sqrt(spp / n);
  m.measured_move = std::sqrt(vy);
  m.predicted_move = std::sqrt(vp);
  m.error = std::sqrt(see / n);
  return m;
}

double ErrorAgainst(const std::vector<double>& measured, const std::vector<double>& predicted,
                    const std::vector<char>& ok, double factor) {
  double sum = 0, n = 0;
  for (std::size_t k = 0; k < measured.size() && k < predicted.size(); ++k) {
    if (!ok[k]) continue;
    sum += std::pow(measured[k] - factor * predicted[k], 2);
    n += 1;
  }
  return n > 0 ? std::sqrt(sum / n) : 0;
}

namespace {

using Rows = Eigen::ArrayXd;

/// Squared errors of every sample, all columns added, with the prediction so many samples late.
class SquaredErrors {
 public:
  explicit SquaredErrors(const std::vector<MatchedColumn>& columns) {
    for (const MatchedColumn& c : columns) {
      const auto rows = static_cast<Eigen::Index>(c.size());
      Column column{Rows(rows), Rows(rows), Eigen::Map<const Rows>(c.predicted.data(), rows)};
      for (Eigen::Index k = 0; k < rows; ++k) {
        const bool ok = c.ok[static_cast<std::size_t>(k)] != 0;
        column.counts[k] = ok ? 1 : 0;
        column.all_count = column.all_count && ok;
        column.measured[k] = ok ? c.measured[static_cast<std::size_t>(k)] : 0;
      }
      columns_.push_back(std::move(column));
    }
  }

  void Shifted(long late, Rows& out) const {
    out.setZero();
    const Eigen::Index rows = out.size(), first = std::clamp<Eigen::Index>(late, 0, rows),
                       last = std::clamp<Eigen::Index>(rows + late, 0, rows);
    for (const Column& c : columns_) {
      const auto add = [&](Eigen::Index from, Eigen::Index count, const auto& predicted) {
        const auto error = c.measured.segment(from, count) - predicted;
        if (c.all_count)
          out.segment(from, count) += error.square();
        else
          out.segment(from, count) += (error * c.counts.segment(from, count)).square();
      };
      // Edges repeat the first or the last prediction.
      add(0, first, Rows::Constant(first, c.predicted[0]));
      if (last > first) add(first, last - first, c.predicted.segment(first - late, last - first));
      add(last, rows - last, Rows::Constant(rows - last, c.predicted[rows - 1]));
    }
  }

 private:
  struct Column {
    Rows measured, counts;  // counts: 1 or 0
    Eigen::Map<const Rows> predicted;
    bool all_count = true;
  };
  std::vector<Column> columns_;
};

}  // namespace

Shift BestShift(const std::vector<MatchedColumn>& columns, long most) {
  Shift best;
  if (columns.empty() || columns[0].size() == 0) return best;
  const std::size_t rows = columns[0].size();
  double n = 0;
  for (const MatchedColumn& c : columns)
    n += static_cast<double>(std::count(c.ok.begin(), c.ok.end(), 1));
  if (n == 0) return best;
  const SquaredErrors errors(columns);
  Rows plain(static_cast<Eigen::Index>(rows)), shifted = plain;
  errors.Shifted(0, plain);
  double least = plain.sum();
  for (long late = -most; late <= most; ++late) {
    if (late == 0) continue;
    errors.Shifted(late, shifted);
    // plain up to the instant, shifted from there on
    double sum = shifted.sum();
    constexpr Eigen::Index kBlock = 64;  // passed over where no instant in it can be the best
    for (Eigen::Index first = 0; first < plain.size(); first += kBlock) {
      const Eigen::Index count = std::min(kBlock, plain.size() - first);
      const auto change = plain.segment(first, count) - shifted.segment(first, count);
      if (sum + change.min(0).sum() >= least) {
        sum += change.sum();
        continue;
      }
      for (Eigen::Index from = first; from < first + count; ++from) {
        if (sum < least) {
          least = sum;
          best.late = late;
          best.from = static_cast<std::size_t>(from);
        }
        sum += plain[from] - shifted[from];
      }
    }
  }
  // rows whose prediction lies outside the record were not predicted: they choose, but say nothing
  const bool late_at_once = best.late > 0 && static_cast<long>(best.from) <= best.late + 3;
  const auto inside = [&](std::size_t row) {
    const long from = static_cast<long>(row) - best.late;
    return (row < best.from && !late_at_once) || (from >= 0 && from < static_cast<long>(rows));
  };
  errors.Shifted(best.late, shifted);
  double before = 0, after = 0, at_once = 0, rows_inside = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    if (!inside(row)) continue;
    const auto k = static_cast<Eigen::Index>(row);
    before += plain[k];
    after += row < best.from ? plain[k] : shifted[k];
    at_once += shifted[k];
    rows_inside += 1;
  }
  const double share = rows_inside > 0 ? n * rows_inside / static_cast<double>(rows) : n;
  best.before = std::sqrt(before / share);
  best.after = std::sqrt(after / share);
  best.at_once = std::sqrt(at_once / share);
  return best;
}

}  // namespace ambrig
