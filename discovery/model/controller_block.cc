#include "discovery/model/controller_block.h"

#include <cmath>

#include "actuators/magnetics/radial_stator.h"
#include "control/position/pid.h"
#include "core/record/channels.h"
#include "discovery/model/record_traits.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_assembly.h"

namespace ambrig {

namespace {

constexpr std::size_t kDerivativeSettles = 30;  // [rows]

struct Commands {
  double reference = 0;  // [m]
  double force = 0;      // [N]
};

Commands CommandsAt(const Scenario& scenario, const std::string& axis, double t) {
  Commands out;
  for (const Excitation& e : scenario.excitations)
    if (e.target == axis) (e.port == "reference" ? out.reference : out.force) += e.Value(t);
  return out;
}

/// Whether a set-point of the bearing is at a limit, where the projection is not the command.
bool AtLimit(const std::vector<const Channel*>& set_points, std::size_t row, double i_max) {
  constexpr double kOfRange = 1e-6;
  for (const Channel* s : set_points) {
    const double v = std::abs(s->samples[row]);
    if (v <= kOfRange * i_max || v >= (1 - kOfRange) * i_max) return true;
  }
  return false;
}

/// PID of one axis, with the states that the record does not hold.
class AxisReplay {
 public:
  AxisReplay(const PidParameters& pid, double Ts)
      : pid_(pid), Ts_(Ts), filter_(PidFilter(pid, Ts)), f_max_(pid.f_max) {
    pid_.f_max = kInfinity;  // rows at the limit do not count; without it the error is linear
  }

  /// Measured less computed command [N] of a row.
  double Error(double y, const Commands& c, double measured_force) {
    return measured_force - PidStep(pid_, Ts_, filter_, y, c.reference, c.force, state_);
  }
  void StartAt(double error) { state_.integral += error; }
  /// Whether a command [N] is at the limit, where the integral stops: the states are unknown behind
  /// it.
  bool AtLimit(double force) const { return std::abs(force) >= (1 - 1e-6) * f_max_; }
  /// Change of the reference that makes this error [m]; its own integral runs along.
  double Reference(double error) {
    const double r = (error - reference_integral_) / pid_.kp;
    reference_integral_ += pid_.ki * Ts_ * r;
    return r;
  }

 private:
  PidParameters pid_;
  double Ts_, filter_, f_max_;
  PidState state_;
  double reference_integral_ = 0;  // [N]
};

struct AxisColumns {
  const Channel* reading;
  std::vector<const Channel*> set_points;
  CoilVector direction;
  double force_per_ampere;  // of the control current [N/A]
};

ControllerAxis ReplayAxis(const AxisColumns& columns, const PidParameters& pid,
                          const RigParameters& nominal, const Scenario& scenario,
                          const BridgedRecord& data, const std::string& axis, double late) {
  const Record& d = data.record;
  ControllerAxis out;
  out.axis = axis;
  AxisReplay replay(pid, 1 / nominal.controller.rate);
  std::size_t since = 0;  // rows since the start, or since a gap: its integral is unknown
  for (std::size_t k = 0; k + 1 < d.rows(); ++k) {
    double v = 0;
    for (std::size_t j = 0; j < columns.set_points.size(); ++j)
      v += columns.direction[static_cast<Eigen::Index>(j)] * columns.set_points[j]->samples[k + 1] /
           4;
    const Commands c = CommandsAt(scenario, axis, d.TimeAt(k) + 1e-10 - late / d.rate);
    const double kc = columns.force_per_ampere;
    double error = replay.Error(columns.reading->samples[k], c, kc * v);
    const bool sound = data.Sound(k + 1) && !replay.AtLimit(kc * v) &&
                       !AtLimit(columns.set_points, k + 1, nominal.amplifier.i_max);
    if (since == kDerivativeSettles) {
      replay.StartAt(error);
      error = 0;
    }
    const bool counts = since > kDerivativeSettles && sound;
    out.measured.push_back(v);
    out.error.push_back(error / kc);
    out.counts.push_back(counts ? 1 : 0);
    out.reference.push_back(counts ? replay.Reference(error) : 0);
    since = sound ? since + 1 : 0;
  }
  return out;
}

double MeanOf(const std::vector<double>& values, const std::vector<char>& counts) {
  double sum = 0, n = 0;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (counts[k] && std::isfinite(values[k])) sum += values[k], n += 1;
  return sum / std::max(1.0, n);
}

double RmsAbout(double mean, const std::vector<double>& values, const std::vector<char>& counts) {
  double sum = 0, n = 0;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (counts[k] && std::isfinite(values[k])) sum += std::pow(values[k] - mean, 2), n += 1;
  return n > 0 ? std::sqrt(sum / n) : 0;
}

}  // namespace

bool HasControllerBlock(const RigParameters& nominal, const Scenario& scenario,
                        const Record& data) {
  // only the PID's start can be told from data
  return nominal.controller.IsPlainPid() && scenario.switches.empty() &&
         scenario.start != StartState::kClamped &&
         std::abs(data.rate - nominal.controller.rate) <= 1e-6 * data.rate;
}

std::vector<ControllerAxis> ControllerAxes(const RigParameters& nominal, const Scenario& scenario,
                                           const BridgedRecord& data, double late) {
  std::vector<ControllerAxis> out;
  if (!HasControllerBlock(nominal, scenario, data.record)) return out;
  for (const BearingParameters& b : nominal.bearings) {
    if (!b.kind->eight_poles) continue;
    const auto y = ChannelsIn(data.record, b, ChannelKind::kReading),
               s = ChannelsIn(data.record, b, ChannelKind::kSetPoint);
    if (y.empty() || s.empty()) continue;
    const RadialStator stator(b.radial);
    for (std::size_t side = 0; side < 2; ++side) {
      const AxisColumns columns{y[side], s, side == 0 ? stator.cosine() : stator.sine(),
                                ForceConstant(b) * BiasCurrent(nominal, b)};
      ControllerAxis axis =
          ReplayAxis(columns, PidOf(nominal, b), nominal, scenario, data, b.Axes()[side], late);
      const double mean = MeanOf(axis.error, axis.counts);
      for (double& e : axis.error) e -= mean;
      axis.rms = RmsAbout(0, axis.error, axis.counts);
      axis.movement = RmsAbout(MeanOf(axis.measured, axis.counts), axis.measured, axis.counts);
      out.push_back(std::move(axis));
    }
  }
  return out;
}

}  // namespace ambrig
