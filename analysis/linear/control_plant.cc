#include "analysis/linear/control_plant.h"

#include <algorithm>

#include "analysis/linear/loop_plant.h"

namespace ambrig {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Typical sizes of the states, so that numbers near 1 are what is controlled.
constexpr double kSize = 1e-5, kRate = 1e3;  // [m] at a plane, [1/s]
constexpr double kForce = 10;                // [N]

VectorXd TypicalSizes(const LoopPlant& loop, double kp) {
  const LinearPlant& p = loop.plant();
  const Index m = p.m(), coils = static_cast<Index>(p.coils.size());
  VectorXd size = VectorXd::Constant(loop.states(), kForce);
  for (Index q = 0; q < m; ++q) {
    const double reach =
        std::max(p.position.col(q).cwiseAbs().maxCoeff(), p.reading.col(q).cwiseAbs().maxCoeff());
    size[q] = kSize / (reach > 0 ? reach : 1);
    size[m + q] = kRate * size[q];
  }
  for (Index c = 0; c < coils; ++c) {
    const double ampere =
        kForce * p.coils[static_cast<std::size_t>(c)].command.cwiseAbs().maxCoeff();
    const double current = ampere > 0 ? ampere : 1;  // [A]; of a coil at its limit: any
    size[2 * m + c] = current / p.current(c, 2 * m + c);
    size[loop.integral() + c] = current * kp;
    size[loop.feedback() + c] = current;
  }
  return size;
}

/// The same plant in states that are divided by `size`.
void Scale(SampledPlant& plant, const VectorXd& size) {
  const VectorXd unit = size.cwiseInverse();
  plant.A = (unit.asDiagonal() * plant.A * size.asDiagonal()).eval();
  plant.B = (unit.asDiagonal() * plant.B).eval();
  plant.E = (unit.asDiagonal() * plant.E).eval();
  plant.C = (plant.C * size.asDiagonal()).eval();
  plant.V = (plant.V * size.asDiagonal()).eval();
  plant.G = (unit.asDiagonal() * plant.G).eval();
}

/// Generalised forces of a unit force on each axis (m x axes).
MatrixXd ForceOnAxes(const LinearPlant& plant) {
  MatrixXd out(plant.m(), plant.axes());
  Index axis = 0;
  for (const LinearPort& port : plant.rotor.ports) {
    out.middleCols(axis, port.B.cols()) = port.B;
    axis += port.B.cols();
  }
  return out;
}

/// The rig as its drawing says, without what disturbs it.
RigParameters WithoutEffects(RigParameters rig) {
  rig.effects.clear();
  for (BearingParameters& b : rig.bearings) b.auxiliary.reset();
  return rig;
}

}  // namespace

SampledPlant MakeControlPlant(const OperatingPoint& point, const std::vector<std::size_t>& axes,
                              double speed, CurrentModel currents, const ShaftWeights& weights) {
  const LoopPlant loop(point, LinearisePlant(point, speed, currents, &axes));
  const WeightedShaft shaft = WeighShaft(point, loop.plant(), weights);
  SampledPlant out;
  out.Ts = loop.Ts();
  out.A = loop.A;
  out.B = loop.B;
  out.E = loop.E * ForceOnAxes(loop.plant());
  out.C = loop.Rows(loop.plant().reading);
  out.V = MatrixXd::Zero(shaft.outputs.rows(), loop.states());
  out.V.leftCols(loop.plant().m()) = shaft.outputs;
  out.G = loop.E * shaft.forces;
  Scale(out, TypicalSizes(loop, point.nominal().amplifier.kp));
  return out;
}

SampledPlant MakeControlPlant(const RigParameters& rig, const std::vector<std::size_t>& axes,
                              double speed, const RigParameters* controllers,
                              const ShaftWeights& weights, const std::vector<CurrentMap>& maps) {
  const NominalRig plain(WithoutEffects(rig));
  const OperatingPoint point(TrueRig::AsDrawn(plain),
                             controllers ? NominalRig(*controllers) : plain, maps);
  return MakeControlPlant(point, axes, speed, CurrentModel::kAxisPatterns, weights);
}

}  // namespace ambrig
