#include "analysis/linear/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "actuators/magnetics/coil_network.h"
#include "analysis/linear/linear_sensor.h"
#include "core/base/index.h"
#include "core/math/kinsol.h"
#include "rig/rig_assembly.h"

namespace ambrig {

namespace {

constexpr double kNoLever = 1e-9;  // of a force on a coordinate [-, m]: zero but for rounding

/// Everything that the equations need besides their unknowns.
struct Balance {
  const Plant& plant;
  const std::vector<BearingControl>& control;
  const AmplifierParameters& amplifier;
  const bool true_parts;
  std::vector<std::unique_ptr<CoilNetwork>> networks;  // nullptr: of any stator
  std::vector<std::size_t> first_axis;                 // per bearing
  std::size_t axes = 0, dof = 0;
  std::vector<bool> fixed;  // coordinates that no force moves: held at zero

  Balance(const Plant& p, const std::vector<BearingControl>& c, const AmplifierParameters& a,
          EquilibriumOf parts)
      : plant(p),
        control(c),
        amplifier(a),
        true_parts(parts == EquilibriumOf::kTrueParts),
        dof(static_cast<std::size_t>(p.rotor.dof())),
        fixed(dof, false) {
    for (const BearingPlant& b : plant.bearings) {
      networks.push_back(b.lanes.network ? nullptr : std::make_unique<CoilNetwork>(b.lanes));
      first_axis.push_back(axes);
      axes += AxesOf(b);
    }
    fixed[2] = !plant.rotor.axial_free;
    // One axis moves a point along itself: across it and in tilt nothing pulls.
    for (const std::size_t d : {0, 1, 3, 4}) fixed[d] = !MagnetsMove(d);
    for (const AuxiliaryPlane& aux : plant.rotor.auxiliaries())
      if (aux.race_dof >= 0) fixed[static_cast<std::size_t>(aux.race_dof)] = true;  // turns freely
  }

  bool MagnetsMove(std::size_t d) const {
    return std::ranges::any_of(plant.bearings, [&](const BearingPlant& b) {
      DofVector x{}, y{};
      b.plane.AddForce(1, 0, x);
      b.plane.AddForce(0, 1, y);
      return std::abs(x[d]) + (b.opposed ? 0 : std::abs(y[d])) > kNoLever;
    });
  }

  CoilVector SetPoints(std::size_t k, const double* force) const {
    const double* f = force + first_axis[k];
    return control[k].map.SetPoints(f[0], AxesOf(plant.bearings[k]) > 1 ? f[1] : 0);
  }

  CoilVector Carried(std::size_t k, const double* force) const {
    CoilVector out = SetPoints(k, force);
    if (true_parts)
      for (int j = 0; j < control[k].coils; ++j)
        out[j] = CarriedCurrent(amplifier, plant.bearings[k], j, out[j]);
    return out;
  }

  /// Of bearing k with the shaft at (x, y) of its magnets [N].
  PlanePoint Pull(std::size_t k, const CoilVector& current, double x, double y) const {
    const StatorLanes& lanes = plant.bearings[k].lanes;
    if (!networks[k]) {
      const Eigen::Vector3d f =
          lanes.network->Force({x, y, 0}, lanes.CountedCurrents(current.data()));
      return {f.x(), f.y()};
    }
    PlanePoint f{};
    if (true_parts && !lanes.laws.empty()) {
      StatorLanes at = lanes;
      Lane carried;
      for (int j = 0; j < lanes.coils; ++j) carried[j] = current[j];
      at.Settle(carried, x, y);
      at.Force(x, y, &f.x, &f.y);
      return f;
    }
    double lambda[kMaxWindings];
    NetworkState n;
    networks[k]->Linkages(current.data(), x, y, lambda);
    networks[k]->Solve(lambda, x, y, n);
    return {n.fx, n.fy};
  }

  PlanePoint Reading(const MotionState& s, const BearingPlant& b) const {
    const PlanePoint at = plant.rotor.Position(s, b.sensor.map);
    if (!true_parts) return at;
    const Eigen::Vector2d reading = ReadingAt(b.sensor, s, at.x, at.y);
    return {reading.x(), reading.y()};
  }

  void Equations(const double* u, double* F) const {
    MotionState s;
    std::copy(u + axes, u + axes + dof, s.q.begin());
    DofVector Q{}, a{};
    double stator_x = 0, stator_y = 0, torque = 0;
    for (std::size_t k = 0; k < plant.bearings.size(); ++k) {
      const BearingPlant& b = plant.bearings[k];
      const auto [x, y] = plant.rotor.Position(s, b.plane);
      const PlanePoint f = Pull(k, Carried(k, u), x - b.offset_x, y - b.offset_y);
      b.plane.AddForce(f.x, f.y, Q);
      if (b.thrust) continue;
      stator_x += f.x;
      stator_y += f.y;
    }
    plant.rotor.Accelerations(s, Q, stator_x, stator_y, a, &torque);
    for (std::size_t d = 0; d < dof; ++d) F[d] = fixed[d] ? s.q[d] : a[d];
    for (std::size_t k = 0; k < plant.bearings.size(); ++k) {
      const PlanePoint reading = Reading(s, plant.bearings[k]);
      F[dof + first_axis[k]] = reading.x;
      if (AxesOf(plant.bearings[k]) > 1) F[dof + first_axis[k] + 1] = reading.y;
    }
  }
};

}  // namespace

std::size_t AxesOf(const BearingPlant& bearing) {
  return bearing.thrust || bearing.opposed ? 1 : 2;
}

double CarriedCurrent(const AmplifierParameters& amplifier, const BearingPlant& bearing, int coil,
                      double set_point) {
  if (amplifier.voltage_mode) return set_point;
  const CurrentSensor& sensor = bearing.current_sensor[AsSize(coil)];
  const double current = (set_point - sensor.offset) / sensor.gain;
  return bearing.lanes.unipolar ? std::max(current, 0.0) : current;
}

Equilibrium LevitatedEquilibrium(const RigParameters& rig, const Plant& plant,
                                 const std::vector<BearingControl>& control, EquilibriumOf parts) {
  const Balance balance(plant, control, rig.amplifier, parts);
  const std::size_t n = balance.axes + balance.dof;
  // Sizes that matter: the rotor's weight, a micrometre, the acceleration of gravity.
  double g = 0;
  for (double component : rig.gravity) g = std::max(g, std::abs(component));
  g = std::max(g, 0.1);
  std::vector<double> start = WeightOverAxes(rig), u_scale(n, 1e-6), f_scale(n, 1e-6);
  start.resize(n, 0.0);
  std::fill_n(u_scale.begin(), balance.axes, rig.rotor.mass * g);
  for (std::size_t d = 0; d < balance.dof; ++d)
    if (!balance.fixed[d]) f_scale[d] = g;
  const KinsolOutcome out = SolveKinsol(
      [&](const double* u, double* F) { balance.Equations(u, F); }, start, u_scale, f_scale, 1e-9);
  Equilibrium e;
  e.residual = out.residual;
  e.iterations = out.iterations;
  e.converged = out.converged;
  e.message = out.message;
  e.force.assign(out.u.begin(), out.u.begin() + static_cast<std::ptrdiff_t>(balance.axes));
  std::copy(out.u.begin() + static_cast<std::ptrdiff_t>(balance.axes), out.u.end(), e.q.begin());
  for (std::size_t k = 0; k < plant.bearings.size(); ++k) {
    const auto set = balance.SetPoints(k, e.force.data());
    Lane current;
    for (int j = 0; j < control[k].coils; ++j) current[j] = set[j];
    e.current.push_back(current);
  }
  return e;
}

}  // namespace ambrig
