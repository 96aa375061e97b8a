#pragma once
/// What a synthesis weighs besides forces and readings: planes of the shaft and bending modes, as
/// outputs and disturbances of the plant's rotor.
#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "analysis/linear/linear_plant.h"
#include "control/synthesis/mode_weight.h"
#include "control/synthesis/plane_weight.h"

namespace ambrig {

struct ShaftWeights {
  std::vector<PlaneWeight> planes;  // of radial bearings and named planes of the shaft
  std::optional<ModeWeight> modes;  // every bending mode of the rig
};

/// Over the m kept coordinates of a plant, two of each per plane and per bending mode.
struct WeightedShaft {
  Eigen::MatrixXd outputs;  // (rows x m), each costs 1 at 1
  Eigen::MatrixXd forces;   // (m x columns) generalised forces of disturbances of size 1
};

WeightedShaft WeighShaft(const OperatingPoint& point, const LinearPlant& plant,
                         const ShaftWeights& weights);

}  // namespace ambrig
