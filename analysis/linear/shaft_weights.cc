#include "analysis/linear/shaft_weights.h"
#include "rotor/motion/linearise.h"

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Of the shaft's points [kg^-1/2].
double LargestGain(const BendingMode& mode) {
  double most = 0;
  for (const ShapePoint& p : mode.shape) most = std::max(most, std::abs(p.gain));
  return most;
}

}  // namespace

WeightedShaft WeighShaft(const OperatingPoint& point, const LinearPlant& plant,
                         const ShaftWeights& weights) {
  const RigParameters& rig = point.rig();
  const RotorModel& rotor = point.plant().rotor;
  const auto planes = static_cast<Index>(weights.planes.size());
  const auto modes = static_cast<Index>(weights.modes ? rig.modes.size() : 0);
  const Index all = rotor.dof();
  WeightedShaft whole{MatrixXd::Zero(2 * (planes + modes), all),
                      MatrixXd::Zero(all, 2 * (planes + modes))};
  for (Index k = 0; k < planes; ++k) {
    const PlaneWeight& w = weights.planes[static_cast<std::size_t>(k)];
    const BearingParameters* b = rig.Find(w.at);
    const ShaftPlane* station = rig.FindStation(w.at);
    Require(b || station, "a plane of the rig");
    const PlaneMap at = rotor.MakePlane(b ? b->z : station->z);
    whole.outputs.middleRows(2 * k, 2) = PlaneRows(rotor, at) / w.position_weight;
    whole.forces.middleCols(2 * k, 2) = w.force_noise * ForceColumns(rotor, at);
  }
  for (Index k = 0; k < modes; ++k) {
    const BendingMode& mode = rig.modes[static_cast<std::size_t>(k)];
    const double eta = weights.modes->deflection / LargestGain(mode);
    const double error = 2 * weights.modes->uncertainty * mode.omega * mode.omega * eta;
    for (Index side = 0; side < 2; ++side) {
      const Index row = 2 * (planes + k) + side,
                  d = rotor.mode_dof(static_cast<std::size_t>(k)) + side;
      whole.outputs(row, d) = 1 / eta;
      whole.forces(d, row) = error;  // modes are mass normalised
    }
  }
  return {whole.outputs(Eigen::all, plant.coordinate), whole.forces(plant.coordinate, Eigen::all)};
}

}  // namespace ambrig
