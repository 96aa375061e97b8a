#include "discovery/model/multisine_response.h"

#include <algorithm>
#include <cmath>

#include "analysis/linear/operating_point.h"
#include "core/base/index.h"
#include "core/math/constants.h"
#include "core/math/linear_equations.h"
#include "core/record/channels.h"
#include "rig/clearance.h"
#include "rig/rig_assembly.h"
#include "simulation/switching/lost_rotor.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;
using Spectrum = std::vector<Complex>;

constexpr double kSettleTime = 0.1;                       // [s] before the window
constexpr double kShortWarmUp = 0.05;                     // [s] where the start cancels
constexpr double kShortWindow = 0.25, kLongWindow = 0.5;  // [s]
constexpr std::size_t kMostLines = 64;
constexpr double kPartOfClearance = 0.01, kPartOfBias = 0.02;  // rms of the whole test

/// Row of the least-squares inverse of a bearing's current map: set-points -> force command [N/A].
Eigen::RowVectorXd CommandRow(const BearingControl& control, std::size_t axes, Eigen::Index side) {
  const Eigen::MatrixXd W =
      control.map.W.topLeftCorner(control.coils, static_cast<Eigen::Index>(axes) + 1);
  return control.map.k * control.map.c0 *
         SolveSymmetricColumns(W.transpose() * W, W.transpose()).row(1 + side);
}

/// What is added to a reading passes the controller, which no effect changes, and is a force from
/// there on; a load on the rotor is taken for one behind the controller.
bool OfForce(const ResponsePoint& port) {
  return port.kind == PointKind::kSensorPort || port.kind == PointKind::kLoadPort;
}

Spectrum Less(Spectrum a, const Spectrum& b) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] -= b[k];
  return a;
}

}  // namespace

MultisineMeasurement::MultisineMeasurement(const RigParameters& drawing, const CaseRecord& record,
                                           const ResponsePoint& port, const LinearResponses& base)
    : drawing_(drawing), record_(record), port_(port) {
  ChooseLines();
  const OperatingPoint& point = base.point();
  for (std::size_t k = 0; k < point.control().size(); ++k) {
    commands_.emplace_back();
    for (std::size_t side = 0; side < point.AxisCount(k); ++side)
      commands_.back().push_back(
          CommandRow(point.control()[k], point.AxisCount(k), static_cast<Eigen::Index>(side)));
  }
  const double rate = drawing.controller.rate;
  scenario_ = record.scenario;
  scenario_.noise = scenario_.fault_tolerant = false;
  scenario_.faults.clear();
  scenario_.switches.clear();
  scenario_.loads.clear();
  scenario_.excitations.clear();
  if (scenario_.start == StartState::kClamped)
    scenario_.excitations = StandingExcitations(record.scenario);
  scenario_.speed =
      SpeedProfile(std::vector<std::vector<double>>{{0.0, record.scenario.speed.Speed(0)}});
  scenario_.speed_free_from = kInfinity;
  scenario_.record_rate = rate;
  scenario_.duration = static_cast<double>(settle_ + window_ + 1) / rate;
  Excitation e;
  const std::size_t dot = port_.name.rfind('.');
  e.target = port_.name.substr(0, dot);
  e.port = OfForce(port_) ? "force" : port_.name.substr(dot + 1);
  e.kind = "multisine";
  e.stop = scenario_.duration + 1;
  e.frequencies = lines_;
  const auto n = static_cast<double>(lines_.size());
  for (std::size_t k = 0; k < lines_.size(); ++k)  // Schroeder: no crest
    e.phases.push_back(-kPi * static_cast<double>(k * k) / n);
  e.amplitude = AmplitudeFor(base);
  for (std::size_t k = 0; k < settle_ + window_; ++k)
    excited_.push_back(e.Value(static_cast<double>(k) / rate + 1e-10));
  opposite_ = scenario_;
  scenario_.excitations.push_back(e);
  plan_ = std::make_unique<CommandPlan>(drawing, scenario_);
  if (scenario_.speed.Speed(0) != 0) {
    opposite_.excitations.push_back(e);
    opposite_.excitations.back().amplitude *= -1;
    opposite_plan_ = std::make_unique<CommandPlan>(drawing, opposite_);
  }
}

/// The record's frequencies on the grid of the window, at most kMostLines of them.
void MultisineMeasurement::ChooseLines() {
  const double rate = drawing_.controller.rate;
  const std::vector<double>& f = record_.responses.frequency;
  double least = kInfinity;
  for (const double at : f)
    if (at > 0) least = std::min(least, at);
  window_ = AsSize(std::lround(rate * std::clamp(1 / least, kShortWindow, kLongWindow)));
  settle_ = AsSize(std::lround(rate * kSettleTime));
  std::vector<double> all;
  const double step = rate / static_cast<double>(window_);
  for (const double at : f) {
    const double line = step * std::max(1.0, std::round(at / step));
    if (line < 0.49 * rate) all.push_back(line);
  }
  std::ranges::sort(all);
  const auto same = [step](double a, double b) { return std::abs(a - b) < 0.5 * step; };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  const std::size_t count = std::min(all.size(), kMostLines);
  for (std::size_t k = 0; k < count; ++k)
    lines_.push_back(all[count < 2 ? 0 : k * (all.size() - 1) / (count - 1)]);
}

/// Small against clearance and bias, so that what is measured is a slope [unit of the port].
double MultisineMeasurement::AmplitudeFor(const LinearResponses& base) const {
  const OperatingPoint& point = base.point();
  const auto lines = static_cast<double>(lines_.size());
  if (port_.of_coil()) {
    const CoilPoint& coil = point.coils[port_.bearing][AsSize(port_.index)];
    const double about = port_.kind == PointKind::kDutyPort ? coil.duty : coil.current;
    return kPartOfBias * std::abs(about) / std::sqrt(0.5 * lines);
  }
  RigResponse reading, command;
  ResponsePoint drive = port_;
  if (OfForce(port_)) {
    drive.kind = PointKind::kForcePort;
    drive.name = port_.axis + ".force";
  }
  reading.excited = reading.input = command.excited = command.input = drive;
  reading.output = {PointKind::kReading, port_.axis, port_.axis, port_.bearing, port_.index};
  command.output = reading.output;
  command.output.kind = PointKind::kCommand;
  command.output.name = port_.axis + ".command";
  double x = 0, f = 0;
  for (const double at : lines_) {
    const std::vector<Complex> H = base.At(at, {reading, command});
    x += 0.5 * std::norm(H[0]);
    f += 0.5 * std::norm(H[1]);
  }
  const CurrentMap& map = point.control()[port_.bearing].map;
  return std::min(kPartOfClearance * ClearanceOf(drawing_.bearings[port_.bearing]) / std::sqrt(x),
                  kPartOfBias * map.k * map.c0 * map.c0 / std::sqrt(f));
}

Spectrum MultisineMeasurement::Lines(const std::vector<double>& samples) const {
  // all lines side by side: real and imaginary parts of each
  using Parts = Eigen::ArrayXd;
  const auto n = static_cast<Eigen::Index>(lines_.size());
  const Parts angle =
      -2 * kPi / drawing_.controller.rate * Eigen::Map<const Parts>(lines_.data(), n);
  const Parts turn_re = angle.cos(), turn_im = angle.sin();
  Parts re = Parts::Ones(n), im = Parts::Zero(n), sum_re = Parts::Zero(n), sum_im = Parts::Zero(n);
  Parts next(n);
  for (std::size_t k = 0; k < window_; ++k) {
    sum_re += samples[settle_ + k] * re;
    sum_im += samples[settle_ + k] * im;
    next = re * turn_re - im * turn_im;
    im = re * turn_im + im * turn_re;
    re = next;
  }
  Spectrum out;
  for (Eigen::Index j = 0; j < n; ++j) out.emplace_back(sum_re(j), sum_im(j));
  return out;
}

Spectrum MultisineMeasurement::SpectrumOf(const Record& run, const ResponsePoint& p,
                                          double sign) const {
  std::vector<double> y(settle_ + window_, 0.0);
  const auto add = [&](const std::string& channel, double factor) {
    const Channel* c = run.Find(channel);
    Require(c && c->samples.size() >= y.size(), "channels of a run");
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += factor * c->samples[k];
  };
  const std::string& bearing = drawing_.bearings[p.bearing].name;
  const auto port = [&](double factor) {
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += sign * factor * excited_[k];
  };
  // the reading that holds what was added to it changes as the command behind an injected force
  // does: both are the sensitivity of this loop
  const bool own = port_.kind == PointKind::kSensorPort && p.axis == port_.axis &&
                   (p.kind == PointKind::kReading || p.kind == PointKind::kError);
  switch (own ? PointKind::kCommand : p.kind) {
    case PointKind::kReading:
    case PointKind::kError:
      add(p.axis, p.kind == PointKind::kError ? -1 : 1);
      if (p.kind == PointKind::kError && port_.kind == PointKind::kReferencePort &&
          p.axis == port_.axis)
        port(1);
      break;
    case PointKind::kCommand: {
      const Eigen::RowVectorXd& row = commands_[p.bearing][AsSize(p.index)];
      for (Eigen::Index j = 0; j < row.size(); ++j)
        add(ChannelId{ChannelKind::kSetPoint, bearing, static_cast<int>(j)}.name(), row(j));
      break;
    }
    case PointKind::kCurrent:
      add(ChannelId{ChannelKind::kCoilCurrent, bearing, p.index}.name(), 1);
      break;
    case PointKind::kSetPoint:
      add(ChannelId{ChannelKind::kSetPoint, bearing, p.index}.name(), 1);
      break;
    case PointKind::kShaft:
    case PointKind::kStation: {
      const std::size_t dot = p.axis.rfind('.');
      add(dot == std::string::npos ? "r." + p.axis
                                   : p.axis.substr(0, dot) + ".r" + p.axis.substr(dot),
          1);
      break;
    }
    default:
      port(1);
  }
  return Lines(y);
}

std::optional<MultisineMeasurement::Spectra> MultisineMeasurement::Run(
    const RigParameters& rig) const {
  RigParameters known = drawing_;
  known.amplifier.adc_samples_per_period = rig.amplifier.adc_samples_per_period;
  const NominalRig nominal(known);
  const auto run = [&](const Scenario& s, const CommandPlan& plan) {
    EngineOptions options;
    options.coil_spread = false;
    options.commands = &plan;
    options.record_rate = RecordRateFor(rig, s.record_rate);
    options.watch = false;
    options.nominal = &nominal;
    if (s.start == StartState::kLevitated) {
      options.lost_after = 0.01;
      // what moves by itself is in both runs of a turning shaft
      if (opposite_plan_) options.warm_up = kShortWarmUp;
    }
    return SwitchingEngine(rig, s, options).Run().record;
  };
  Record forth, back;
  try {
    forth = run(scenario_, *plan_);
    if (opposite_plan_) back = run(opposite_, *opposite_plan_);
  } catch (const LostRotor&) {
    return std::nullopt;
  }
  const auto spectrum = [&](const ResponsePoint& p) {
    const Spectrum with = SpectrumOf(forth, p, 1);
    // the difference: what turns with the shaft is in both
    return opposite_plan_ ? Less(with, SpectrumOf(back, p, -1)) : with;
  };
  Spectra out;
  for (const RigResponse& r : record_.responses.responses) {
    out.emplace_back();
    if (r.excited.name != port_.name) continue;
    const Spectrum of = spectrum(r.output), over = spectrum(r.input);
    for (std::size_t k = 0; k < of.size(); ++k) out.back().push_back(of[k] / over[k]);
  }
  return out;
}

}  // namespace ambrig
