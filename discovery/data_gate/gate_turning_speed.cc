// The speed that a rotor turned with where its scenario prescribes a constant one and no speed was
// logged: the line of its readings that follows the speed elsewhere stands at another frequency.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/math/constants.h"
#include "core/record/channels.h"
#include "discovery/data_gate/gate_checks.h"
#include "discovery/model/record_traits.h"
#include "discovery/search/spectral_lines.h"

namespace ambrig {

namespace {

constexpr double kPlainLine = 3;        // floors, rms over the readings
constexpr double kLineLeaves = 0.7;     // of the error (rms) that a line leaves which dominates
constexpr double kOfStatedSpeed = 0.5;  // of what a line at the stated speed leaves
constexpr double kFaint = 0.3;          // of a line: less of it is no evidence that it is there
constexpr double kLowestLine = 0.3;     // of the stated speed

/// The readings of a free rotor in one record: what the model leaves of them, its own synchronous
/// line added again where they do not have it.
class ReadingError {
 public:
  ReadingError(const CaseModel& model, const std::vector<double>& predicted, std::size_t record)
      : record_(model.data().records[record]) {
    if (!OverTime(record_)) return;
    for (std::size_t n = 0; n < model.targets().size(); ++n) {
      const Target& t = model.targets()[n];
      if (t.record == record &&
          IsOfKind(record_.data.channels[t.channel].name, ChannelKind::kReading))
        targets_.push_back(n);
    }
    if (targets_.empty()) return;
    const auto rows = static_cast<Eigen::Index>(model.targets()[targets_[0]].count);
    error_ = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(targets_.size()));
    Eigen::MatrixXd own = error_;
    for (Eigen::Index c = 0; c < error_.cols(); ++c) {
      const Target& t = model.targets()[targets_[static_cast<std::size_t>(c)]];
      for (Eigen::Index k = 0; k < rows; ++k) {
        const std::size_t row = t.first + static_cast<std::size_t>(k);
        own(k, c) = predicted[row] / t.floor;
        if (model.ok()[row]) error_(k, c) = (model.measured()[row] - predicted[row]) / t.floor;
      }
    }
    error_.rowwise() -= error_.colwise().mean().eval();
    own.rowwise() -= own.colwise().mean().eval();
    const double speed = StatedSpeed().value_or(0);
    if (speed == 0) return;
    const Eigen::MatrixXd line = LineIn(own, speed);
    if (Rms(error_ + line) > Rms(error_)) return;
    known_ = Rms(line);
    error_ += line;
  }

  bool any() const { return !targets_.empty() && error_.rows() > 0; }
  const std::vector<std::size_t>& targets() const { return targets_; }
  double known() const { return known_; }  // rms of the model's own line [floors]
  double total() const { return Rms(error_); }
  double Line(double w) const { return Rms(LineIn(error_, w)); }
  /// Share of the error (rms) that a line of w [rad/s] leaves.
  double LeftBy(double w) const { return Rms(error_ - LineIn(error_, w)) / total(); }
  /// rms of the line at `w` [floors] beside one at `beside`.
  double LineBeside(double w, double beside) const {
    return Rms(LineIn(error_ - LineIn(error_, beside), w));
  }
  double duration() const { return static_cast<double>(error_.rows()) / record_.data.rate; }

  /// The constant speed that the scenario prescribes [rad/s].
  std::optional<double> StatedSpeed() const {
    const Scenario& s = record_.scenario;
    const double speed = s.speed.Speed(0), angle = speed * s.duration;
    const bool constant = s.speed_free_from >= s.duration &&
                          s.speed.LargestSpeed(s.duration) == std::abs(speed) &&
                          std::abs(s.speed.Angle(s.duration) - angle) < 1e-6;
    return constant ? std::optional(std::abs(speed)) : std::nullopt;
  }

  /// The errors in the rows of their targets; 0 elsewhere.
  std::vector<double> InRowsOf(const CaseModel& model) const {
    std::vector<double> out(model.size(), 0.0);
    for (Eigen::Index c = 0; c < error_.cols(); ++c)
      for (Eigen::Index k = 0; k < error_.rows(); ++k)
        out[model.targets()[targets_[static_cast<std::size_t>(c)]].first +
            static_cast<std::size_t>(k)] = error_(k, c);
    return out;
  }

 private:
  static double Rms(const Eigen::MatrixXd& m) {
    return m.size() > 0 ? m.norm() / std::sqrt(static_cast<double>(m.size())) : 0;
  }
  Eigen::MatrixXd LineIn(const Eigen::MatrixXd& of, double w) const {
    Eigen::MatrixXd basis(of.rows(), 2);
    for (Eigen::Index k = 0; k < of.rows(); ++k) {
      const double angle = w * static_cast<double>(k) / record_.data.rate;
      basis(k, 0) = std::cos(angle);
      basis(k, 1) = std::sin(angle);
    }
    const Eigen::Matrix2d square = basis.transpose() * basis;
    return basis * square.ldlt().solve(basis.transpose() * of);
  }

  const CaseRecord& record_;
  std::vector<std::size_t> targets_;
  Eigen::MatrixXd error_;  // rows x readings [floors]
  double known_ = 0;
};

/// The speed [rad/s] of the strongest line, refined to where it leaves least.
std::optional<double> StrongestSpeed(const CaseModel& model, const ReadingError& e, double stated) {
  const std::vector<double> lines =
      StrongestLines(model, e.InRowsOf(model), e.targets(), {kLowestLine * stated / (2 * kPi), 1});
  if (lines.empty()) return std::nullopt;
  double best = 2 * kPi * lines[0], least = e.LeftBy(best);
  for (double step = kPi / (2 * e.duration()); step > 1e-3 * kPi / e.duration(); step /= 2)
    for (const double w : {best - step, best + step})
      if (const double left = e.LeftBy(w); left < least) least = left, best = w;
  return best;
}

/// Whether another record shows that lines of this rig turn with its speed, and none of them has
/// the line at `w`, `size` floors there.
bool OthersConfirm(const std::vector<ReadingError>& all, std::size_t record, double w,
                   double size) {
  bool turns = all[record].known() > kFaint * size;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (k == record || !all[k].any()) continue;
    const double speed = all[k].StatedSpeed().value_or(0);
    const bool own = speed > 0 && std::abs(speed - w) < 2 * kPi / all[k].duration();
    if (!own && all[k].Line(w) > kFaint * size) return false;
    turns = turns ||
            (speed > 0 && all[k].Line(speed) > kPlainLine && all[k].LeftBy(speed) < kLineLeaves);
  }
  return turns;
}

bool MayHaveTurnedOtherwise(const CaseRecord& r, const ReadingError& e) {
  return e.any() && e.StatedSpeed().value_or(0) > 0 && r.imposed == Imposed::kNothing &&
         r.scenario.faults.empty() && !Find(r.data, {ChannelKind::kSpeed});
}

}  // namespace

void CheckTurningSpeeds(const CaseModel& model, const std::vector<double>& predicted,
                        std::vector<DataFault>& out) {
  std::vector<ReadingError> errors;
  for (std::size_t r = 0; r < model.data().records.size(); ++r)
    errors.emplace_back(model, predicted, r);
  for (std::size_t r = 0; r < errors.size(); ++r) {
    const CaseRecord& record = model.data().records[r];
    const ReadingError& e = errors[r];
    if (!MayHaveTurnedOtherwise(record, e)) continue;
    const double stated = *e.StatedSpeed();
    const std::optional<double> w = StrongestSpeed(model, e, stated);
    if (!w) continue;
    const double size = e.Line(*w), left = e.LeftBy(*w), as_stated = e.LeftBy(stated);
    if (size < kPlainLine || left > kLineLeaves || left > kOfStatedSpeed * as_stated) continue;
    if (e.LineBeside(stated, *w) > kFaint * size || !OthersConfirm(errors, r, *w, size)) continue;
    DataFault f = FaultLeaving(record, "", "scenario", left / as_stated);
    f.detail =
        fmt::format("its rotor turned with {:.5g} rad/s, the profile says {:.5g}", *w, stated);
    TellScenario(f, out);
  }
}

}  // namespace ambrig
