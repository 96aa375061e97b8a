#include "discovery/search/resonance_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/constants.h"
#include "core/math/linear_equations.h"

namespace ambrig {

namespace {

constexpr double kScanFrom = 30, kScanTo = 2000, kScanRatio = 1.02;  // [Hz], of the scan
constexpr std::array kScannedDamping = {0.01, 0.04};
constexpr double kApart = 1.12;  // minima nearer than this are one
constexpr double kLeastShare = 0.02;

/// Weighted equations of one sensor, real and imaginary parts below each other.
struct SensorEquations {
  Eigen::VectorXd error;       // what the forces' gains and lags leave
  Eigen::MatrixXd background;  // orthonormal columns of these
  double before = 0;           // squared sum of `error`
};

class ResonanceScan {
 public:
  explicit ResonanceScan(const std::vector<FreeResponse>& responses) : responses_(responses) {
    for (const FreeResponse& r : responses_) lines_ += static_cast<Eigen::Index>(r.w.size());
    for (std::size_t s = 0; s < 2; ++s) sensors_[s] = EquationsOf(s);
  }
  Eigen::Index lines() const { return lines_; }

  /// What is sharper than a line of the records cannot be told from one line of another origin.
  double LeastDamping(double frequency) const {
    double line = 0;
    for (const FreeResponse& r : responses_) line = std::max(line, r.line);
    return line / (2 * 2 * kPi * frequency);
  }

  /// Gains and share at this frequency, damping and gyroscopic coupling.
  void Solve(ResonanceEstimate& e) const {
    double before = 0, explained = 0;
    for (std::size_t s = 0; s < 2; ++s) {
      Eigen::MatrixXd a(2 * lines_, 2);
      const double w0 = 2 * kPi * e.frequency;
      for (Eigen::Index b = 0; b < 2; ++b)
        a.col(b) = Column(s, [&](const FreeResponse& r, std::size_t k) {
          const double w = r.w[k];
          const std::complex<double> stiffness(w0 * w0 - w * w + r.direction * e.gyro * r.speed * w,
                                               2 * e.damping * w0 * w);
          return r.force[static_cast<std::size_t>(b)][k] / stiffness;
        });
      const SensorEquations& q = sensors_[s];
      a -= q.background * (q.background.transpose() * a);
      const Eigen::Vector2d right = a.transpose() * q.error;
      const Eigen::Vector2d c = SolveSymmetric(a.transpose() * a, right);
      e.gains.row(static_cast<Eigen::Index>(s)) = c.transpose();
      before += q.before;
      explained += c.dot(right);
    }
    e.share = before > 0 && std::isfinite(explained) ? explained / before : 0;
  }

 private:
  /// Weighted column of sensor s, whose line k of a response is value(response, k).
  template <typename Value>
  Eigen::VectorXd Column(std::size_t s, const Value& value) const {
    Eigen::VectorXd out(2 * lines_);
    Eigen::Index row = 0;
    for (const FreeResponse& r : responses_)
      for (std::size_t k = 0; k < r.w.size(); ++k, ++row) {
        const std::complex<double> v = value(r, k) / r.scale[s][k];
        out[row] = v.real();
        out[lines_ + row] = v.imag();
      }
    return out;
  }

  SensorEquations EquationsOf(std::size_t s) const {
    SensorEquations q;
    Eigen::MatrixXd own(2 * lines_, 4);
    for (std::size_t b = 0; b < 2; ++b) {
      const auto i = static_cast<Eigen::Index>(2 * b);
      own.col(i) = Column(s, [&](const FreeResponse& r, std::size_t k) {
        return r.force[b][k] / (r.w[k] * r.w[k]);
      });
      own.col(i + 1) = Column(s, [&](const FreeResponse& r, std::size_t k) {
        return std::complex<double>(0, 1) * r.force[b][k] / r.w[k];
      });
    }
    own.colwise().normalize();
    q.background = OrthonormalColumnsOf(own);
    q.error = Column(s, [&](const FreeResponse& r, std::size_t k) { return r.missing[s][k]; });
    q.error -= q.background * (q.background.transpose() * q.error);
    q.before = q.error.squaredNorm();
    return q;
  }

  const std::vector<FreeResponse>& responses_;
  Eigen::Index lines_ = 0;
  std::array<SensorEquations, 2> sensors_;
};

bool HasLargerShare(const ResonanceEstimate& a, const ResonanceEstimate& b) {
  return a.share > b.share;
}

/// The `count` that explain most, best first, without those beside a better one.
std::vector<ResonanceEstimate> Distinct(std::vector<ResonanceEstimate> all, std::size_t count) {
  std::stable_sort(all.begin(), all.end(), HasLargerShare);
  std::vector<ResonanceEstimate> out;
  for (const ResonanceEstimate& e : all) {
    if (out.size() >= count || e.share < kLeastShare) break;
    if (std::none_of(out.begin(), out.end(), [&](const ResonanceEstimate& o) {
          return std::abs(std::log(o.frequency / e.frequency)) < std::log(kApart);
        }))
      out.push_back(e);
  }
  return out;
}

/// To the best of the neighbours in frequency, damping and gyroscopic coupling, in steps that halve.
ResonanceEstimate RefinedEstimate(const ResonanceScan& scan, ResonanceEstimate best) {
  constexpr int kHalvings = 4, kMoves = 6;
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
    for (const double damping : kScannedDamping) {
      scanned.push_back({f, std::max(damping, scan.LeastDamping(f))});
      scan.Solve(scanned.back());
    }
  out = Distinct(scanned, count);
  for (ResonanceEstimate& e : out) e = RefinedEstimate(scan, e);
  return Distinct(out, count);
}

SeenResonances LookForResonances(const CaseModel& model, const Hypothesis& h) {
  constexpr std::size_t kMost = 3;
  const std::vector<FreeResponse> responses = FreeResponses(model, h);
  return {!responses.empty(), EstimateResonances(responses, kMost)};
}

}  // namespace ambrig
