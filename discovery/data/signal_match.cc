#include "discovery/data/signal_match.h"

#include <algorithm>
#include <cmath>

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

/// Squared errors of every sample, all columns added, with the prediction `late` samples late.
void SquaredErrors(const std::vector<MatchedColumn>& columns, long late, std::vector<double>& out) {
  const auto rows = static_cast<long>(out.size());
  std::fill(out.begin(), out.end(), 0.0);
  for (const MatchedColumn& c : columns) {
    const auto add = [&](long row, double predicted) {
      const auto k = static_cast<std::size_t>(row);
      const double e = c.ok[k] ? c.measured[k] - predicted : 0;
      out[k] += e * e;
    };
    // Edges repeat the first or the last prediction; between them the loop has no branch.
    const long first = std::clamp(late, 0L, rows), last = std::clamp(rows + late, 0L, rows);
    for (long k = 0; k < first; ++k) add(k, c.predicted.front());
    for (long k = first; k < last; ++k) add(k, c.predicted[static_cast<std::size_t>(k - late)]);
    for (long k = last; k < rows; ++k) add(k, c.predicted.back());
  }
}

}  // namespace

Shift BestShift(const std::vector<MatchedColumn>& columns, long most) {
  Shift best;
  if (columns.empty() || columns[0].size() == 0) return best;
  const std::size_t rows = columns[0].size();
  double n = 0;
  for (const MatchedColumn& c : columns)
    n += static_cast<double>(std::count(c.ok.begin(), c.ok.end(), 1));
  if (n == 0) return best;
  std::vector<double> plain(rows), shifted(rows);
  SquaredErrors(columns, 0, plain);
  double total = 0;
  for (const double e : plain) total += e;
  double least = total;
  for (long late = -most; late <= most; ++late) {
    if (late == 0) continue;
    SquaredErrors(columns, late, shifted);
    // plain up to the instant, shifted from there on
    double sum = 0;
    for (const double e : shifted) sum += e;
    for (std::size_t from = 0; from < rows; ++from) {
      if (sum < least) {
        least = sum;
        best.late = late;
        best.from = from;
      }
      sum += plain[from] - shifted[from];
    }
  }
  // rows whose prediction lies outside the record were not predicted: they choose, but say nothing
  const bool late_at_once = best.late > 0 && static_cast<long>(best.from) <= best.late + 3;
  const auto inside = [&](std::size_t row) {
    const long from = static_cast<long>(row) - best.late;
    return (row < best.from && !late_at_once) || (from >= 0 && from < static_cast<long>(rows));
  };
  SquaredErrors(columns, best.late, shifted);
  double before = 0, after = 0, at_once = 0, rows_inside = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    if (!inside(row)) continue;
    before += plain[row];
    after += row < best.from ? plain[row] : shifted[row];
    at_once += shifted[row];
    rows_inside += 1;
  }
  const double share = rows_inside > 0 ? n * rows_inside / static_cast<double>(rows) : n;
  best.before = std::sqrt(before / share);
  best.after = std::sqrt(after / share);
  best.at_once = std::sqrt(at_once / share);
  return best;
}

}  // namespace ambrig
