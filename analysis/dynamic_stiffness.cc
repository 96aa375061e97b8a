#include "analysis/dynamic_stiffness.h"

#include "core/math/constants.h"

namespace ambrig {

namespace {

using Eigen::Index;
using Eigen::VectorXcd;

/// Accelerations of a unit harmonic translation along an axis: all planes move alike.
VectorXcd Translation(const LinearPlant& plant, Index axis, double omega) {
  VectorXcd out = VectorXcd::Zero(plant.m());
  for (Index d = 0; d < plant.m(); ++d)
    if (plant.coordinate[static_cast<std::size_t>(d)] < 3)
      out(d) = -omega * omega * plant.position(axis, d);
  return out;
}

}  // namespace

DynamicStiffness FindStiffness(const OperatingPoint& point, const TransferFunction& transfer,
                               const std::vector<double>& frequency) {
  const ClosedLoop& loop = transfer.loop();
  const ClosedLoop driven(point, WithDrivenRotor(loop.plant()));
  const TransferFunction held(point, driven);
  DynamicStiffness out;
  out.frequency = frequency;
  for (const std::string& axis : point.Axes()) out.axes.push_back({axis, {}, {}});
  for (double f : frequency) {
    const double omega = 2 * kPi * f;
    for (Index a = 0; a < loop.axes(); ++a) {
      AxisStiffness& s = out.axes[static_cast<std::size_t>(a)];
      const VectorXcd moved = held.Harmonic({omega, Translation(loop.plant(), a, omega)});
      s.bearing.push_back(-moved(driven.Force(a)) / moved(driven.Position(a)));
      const VectorXcd pushed = transfer.Harmonic({omega, transfer.LoadOn(a)});
      s.rotor.push_back(1.0 / pushed(loop.Position(a)));
    }
  }
  return out;
}

}  // namespace ambrig
