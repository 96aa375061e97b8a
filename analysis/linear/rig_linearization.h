#pragma once
/// The nominal rig in small motions about levitation (bias c0, weight carried): rotor, magnets and
/// amplifiers of every axis, each axis with its own pattern of currents. Not in it: effects,
/// contact, ripple, clamping; the coupling of a bearing's other current patterns (second order in
/// weight/bias). Source: docs/theory/base_model.md sections 1 to 4; docs/theory/linearisation.md.
#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "control/synthesis/mode_weight.h"
#include "control/synthesis/plane_weight.h"
#include "rig/rig_parameters.h"

namespace ambrig {

/// What a synthesis weighs besides forces and readings.
struct ShaftWeights {
  std::vector<PlaneWeight> planes;  // of radial bearings and named planes of the shaft
  std::optional<ModeWeight> modes;  // every bending mode of the rig
};

/// One axis' magnet and amplifier in its own current pattern, v: its amplitude [A].
struct AxisActuator {
  double force = 0;              // k c0 [N/A]
  double command = 0;            // k c0 as the controller believes [N/A]
  double inductance = 0;         // [H]
  double back_emf_constant = 0;  // kb [V s/m]
  double resistance = 0;         // [ohm]
  double volts = 0;              // of mean voltage per volt asked for [-]
  double edge = 0;               // mean edge of the switching period, share of it
};

/// n coordinates, p axes: q'' = stiffness q + damping q' + force (f + magnet bearing q) +
/// disturbance_input d.
struct RigLinearization {
  Eigen::MatrixXd stiffness, damping;  // n x n, as accelerations
  Eigen::MatrixXd bearing, sensor;     // displacement of each axis per coordinate (p x n)
  Eigen::MatrixXd force;               // acceleration per force on an axis (n x p)
  Eigen::MatrixXd magnet;              // d f / d x, p x p: negative stiffness [N/m]
  // of the weights: outputs (rows x n), accelerations per disturbance d (n x columns)
  Eigen::MatrixXd performance_output, disturbance_input;
  std::vector<AxisActuator> actuators;
};

/// `controllers`: the rig as the controller knows it.
RigLinearization LineariseRig(const RigParameters& rig, const RigParameters& controllers,
                              double Omega, const ShaftWeights& weights);

/// Leaves the axes named, in that order, and the coordinates that they move or that move them.
void KeepAxes(RigLinearization& l, const std::vector<std::size_t>& axes);

}  // namespace ambrig
