#include "discovery/search/resonance_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/constants.h"
#include "core/math/linear_equations.h"
#include "discovery/model/in_parallel.h"

namespace ambrig {

namespace {

constexpr double kScanFrom = 30, kScanTo = 2000, kScanRatio = 1.02;  // [Hz], of the scan
constexpr std::array kScannedDamping = {0.01, 0.04};
constexpr std::array kGyros = {0.0, -0.2, 0.2};  // from which an estimate is refined
constexpr double kLeastShare = 0.02;
// Of what a resonance explains, by the forces: the ends of the records explain any line of another
// origin.
constexpr double kLeastForced = 0.05;
// What is sharper than this part of a line is told from a line of another origin by its ends only.
constexpr double kSharpest = 0.1;

// Columns of the equations of one sensor in one record and direction, real above imaginary parts:
// those that no mode changes (the error, gains and lags of both forces, ends of a free mass), and
// those of a mode (answers to both forces, ends).
constexpr Eigen::Index kForceColumns = 4, kEndColumns = 4, kAnswerColumns = 2;

/// The products `all` of columns, less what the last `count` columns explain of the others, which
/// alone stay. These may depend on each other.
Eigen::MatrixXd WithoutLast(const Eigen::MatrixXd& all, Eigen::Index count) {
  const Eigen::Index kept = all.rows() - count;
  const Eigen::VectorXd one_over =
      all.diagonal().tail(count).cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd last = one_over.asDiagonal() * all.bottomRightCorner(count, count) *
                               one_over.asDiagonal(),
                        both = all.topRightCorner(kept, count) * one_over.asDiagonal();
  return all.topLeftCorner(kept, kept) - both * PseudoinverseOf(last) * both.transpose();
}

class ResonanceScan {
 public:
  explicit ResonanceScan(const std::vector<FreeResponse>& responses) : responses_(responses) {
    double all = 0;
    for (const FreeResponse& r : responses_) {
      lines_ += r.w.size();
      for (std::size_t s = 0; s < 2; ++s) {
        scale_[s].push_back(
            Eigen::Map<const Eigen::ArrayXd>(r.scale[s].data(), RowsOf(r) / 2).replicate(2, 1));
        fixed_[s].push_back(FixedColumns(r, s));
        fixed_[s].back().array().colwise() /= scale_[s].back();
        fixed_products_[s].push_back(fixed_[s].back().transpose() * fixed_[s].back());
        all += fixed_products_[s].back()(0, 0);
      }
    }
    for (const Eigen::MatrixXd& error : Products(nullptr)) before_ += error(0, 0);
    constexpr double kRounding = 1e-9;
    if (before_ < kRounding * all) before_ = 0;
  }
  std::size_t lines() const { return lines_; }

  double LeastDamping(double frequency) const {
    double line = 0;
    for (const FreeResponse& r : responses_) line = std::max(line, r.line);
    return kSharpest * line / (2 * 2 * kPi * frequency);
  }

  /// Gains and shares at this frequency, damping and gyroscopic coupling.
  void Solve(ResonanceEstimate& e) const {
    double explained = before_, forced = 0;
    const std::array<Eigen::MatrixXd, 2> products = Products(&e);
    for (std::size_t s = 0; s < 2; ++s) {
      const Eigen::Matrix3d p = products[s];  // answers, error
      const Eigen::Vector2d right = p.topRightCorner<2, 1>(),
                            c = SolveSymmetric(p.topLeftCorner<2, 2>(), right);
      e.gains.row(static_cast<Eigen::Index>(s)) = c.transpose();
      forced += c.dot(right);
      explained -= p(2, 2) - c.dot(right);
    }
    const bool any = before_ > 0 && std::isfinite(explained);
    e.share = any ? explained / before_ : 0;
    e.forced = any ? forced / before_ : 0;
  }

 private:
  using Complex = std::complex<double>;

  /// Real and imaginary parts of all lines.
  static Eigen::Index RowsOf(const FreeResponse& r) {
    return 2 * static_cast<Eigen::Index>(r.w.size());
  }

  /// Line k of a column.
  static void Set(Eigen::MatrixXd& m, Eigen::Index column, std::size_t k, Complex v) {
    const Eigen::Index row = static_cast<Eigen::Index>(k);
    m(row, column) = v.real();
    m(m.rows() / 2 + row, column) = v.imag();
  }
  /// Of a column and the next one, which is i times it: its constant is complex.
  static void SetBoth(Eigen::MatrixXd& m, Eigen::Index column, std::size_t k, Complex v) {
    Set(m, column, k, v);
    Set(m, column + 1, k, Complex(0, 1) * v);
  }

  static double Frequency(const FreeResponse& r, std::size_t k, std::size_t side) {
    return r.w[k] + (static_cast<double>(side) - 1) * r.line;
  }

  // The columns of the next two are not yet over the scale of their lines.

  static Eigen::MatrixXd FixedColumns(const FreeResponse& r, std::size_t s) {
    Eigen::MatrixXd m(RowsOf(r), 1 + kForceColumns + kEndColumns);
    FreeResponse::Neighbours gain, lag, end, drift;
    for (std::size_t k = 0; k < r.w.size(); ++k) {
      Set(m, 0, k, r.missing[s][k]);
      for (std::size_t b = 0; b < 2; ++b) {
        for (std::size_t side = 0; side < 3; ++side) {
          const double w = Frequency(r, k, side);
          gain[side] = r.force[b][k][side] / (w * w);
          lag[side] = Complex(0, 1) * r.force[b][k][side] / w;
        }
        Set(m, 1 + 2 * static_cast<Eigen::Index>(b), k, Windowed(gain));
        Set(m, 2 + 2 * static_cast<Eigen::Index>(b), k, Windowed(lag));
      }
      for (std::size_t side = 0; side < 3; ++side) {
        const double w = Frequency(r, k, side);
        end[side] = 1 / (w * w);
        drift[side] = 1 / w;
      }
      SetBoth(m, 1 + kForceColumns, k, Windowed(end));
      SetBoth(m, 3 + kForceColumns, k, Windowed(drift));
    }
    return m;
  }

  static Eigen::MatrixXd ColumnsOfMode(const FreeResponse& r, const ResonanceEstimate& e) {
    Eigen::MatrixXd m(RowsOf(r), kAnswerColumns + kEndColumns);
    const double w0 = 2 * kPi * e.frequency;
    FreeResponse::Neighbours end, drift;
    std::array<FreeResponse::Neighbours, 2> answer;
    for (std::size_t k = 0; k < r.w.size(); ++k) {
      for (std::size_t side = 0; side < 3; ++side) {
        const double w = Frequency(r, k, side);
        end[side] = 1.0 / Complex(w0 * w0 - w * w + r.direction * e.gyro * r.speed * w,
                                  2 * e.damping * w0 * w);
        drift[side] = (w - w0) * end[side];  // w times it is all but w0 times `end`
        for (std::size_t b = 0; b < 2; ++b) answer[b][side] = r.force[b][k][side] * end[side];
      }
      for (std::size_t b = 0; b < 2; ++b)
        Set(m, static_cast<Eigen::Index>(b), k, Windowed(answer[b]));
      SetBoth(m, kAnswerColumns, k, Windowed(end));
      SetBoth(m, kAnswerColumns + 2, k, Windowed(drift));
    }
    return m;
  }

  /// Of each sensor: sums over all records and directions of the products of a mode's answers (none
  /// with nullptr) and the error, less what the ends of each record and, in all alike, gains and
  /// lags of the forces explain.
  std::array<Eigen::MatrixXd, 2> Products(const ResonanceEstimate* mode) const {
    const Eigen::Index answers = mode ? kAnswerColumns : 0, kept = answers + 1 + kForceColumns,
                       ends = (mode ? 2 : 1) * kEndColumns;
    std::array<Eigen::MatrixXd, 2> sums;
    sums.fill(Eigen::MatrixXd::Zero(kept, kept));
    for (std::size_t n = 0; n < responses_.size(); ++n) {
      const Eigen::MatrixXd own =
          mode ? ColumnsOfMode(responses_[n], *mode) : Eigen::MatrixXd(RowsOf(responses_[n]), 0);
      const Eigen::Index own_ends = own.cols() - answers;
      for (std::size_t s = 0; s < 2; ++s) {
        const Eigen::MatrixXd& fixed = fixed_[s][n];
        const Eigen::MatrixXd scaled = own.array().colwise() / scale_[s][n],
                              squares = scaled.transpose() * scaled,
                              both = scaled.transpose() * fixed;
        // In the order: answers, what no mode changes, ends of the mode.
        Eigen::MatrixXd all(kept + ends, kept + ends);
        all.topLeftCorner(answers, answers) = squares.topLeftCorner(answers, answers);
        all.block(0, answers, answers, fixed.cols()) = both.topRows(answers);
        all.topRightCorner(answers, own_ends) = squares.topRightCorner(answers, own_ends);
        all.block(answers, answers, fixed.cols(), fixed.cols()) = fixed_products_[s][n];
        all.block(answers, answers + fixed.cols(), fixed.cols(), own_ends) =
            both.bottomRows(own_ends).transpose();
        all.bottomRightCorner(own_ends, own_ends) = squares.bottomRightCorner(own_ends, own_ends);
        sums[s] += WithoutLast(all.selfadjointView<Eigen::Upper>(), ends);
      }
    }
    for (Eigen::MatrixXd& sum : sums) sum = WithoutLast(sum, kForceColumns);
    return sums;
  }

  const std::vector<FreeResponse>& responses_;
  std::size_t lines_ = 0;
  // of each sensor, by response; scale_: of all rows
  std::array<std::vector<Eigen::MatrixXd>, 2> fixed_, fixed_products_;
  std::array<std::vector<Eigen::ArrayXd>, 2> scale_;
  double before_ = 0;  // squared error, 0: none beyond rounding
};

bool HasLargerShare(const ResonanceEstimate& a, const ResonanceEstimate& b) {
  return a.share > b.share;
}

/// Minima of the scan nearer than this are one.
bool OneOfTheScan(const ResonanceEstimate& a, const ResonanceEstimate& b) {
  return std::abs(std::log(a.frequency / b.frequency)) < std::log(1.12);
}

/// Refined minima are one where frequency and damping are alike. A base whose frequency differs
/// between x and y has a sharp minimum beside a broad one, and the broad one describes the machine
/// better; the simulation decides.
bool OneOfTheRefined(const ResonanceEstimate& a, const ResonanceEstimate& b) {
  return std::abs(std::log(a.frequency / b.frequency)) < std::log(1.02) &&
         std::abs(std::log(a.damping / b.damping)) < std::log(2.0);
}

/// The `count` that explain most, best first, without those that are one with a better one.
std::vector<ResonanceEstimate> Distinct(std::vector<ResonanceEstimate> all, std::size_t count,
                                        bool (*are_one)(const ResonanceEstimate&,
                                                        const ResonanceEstimate&)) {
  std::stable_sort(all.begin(), all.end(), HasLargerShare);
  std::vector<ResonanceEstimate> out;
  for (const ResonanceEstimate& e : all) {
    if (out.size() >= count || e.share < kLeastShare) break;
    if (e.forced < kLeastForced * e.share) continue;
    if (std::none_of(out.begin(), out.end(),
                     [&](const ResonanceEstimate& o) { return are_one(o, e); }))
      out.push_back(e);
  }
  return out;
}

/// To the best of the neighbours in frequency, damping and gyroscopic coupling, in steps that
/// halve.
ResonanceEstimate RefinedEstimate(const ResonanceScan& scan, ResonanceEstimate best) {
  constexpr int kHalvings = 6, kMoves = 6;
  double frequency = kScanRatio - 1, damping = 0.8, gyro = 0.1;
  for (int halving = 0; halving < kHalvings; ++halving) {
    for (int move = 0; move < kMoves; ++move) {
      ResonanceEstimate next = best;
      for (const double sign : {-1.0, 1.0})
        for (const int what : {0, 1, 2}) {
          ResonanceEstimate one = best;
          if (what == 0) one.frequency *= std::pow(1 + frequency, sign);
          if (what == 1)
            one.damping = std::clamp(one.damping * std::pow(1 + damping, sign),
                                     scan.LeastDamping(one.frequency), 0.3);
          if (what == 2) one.gyro += sign * gyro;
          scan.Solve(one);
          if (HasLargerShare(one, next)) next = one;
        }
      if (!HasLargerShare(next, best)) break;
      best = next;
    }
    frequency /= 2;
    damping /= 2;
    gyro /= 2;
  }
  return best;
}

}  // namespace

std::vector<ResonanceEstimate> EstimateResonances(const std::vector<FreeResponse>& responses,
                                                  std::size_t count) {
  std::vector<ResonanceEstimate> scanned, out;
  if (responses.empty()) return out;
  const ResonanceScan scan(responses);
  if (scan.lines() < 20) return out;
  for (double f = kScanFrom; f < kScanTo; f *= kScanRatio)
    for (const double damping : kScannedDamping)
      scanned.push_back({f, std::max(damping, scan.LeastDamping(f))});
  InParallel(scanned.size(), [&](std::size_t k) { scan.Solve(scanned[k]); });
  out = Distinct(scanned, count, OneOfTheScan);
  std::vector<ResonanceEstimate> refined;
  for (const ResonanceEstimate& e : out)
    for (const double gyro : kGyros) {
      refined.push_back(e);
      refined.back().gyro = gyro;
    }
  InParallel(refined.size(), [&](std::size_t k) {
    scan.Solve(refined[k]);
    refined[k] = RefinedEstimate(scan, refined[k]);
  });
  return Distinct(refined, count, OneOfTheRefined);
}

SeenResonances LookForResonances(const CaseModel& model, const Hypothesis& h) {
  constexpr std::size_t kMost = 3;
  const std::vector<FreeResponse> responses = FreeResponses(model, h);
  return {!responses.empty(), EstimateResonances(responses, kMost)};
}

}  // namespace ambrig
