#include "simulation/continuous/continuous_rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/index.h"
#include "scenarios/faults/fault.h"

namespace ambrig {

namespace {
constexpr std::size_t kEnergies = 5;  // electrical, drive, copper, contact, magnetic work

/// `file`: the rig's, "" where it was made by a program.
void RefuseWhatIsNotHere(const Plant& plant, const std::string& file) {
  const std::string where = file.empty() ? "" : file + ": ";
  for (const BearingPlant& b : plant.bearings) {
    if (b.lanes.network)
      throw InputError(fmt::format(
          "{}bearing {}: kind = \"stator\" or \"axial-stator\" needs --fidelity switching", where,
          b.name));
    if (!b.lanes.laws.empty())
      throw InputError(fmt::format("{}bearing {}: effects of the iron need --fidelity switching",
                                   where, b.name));
    if (b.heating.rise_per_watt > 0)
      throw InputError(fmt::format("{}bearing {}: effect copper-heating needs --fidelity switching",
                                   where, b.name));
  }
  if (!plant.bus.stiff())
    throw InputError(where + "effect bus-impedance needs --fidelity switching");
}
}  // namespace

ContinuousRig::ContinuousRig(SampledDataLoop& rig, const IntegratorOptions& options)
    : rig_(rig), steps_a_period_(options.steps_a_period) {
  RefuseWhatIsNotHere(rig.plant, rig.rig.file);
  for (std::size_t k = 0; k < rig.bearings.size(); ++k) {
    bearings_.emplace_back(rig.plant.bearings[k].lanes);
    const std::string prefix = rig.plant.bearings[k].name + ".coil";
    for (const FaultSpec& f : rig.scenario.faults) {
      const Fault& fault = FaultByKind(f.kind);
      if (!f.target.starts_with(prefix) || !fault.adds_winding || !fault.adds_winding(f)) continue;
      CoilNetwork& network = bearings_.back().network;
      if (network.windings.size() == kMaxWindings)
        throw InputError(fmt::format(
            "{}: target: \"{}\" is the bearing's short number {} with a resistance, "
            "allowed: {} with --fidelity reference or averaged",
            f.where, f.target, bearings_.back().loops.size() + 1, bearings_.back().loops.size()));
      bearings_.back().loops.push_back(
          static_cast<int>(network.ReserveLoop(std::stoi(f.target.substr(prefix.size())) - 1)));
    }
  }
  for (const LoadSpec& l : rig.scenario.loads) {
    DofVector Q{};
    rig.plant.rotor.MakePlane(l.z + (rig.rig.nominal_com_z - rig.rig.z_origin))
        .AddForce(l.fx, l.fy, Q);
    Q[2] += l.fz;
    load_Q_.push_back(Q);
  }
  LayOut();
  now_.resize(bearings_.size());
  OdeProblem problem = MakeProblem(options);
  if (options.stiff)
    solver_ = std::make_unique<Cvode>(std::move(problem));
  else
    solver_ = std::make_unique<Arkode>(std::move(problem), options.order);
}

void ContinuousRig::LayOut() {
  // Absolute tolerances: far below what a record can show, in the units of each state.
  const auto add = [&](std::size_t count, double absolute) {
    const std::size_t at = absolute_.size();
    absolute_.insert(absolute_.end(), count, absolute);
    return at;
  };
  for (Bearing& b : bearings_) {
    b.at = add(b.network.windings.size(), 1e-13);       // [Wb]
    b.force_at = add(2, 1e-12);                         // [N s]
    b.charge_at = add(AsSize(b.network.coils), 1e-13);  // [A s]
  }
  energy_at_ = add(kEnergies, 1e-12);  // [J]
  const std::size_t dof = rig_.clamped ? 0 : AsSize(rig_.plant.rotor.dof());
  q_at_ = add(dof, 1e-15);                     // [m]
  v_at_ = add(dof, 1e-12);                     // [m/s]
  spin_at_ = add(rig_.clamped ? 0 : 2, 1e-9);  // [rad], [rad/s]
  y_.assign(absolute_.size(), 0.0);
}

OdeProblem ContinuousRig::MakeProblem(const IntegratorOptions& options) {
  OdeProblem p;
  p.size = y_.size();
  p.rhs = [this](double tau, const double* y, double* f) { Rhs(tau, y, f); };
  p.root = [this](double tau, const double* y, double* g) { Roots(tau, y, g); };
  for (const Bearing& b : bearings_)
    p.directions.insert(p.directions.end(), AsSize(b.network.coils), -1);
  if (!rig_.clamped)
    p.directions.insert(p.directions.end(), rig_.plant.rotor.auxiliaries().size() + 1, 0);
  p.roots = static_cast<int>(p.directions.size());
  p.relative = options.tolerance;
  p.absolute = absolute_;
  p.max_steps = kStepsAtOnce;  // between two stops
  return p;
}

MotionState ContinuousRig::MotionOf(double tau, const double* y) const {
  MotionState s = rig_.motion;
  s.t = t0_ + tau;
  if (rig_.clamped) return s;
  const std::size_t dof = AsSize(rig_.plant.rotor.dof());
  std::copy(y + q_at_, y + q_at_ + dof, s.q.begin());
  std::copy(y + v_at_, y + v_at_ + dof, s.v.begin());
  if (free_spin_) {
    s.theta = y[spin_at_];
    s.Omega = y[spin_at_ + 1];
  } else {
    s.theta = rig_.scenario.speed.Angle(s.t);
    s.Omega = rig_.scenario.speed.Speed(s.t);
    s.Omega_dot = rig_.scenario.speed.Acceleration(s.t);
  }
  return s;
}

void ContinuousRig::Place(std::size_t k, const MotionState& s, double* x, double* y) const {
  const BearingPlant& plant = rig_.plant.bearings[k];
  const PlanePoint p = rig_.plant.rotor.Position(s, plant.plane);
  *x = p.x - plant.offset_x;
  *y = p.y - plant.offset_y;
}

void ContinuousRig::Slopes(const Bearing& b, const NetworkState& s, double* slope) const {
  for (std::size_t w = 0; w < b.network.windings.size(); ++w) {
    const Winding& k = b.network.windings[w];
    const bool carries = k.live && !k.broken && k.conducts;
    const double v = k.coil < 0 ? 0 : b.volts[AsSize(k.coil)];
    slope[w] = carries ? v - k.resistance * s.i[w] : 0;
  }
}

void ContinuousRig::Rhs(double tau, const double* y, double* f) const {
  const MotionState s = MotionOf(tau, y);
  DofVector Q = active_load_;
  double stator_x = 0, stator_y = 0, electrical = 0, copper = 0, work = 0;
  for (std::size_t k = 0; k < bearings_.size(); ++k) {
    const Bearing& b = bearings_[k];
    double px, py;
    Place(k, s, &px, &py);
    NetworkState n;
    b.network.Solve(y + b.at, px, py, n);
    Slopes(b, n, f + b.at);
    for (std::size_t w = 0; w < b.network.windings.size(); ++w) {
      const Winding& winding = b.network.windings[w];
      copper += winding.live ? winding.resistance * n.i[w] * n.i[w] : 0;
      if (winding.coil < 0) continue;
      electrical += b.volts[AsSize(winding.coil)] * n.i[w];
      f[b.charge_at + AsSize(winding.coil)] = n.i[w];
    }
    f[b.force_at] = n.fx;
    f[b.force_at + 1] = n.fy;
    const PlaneMap& plane = rig_.plant.bearings[k].plane;
    plane.AddForce(n.fx, n.fy, Q);
    if (!rig_.clamped) work += n.fx * plane.X(s.v) + n.fy * plane.Y(s.v);
    if (rig_.plant.bearings[k].thrust) continue;
    stator_x += n.fx;
    stator_y += n.fy;
  }
  double spin_torque = 0;
  double* energy = f + energy_at_;
  energy[0] = electrical;
  energy[2] = copper;
  energy[3] = rig_.clamped ? 0 : ContactLoss(s, &spin_torque);
  energy[1] = free_spin_ ? 0 : -spin_torque * s.Omega;
  energy[4] = work;
  if (rig_.clamped) return;
  DofVector a{};
  double torque = 0;
  rig_.plant.rotor.Accelerations(s, Q, stator_x, stator_y, a, &torque);
  const std::size_t dof = AsSize(rig_.plant.rotor.dof());
  for (std::size_t d = 0; d < dof; ++d) {
    f[q_at_ + d] = s.v[d];
    f[v_at_ + d] = a[d];
    energy[1] += active_load_[d] * s.v[d];
  }
  const double polar = rig_.plant.rotor.parameters().inertia_polar;
  f[spin_at_] = s.Omega;
  f[spin_at_ + 1] = free_spin_ && polar > 0 ? torque / polar : s.Omega_dot;
}

double ContinuousRig::ContactLoss(const MotionState& s, double* spin_torque) const {
  // What an elastic spring k p^n alone would not give back, and friction; races and mounts aside.
  const RotorModel& rotor = rig_.plant.rotor;
  const double radius = rotor.parameters().journal_radius;
  double loss = 0;
  for (const AuxiliaryPlane& aux : rotor.auxiliaries()) {
    const auto [x, y] = rotor.Position(s, aux.map);
    const double vx = aux.map.X(s.v), vy = aux.map.Y(s.v), r = std::hypot(x, y);
    const ContactForce c = RadialContact(aux.parameters, radius, x, y, vx, vy, s.Omega, 0);
    if (c.penetration <= 0) continue;
    const double rate = (vx * x + vy * y) / r;
    const double elastic =
        aux.parameters.stiffness * std::pow(c.penetration, aux.parameters.exponent);
    const double power = c.fx * vx + c.fy * vy + c.torque * s.Omega;  // into the shaft
    loss += -power - elastic * rate;
    *spin_torque += c.torque;
  }
  return loss;
}

void ContinuousRig::Roots(double tau, const double* y, double* g) const {
  const MotionState s = MotionOf(tau, y);
  for (std::size_t k = 0; k < bearings_.size(); ++k) {
    const Bearing& b = bearings_[k];
    double px, py;
    Place(k, s, &px, &py);
    NetworkState n;
    b.network.Solve(y + b.at, px, py, n);
    double slope[kMaxWindings];
    NetworkRates r;
    bool rates = false;
    for (int j = 0; j < b.network.coils; ++j) {
      const Winding& w = b.network.windings[AsSize(j)];
      *g = 1;
      const int way = b.way[AsSize(j)];
      if (!w.broken && w.conducts && way != 0) *g = way * n.i[AsSize(j)];
      if (!w.broken && !w.conducts && b.driven[AsSize(j)] && way != 0) {
        if (!rates) {
          const PlaneMap& plane = rig_.plant.bearings[k].plane;
          Slopes(b, n, slope);
          b.network.Rates(n, slope, px, py, rig_.clamped ? 0 : plane.X(s.v),
                          rig_.clamped ? 0 : plane.Y(s.v), r);
          rates = true;
        }
        *g = w.n * r.phi[AsSize(w.pole)] - b.volts[AsSize(j)];
      }
      ++g;
    }
  }
  if (rig_.clamped) return;
  const RotorModel& rotor = rig_.plant.rotor;
  for (std::size_t k = 0; k < rotor.auxiliaries().size(); ++k) *g++ = rotor.Penetration(s, k);
  const double axial = rotor.AxialPenetration(s);
  *g++ = std::isfinite(axial) ? axial : -1;
}

}  // namespace ambrig
