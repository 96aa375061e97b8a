#include "discovery/model/linear_responses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/closed_loop_modes.h"
#include "analysis/linear/bridge_point.h"
#include "analysis/transfer_function.h"
#include "core/base/index.h"
#include "core/math/constants.h"
#include "core/math/linear_equations.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

/// Constant set-points and duties of a held rotor's coils.
struct HeldCommands {
  std::vector<Lane> current, duty;
  std::vector<std::array<bool, kLanes>> by_duty;
};

HeldCommands CommandsAtStart(const RigParameters& rig, const Scenario& s) {
  HeldCommands out;
  out.current.resize(rig.bearings.size());
  out.duty.resize(rig.bearings.size());
  out.by_duty.resize(rig.bearings.size());
  for (const Excitation& e : StandingExcitations(s)) {
    const auto p = ParseResponsePoint(rig, e.target + "." + e.port);
    if (!p || !p->of_coil()) continue;
    const bool duty = p->kind == PointKind::kDutyPort;
    (duty ? out.duty : out.current)[p->bearing][p->index] += e.Value(1e-9);
    if (duty) out.by_duty[p->bearing][AsSize(p->index)] = true;
  }
  return out;
}

}  // namespace

std::vector<Excitation> StandingExcitations(const Scenario& scenario) {
  std::vector<Excitation> out;
  for (const Excitation& e : scenario.excitations)
    if ((e.kind == "step" || e.kind == "pulse") && e.start <= 0) {
      out.push_back(e);
      out.back().stop = kInfinity;
    }
  return out;
}

LinearResponses::~LinearResponses() = default;

LinearResponses::LinearResponses(const RigParameters& rig, const RigParameters& drawing,
                                 const Scenario& scenario)
    : point_(std::make_unique<OperatingPoint>(TrueRig(rig), NominalRig(drawing))) {
  if (scenario.start == StartState::kClamped)
    Hold(drawing, scenario);
  else
    Levitate(scenario.speed.Speed(0));
}

void LinearResponses::Levitate(double speed) {
  loop_ = std::make_unique<ClosedLoop>(*point_, speed);
  const Index feedback = loop_->open().feedback();
  // The coils' feedback as further outputs.
  const Index coils = static_cast<Index>(loop_->plant().coils.size());
  feedback_row_ = loop_->C.rows();
  loop_->C.conservativeResize(feedback_row_ + coils, Eigen::NoChange);
  loop_->D.conservativeResize(feedback_row_ + coils, Eigen::NoChange);
  loop_->C.bottomRows(coils).setZero();
  loop_->D.bottomRows(coils).setZero();
  for (Index j = 0; j < coils; ++j)
    loop_->C(feedback_row_ + j, feedback + j) = loop_->scale()(feedback + j);
  transfer_ = std::make_unique<TransferFunction>(*point_, *loop_);
  stable_ = IsStable(transfer_->eigenvalues().cwiseAbs().maxCoeff());
}

double LinearResponses::SlowestDecay() const {
  constexpr double kStands = 1e-7;  // of a period: a state that nothing moves
  double slowest = 0;
  if (transfer_)
    for (const double size : transfer_->eigenvalues().cwiseAbs())
      if (size < 1 - kStands) slowest = std::max(slowest, size);
  return slowest > 0 ? -loop_->Ts() / std::log(slowest) : 0;
}

void LinearResponses::Hold(const RigParameters& drawing, const Scenario& scenario) {
  OperatingPoint& point = *point_;
  const HeldCommands commands = CommandsAtStart(drawing, scenario);
  for (std::size_t k = 0; k < point.bearings.size(); ++k) {
    const BearingPlant& b = point.plant().bearings[k];
    const auto clamp = scenario.clamp.find(b.name);
    const double x = clamp == scenario.clamp.end() ? 0 : clamp->second[0],
                 y = clamp == scenario.clamp.end() ? 0 : clamp->second[1];
    Lane current = commands.current[k];
    for (int j = 0; j < b.lanes.coils; ++j) {
      CoilPoint& c = point.coils[k][AsSize(j)];
      if (commands.by_duty[k][AsSize(j)]) {
        c.duty = commands.duty[k][j];
        const BridgePoint at =
            BridgeAt(point.rig().amplifier, b.bridge[AsSize(j)], point.plant().bus.voltage, c.duty);
        current[j] = at.volts / b.base_resistance[j];
      } else {
        if (current[j] != 0) current[j] = CarriedCurrent(point.rig().amplifier, b, j, current[j]);
        c.duty = point.HoldingDuty(k, j, current[j]);
      }
      c.current = current[j];
      c.commanded = true;
    }
    point.bearings[k] = LineariseBearing(b.lanes, current, x - b.offset_x, y - b.offset_y);
  }
  CloseCurrentLoops(commands.by_duty);
}

/// One switching period of the held coils under their regulators.
void LinearResponses::CloseCurrentLoops(const std::vector<std::array<bool, kLanes>>& by_duty) {
  const OperatingPoint& point = *point_;
  const LinearPlant plant = WithDrivenRotor(LinearisePlant(point, 0));
  const PeriodMap map = MakePeriodMap(point, plant);
  const AmplifierParameters& a = point.nominal().amplifier;
  const CurrentRegulator regulator(a);
  const double per_volt = regulator.DutyFromVoltage(1) - regulator.DutyFromVoltage(0);
  period_ = map.T;
  for (const PlantCoil& c : plant.coils) coils_.emplace_back(c.bearing, c.lane);
  // the plant without its rotor: linkages and what is hidden
  const Index c = static_cast<Index>(coils_.size()), first = 2 * plant.m(), s = plant.n() - first;
  // duty = per_volt (kp e + integral'), integral' = integral + ki T e, e = s - feedback
  const double gain = per_volt * (a.kp + a.ki * map.T), slope = a.ki * map.T;
  MatrixXd duty_of_x = MatrixXd::Zero(c, s + 2 * c);
  MatrixXd duty_of_s = gain * MatrixXd::Identity(c, c);
  MatrixXd integral_of_fb = -slope * MatrixXd::Identity(c, c);
  MatrixXd integral_of_s = slope * MatrixXd::Identity(c, c);
  duty_of_x.middleCols(s, c) = per_volt * MatrixXd::Identity(c, c);
  duty_of_x.rightCols(c) = (a.voltage_mode ? 0 : -gain) * MatrixXd::Identity(c, c);
  for (Index j = 0; j < c; ++j) {  // whose duty is given has no loop
    const auto [k, lane] = coils_[AsSize(j)];
    if (!by_duty[k][AsSize(lane)]) continue;
    duty_of_x.row(j).setZero();
    duty_of_s.row(j).setZero();
    integral_of_fb.row(j).setZero();
    integral_of_s.row(j).setZero();
  }
  const MatrixXd flow = map.state.bottomRightCorner(s, s), push = map.duty.bottomRows(s),
                 seen = map.feedback_of_state.rightCols(s);
  MatrixXd state = MatrixXd::Zero(s + 2 * c, s + 2 * c);
  state.topRows(s) = push * duty_of_x;
  state.topLeftCorner(s, s) += flow;
  state.block(s, s, c, c).setIdentity();
  state.block(s, s + c, c, c) = integral_of_fb;
  state.bottomRows(c) = map.feedback_of_duty * duty_of_x;
  state.bottomLeftCorner(c, s) += seen;
  MatrixXd by(s + 2 * c, 2 * c), feedback(c, s + 2 * c);
  by << push * duty_of_s, push,             //
      integral_of_s, MatrixXd::Zero(c, c),  //
      map.feedback_of_duty * duty_of_s, map.feedback_of_duty;
  feedback << MatrixXd::Zero(c, s + c), MatrixXd::Identity(c, c);
  held_ = std::make_unique<SampledSystem>(state, by, feedback);
}

/// All outputs under each port of these responses at f, once.
LinearResponses::Columns LinearResponses::ColumnsAt(
    double f, const std::vector<RigResponse>& responses) const {
  Columns out;
  const double omega = 2 * kPi * f;
  std::vector<std::string> ports;  // of the sampled inputs
  std::vector<Index> inputs;
  for (const RigResponse& r : responses) {
    const std::string& name = r.excited.name;
    if (out.contains(name) || std::ranges::find(ports, name) != ports.end()) continue;
    if (transfer_) {
      const TransferFunction::Input in = transfer_->FindInput(name);
      if (in.load) {
        out[name] = transfer_->Harmonic({omega, transfer_->LoadOn(in.column)});
        continue;
      }
      inputs.push_back(in.column);
    } else {
      const auto c = static_cast<Index>(coils_.size());
      inputs.push_back(CoilColumn(r.excited) + (r.excited.kind == PointKind::kDutyPort ? c : 0));
    }
    ports.push_back(name);
  }
  if (inputs.empty()) return out;
  const MatrixXcd H =
      transfer_ ? (*transfer_)(omega, inputs) : held_->At(std::polar(1.0, omega * period_), inputs);
  for (std::size_t k = 0; k < ports.size(); ++k) out[ports[k]] = H.col(static_cast<Index>(k));
  return out;
}

Complex LinearResponses::Levitated(const ResponsePoint& port, const ResponsePoint& out,
                                   double omega, const VectorXcd& column) const {
  const auto row = [&](const std::string& name) { return column(transfer_->FindOutput(name).row); };
  const std::vector<PlantCoil>& coils = loop_->plant().coils;
  switch (out.kind) {
    case PointKind::kError:
      return (port.kind == PointKind::kReferencePort && port.axis == out.axis ? 1.0 : 0.0) -
             row(out.axis);
    case PointKind::kCurrent:
    case PointKind::kSetPoint:
      for (std::size_t j = 0; j < coils.size(); ++j) {
        if (coils[j].bearing != out.bearing || coils[j].lane != out.index) continue;
        if (out.kind == PointKind::kCurrent) return column(feedback_row_ + static_cast<Index>(j));
        // in force one tick after the command was computed
        Complex s = 0;
        for (Index side = 0; side < coils[j].command.size(); ++side)
          s += coils[j].command(side) * column(loop_->Command(coils[j].axis + side));
        return s * std::polar(1.0, -omega * loop_->Ts());
      }
      return 0;
    default:
      return row(out.name);
  }
}

Index LinearResponses::CoilColumn(const ResponsePoint& point) const {
  for (std::size_t j = 0; j < coils_.size(); ++j)
    if (coils_[j].first == point.bearing && coils_[j].second == point.index)
      return static_cast<Index>(j);
  throw InputError(
      fmt::format("{}: a coil without current has no response, allowed: a constant current in the "
                  "scenario ([[excitation]] kind = \"step\")",
                  point.name));
}

Complex LinearResponses::Held(const ResponsePoint& port, const ResponsePoint& out,
                              const VectorXcd& column) const {
  const Index to = CoilColumn(out);
  if (out.kind == PointKind::kSetPoint)
    return to == CoilColumn(port) && port.kind == PointKind::kCurrentPort ? 1 : 0;
  return column(to);
}

Complex LinearResponses::Between(const ResponsePoint& port, const ResponsePoint& out, double omega,
                                 const VectorXcd& column) const {
  if (out.port()) return out.name == port.name ? 1 : 0;
  return transfer_ ? Levitated(port, out, omega, column) : Held(port, out, column);
}

std::vector<Complex> LinearResponses::At(double f,
                                         const std::vector<RigResponse>& responses) const {
  const Columns columns = ColumnsAt(f, responses);
  const double omega = 2 * kPi * f;
  std::vector<Complex> out;
  for (const RigResponse& r : responses) {
    const VectorXcd& column = columns.at(r.excited.name);
    out.push_back(Between(r.excited, r.output, omega, column) /
                  Between(r.excited, r.input, omega, column));
  }
  return out;
}

}  // namespace ambrig
