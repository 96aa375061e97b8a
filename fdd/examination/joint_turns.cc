#include "fdd/examination/joint_turns.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace ambrig {

namespace {

constexpr double kFewestTurns = 0.05, kMostTurns = 1.5;  // shares that a trial may reach
constexpr double kNoMore = 1.08;                         // of the turns believed: more is no short
constexpr double kProbe = 0.01;                          // step of the derivatives, of the turns
constexpr double kSettledTurns = 2e-3;                   // |c|
constexpr int kSteps = 12;
constexpr double kLeastWeight = 20;  // of a coil's sum of both phases, and of one phase that counts
constexpr double kExplainsBoth = 0.6;  // |c| that one winding of a thrust side may leave the other
constexpr double kContradicts = 0.3;   // |c| of one phase, when both together are 0

struct Excess {
  Lane top[2], bottom[2];
  double of(int j) const { return (top[0][j] + top[1][j]) / (bottom[0][j] + bottom[1][j]); }
};

/// What the trials have in common.
struct Trial {
  FluxFilter filter;
  const CoilEquations* coils;
  const ExcessSettings* settings;
  Lane judged;
  std::vector<const KeptPeriod*> periods;  // the first one holds the onset
  FluxFilter::State before;

  Excess At(const Lane& share) {
    Excess sum;
    filter.Resume(before);
    for (int j = 0; j < filter.nominal().coils; ++j) filter.SetTurns(j, share[j]);
    Lane judged_share = judged;
    for (int j = 0; j < kLanes; ++j) judged_share[j] *= share[j];
    FluxPeriod flux;
    SlopeExcess e;
    for (std::size_t k = 0; k < periods.size(); ++k) {
      filter.Period(periods[k]->in, &flux);
      if (k == 0) continue;
      ComputeSlopeExcess(filter, *coils, *settings, flux, judged_share, &e);
      for (int q = 0; q < 2; ++q)
        for (int j = 0; j < kLanes; ++j) {
          sum.top[q][j] += e.top[q][j];
          sum.bottom[q][j] += e.bottom[q][j];
        }
    }
    return sum;
  }
};

/// Whether what remains is that of turns that are bypassed.
bool Explains(const Excess& left, const std::vector<int>& unknown) {
  for (int j : unknown)
    for (int q = 0; q < 2; ++q)
      if (left.bottom[q][j] > kLeastWeight &&
          std::abs(left.top[q][j]) > kContradicts * left.bottom[q][j])
        return false;
  return true;
}

double Largest(const Excess& e, const std::vector<int>& unknown) {
  double most = 0;
  for (int j : unknown) most = std::max(most, std::abs(e.of(j)));
  return most;
}

/// How the excess of the unknown coils changes with their shares, at `share`, where it is `now`.
Eigen::MatrixXd SlopeOf(Trial& trial, const Lane& share, const Excess& now,
                        const std::vector<int>& unknown) {
  const auto n = static_cast<Eigen::Index>(unknown.size());
  Eigen::MatrixXd slope(n, n);
  for (Eigen::Index col = 0; col < n; ++col) {
    Lane moved = share;
    moved[unknown[static_cast<std::size_t>(col)]] += kProbe;
    const Excess there = trial.At(moved);
    for (Eigen::Index row = 0; row < n; ++row) {
      const int j = unknown[static_cast<std::size_t>(row)];
      slope(row, col) = (there.of(j) - now.of(j)) / kProbe;
    }
  }
  return slope;
}

/// Newton's step of the shares from `share`, where the excess is `now`.
Eigen::VectorXd Step(Trial& trial, const Lane& share, const Excess& now,
                     const std::vector<int>& unknown) {
  Eigen::VectorXd c(static_cast<Eigen::Index>(unknown.size()));
  for (std::size_t k = 0; k < unknown.size(); ++k)
    c[static_cast<Eigen::Index>(k)] = now.of(unknown[k]);
  return SlopeOf(trial, share, now, unknown).partialPivLu().solve(-c);
}

/// Newton's method from `share`, where the excess is `now`. false: it does not end.
bool Settle(Trial& trial, const std::vector<int>& unknown, Lane* share, Excess* now) {
  for (int step = 0; Largest(*now, unknown) > kSettledTurns; ++step) {
    if (step == kSteps) return false;
    const Eigen::VectorXd change = Step(trial, *share, *now, unknown);
    if (!change.allFinite()) return false;
    for (std::size_t k = 0; k < unknown.size(); ++k) {
      double& a = (*share)[unknown[k]];
      const double limited = std::clamp(change[static_cast<Eigen::Index>(k)], -0.3 * a, 0.5 * a);
      a = std::clamp(a + limited, kFewestTurns, kMostTurns);
    }
    *now = trial.At(*share);
  }
  return true;
}

/// Where one winding of a thrust side explains the c of both, the other one keeps its turns and
/// is no unknown.
void PreferOneWinding(Trial& trial, const Lane& believed, std::vector<int>* unknown, Lane* share) {
  const auto left_over = [&](int failed, Lane* tried) {
    *tried = *share;
    (*tried)[failed ^ 1] = believed[failed ^ 1];
    Excess now = trial.At(*tried);
    return Settle(trial, {failed}, tried, &now) ? std::abs(now.of(failed ^ 1)) : kInfinity;
  };
  for (int first = 0; first < trial.filter.nominal().coils; first += 2) {
    if (std::ranges::count(*unknown, first) + std::ranges::count(*unknown, first + 1) < 2) continue;
    Lane of_first, of_second;
    const double left_by_first = left_over(first, &of_first),
                 left_by_second = left_over(first + 1, &of_second);
    if (std::min(left_by_first, left_by_second) > kExplainsBoth) continue;
    const bool is_first = left_by_first < left_by_second;
    *share = is_first ? of_first : of_second;
    std::erase(*unknown, is_first ? first + 1 : first);
  }
}

}  // namespace

void JointTurns::Keep(const MeasuredPeriod& in, int samples, const FluxFilter::State& before) {
  const auto place = static_cast<std::size_t>(count_++ % kKept);
  period_[place].Keep(in, samples);
  period_[place].in.set_point = nullptr;
  before_[place] = before;
}

std::optional<JointShares> JointTurns::Solve(const FluxFilter& filter, const CoilEquations& coils,
                                             const ExcessSettings& settings, const Lane& believed,
                                             const Lane& dead) const {
  if (count_ < kKept) return {};
  Trial trial{filter, &coils, &settings, Lane{}, {}, {}};
  for (int k = 0; k < kKept; ++k) {
    const auto place = static_cast<std::size_t>((count_ + k) % kKept);
    if (k == 0) trial.before = before_[place];
    trial.periods.push_back(&period_[place]);
  }
  for (int j = 0; j < kLanes; ++j) trial.judged[j] = believed[j] > 0 && !(dead[j] > 0) ? 1 : 0;
  Lane share = believed;
  Excess now = trial.At(share);
  std::vector<int> unknown;
  for (int j = 0; j < filter.nominal().coils; ++j) {
    if (!(now.bottom[0][j] + now.bottom[1][j] > kLeastWeight)) continue;
    unknown.push_back(j);
    const double c = std::clamp(now.of(j), -0.5, 8.0);
    share[j] = believed[j] / std::sqrt(1 + c);
  }
  if (unknown.empty()) return {};
  if (filter.nominal().coupling == Coupling::kSides)
    PreferOneWinding(trial, believed, &unknown, &share);
  now = trial.At(share);
  if (!Settle(trial, unknown, &share, &now)) return {};
  for (int j : unknown)
    if (share[j] > kNoMore * believed[j]) return {};
  if (!Explains(now, unknown)) return {};
  JointShares found{share, Lane{}};
  const Eigen::MatrixXd inverse = SlopeOf(trial, share, now, unknown).inverse();
  for (std::size_t k = 0; k < unknown.size(); ++k)
    found.per_excess[unknown[k]] =
        inverse.row(static_cast<Eigen::Index>(k)).cwiseAbs().sum() / believed[unknown[k]];
  return found;
}

}  // namespace ambrig
