#include "simulation/continuous/equilibrium.h"

#include <cmath>

#include "actuators/magnetics/coil_network.h"
#include "core/math/cvode.h"
#include "rig/rig_figures.h"
#include "simulation/sampled/sampled_data_loop.h"

namespace ambrig {

namespace {

/// Everything that the equations need besides their unknowns.
struct Balance {
  const SampledDataLoop& rig;
  std::vector<CoilNetwork> networks;
  std::size_t axes = 0, dof = 0;
  std::vector<bool> fixed;  // coordinates that no force moves: held at zero

  explicit Balance(const SampledDataLoop& r)
      : rig(r), dof(static_cast<std::size_t>(r.plant.rotor.dof())), fixed(dof, false) {
    for (const BearingPlant& b : r.plant.bearings) networks.emplace_back(b.lanes);
    for (const SampledBearing& b : r.bearings) axes += b.axes;
    fixed[2] = !r.plant.rotor.axial_free;
    for (const AuxiliaryPlane& aux : r.plant.rotor.auxiliaries())
      if (aux.race_dof >= 0) fixed[static_cast<std::size_t>(aux.race_dof)] = true;  // turns freely
  }

  void Equations(const double* u, double* F) const {
    MotionState s;
    std::copy(u + axes, u + axes + dof, s.q.begin());
    DofVector Q{}, a{};
    double stator_x = 0, stator_y = 0, torque = 0;
    for (const SampledBearing& b : rig.bearings) {
      const auto set =
          rig.control[b.index].map.SetPoints(u[b.first_axis], b.axes > 1 ? u[b.first_axis + 1] : 0);
      double lambda[kMaxWindings];
      auto [x, y] = rig.plant.rotor.Position(s, b.plant->plane);
      x -= b.plant->offset_x;
      y -= b.plant->offset_y;
      NetworkState n;
      networks[b.index].Linkages(set.data(), x, y, lambda);
      networks[b.index].Solve(lambda, x, y, n);
      b.plant->plane.AddForce(n.fx, n.fy, Q);
      if (b.plant->thrust) continue;
      stator_x += n.fx;
      stator_y += n.fy;
    }
    rig.plant.rotor.Accelerations(s, Q, stator_x, stator_y, a, &torque);
    for (std::size_t d = 0; d < dof; ++d) F[d] = fixed[d] ? s.q[d] : a[d];
    for (const SampledBearing& b : rig.bearings) {
      const PlanePoint reading = rig.plant.rotor.Position(s, b.plant->sensor.map);
      F[dof + b.first_axis] = reading.x;
      if (b.axes > 1) F[dof + b.first_axis + 1] = reading.y;
    }
  }
};

}  // namespace

Equilibrium LevitatedEquilibrium(const SampledDataLoop& rig) {
  const Balance balance(rig);
  const std::size_t n = balance.axes + balance.dof;
  // Sizes that matter: the rotor's weight, a micrometre, the acceleration of gravity.
  double g = 0;
  for (double component : rig.rig.gravity) g = std::max(g, std::abs(component));
  g = std::max(g, 0.1);
  std::vector<double> start(n, 0.0), u_scale(n, 1e-6), f_scale(n, 1e-6);
  const auto shares = WeightShares(rig.rig);
  for (const SampledBearing& b : rig.bearings)
    for (std::size_t side = 0; side < b.axes; ++side) {
      start[b.first_axis + side] = shares[b.index][side];
      u_scale[b.first_axis + side] = rig.rig.rotor.mass * g;
    }
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
  for (const SampledBearing& b : rig.bearings) {
    const auto set = rig.control[b.index].map.SetPoints(e.force[b.first_axis],
                                                        b.axes > 1 ? e.force[b.first_axis + 1] : 0);
    Lane current;
    for (int j = 0; j < rig.control[b.index].coils; ++j) current[j] = set[j];
    e.current.push_back(current);
  }
  return e;
}

Equilibrium LevitatedEquilibrium(const RigParameters& rig, const Scenario& scenario) {
  SampledDataLoop sampled(rig, scenario, {});
  sampled.Start();
  return LevitatedEquilibrium(sampled);
}

}  // namespace ambrig
