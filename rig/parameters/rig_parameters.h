#pragma once
/// The parameters of a rig as its file gives them, and the way to each number by its path in
/// rig.toml. A file may hold two values of one number: the nominal one, which NominalRig
/// (rig/nominal_rig.h) hands to controllers and detectors, and the calibrated one of its tolerance,
/// which TrueRig (rig/true_rig.h) hands to the plant.
#include <any>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "actuators/electronics/amplifier_parameters.h"
#include "actuators/electronics/coil_errors.h"
#include "actuators/magnetics/opposed_stator.h"
#include "actuators/magnetics/radial_stator.h"
#include "actuators/magnetics/thrust_stator.h"
#include "control/interface/controller_file.h"
#include "core/base/parameter_rows.h"
#include "core/base/toml.h"
#include "effects/effect.h"
#include "rig/parameters/detection_parameters.h"
#include "rotor/contact/auxiliary_bearing.h"
#include "rotor/motion/bending_mode.h"
#include "rotor/motion/rotor_parameters.h"
#include "rotor/motion/sensor_parameters.h"
#include "rotor/motion/speed_sensor_parameters.h"
#include "rotor/shaft/beam_file.h"

namespace ambrig {

struct BearingKind;  // rig/parameters/bearing_kind.h
const BearingKind& RadialBearing();

struct BearingParameters {
  std::string name;
  const BearingKind* kind = &RadialBearing();  // never nullptr
  double z = 0;                                // [m]
  RadialStatorParameters radial;
  ThrustStatorParameters thrust;
  OpposedStatorParameters opposed;
  std::any own;  // parameters of a kind that has another stator than these three
  SensorParameters sensor;
  std::optional<AuxiliaryParameters> auxiliary;
  double auxiliary_z = kRequired;           // nan: at the bearing's plane [m]
  std::optional<PidParameters> controller;  // its own instead of the rig's
  CoilErrors coil_errors;                   // that are known of this machine

  int coils() const;
  /// Names of the controlled axes: "A.x", "A.y"; "z"; "M.x".
  std::vector<std::string> Axes() const;
};

struct RigParameters {
  std::string name, file;
  std::array<double, 3> gravity{0, -9.81, 0};
  std::string rotor_kind = "rigid";
  RotorParameters rotor;
  std::vector<BendingMode> modes;  // of a beam rotor, reduced
  std::optional<BeamFile> beam;    // the shaft itself, z as in the file
  // of every z here in the file's own [m]: a beam's centre of mass
  double z_origin = 0;
  // the same as the file has it, before a calibration: of scenarios
  double nominal_com_z = 0;
  std::vector<ShaftPlane> stations;  // named planes of a beam rotor, z as the bearings'
  AmplifierParameters amplifier;
  ControllerParameters controller;
  // [controllers.NAME], for changing over in a run
  std::vector<ControllerParameters> other_controllers;
  SpeedSensorParameters speed_sensor;
  std::vector<BearingParameters> bearings;
  DetectionParameters detection;
  std::vector<EffectInstance> effects;
  std::vector<Tolerance> tolerances;

  const BearingParameters* Find(const std::string& bearing) const;
  const ShaftPlane* FindStation(const std::string& name) const;
  int samples_per_period() const { return static_cast<int>(amplifier.adc_samples_per_period); }
  /// M: switching periods per controller period.
  int periods_per_control() const;
};

/// Controlled axes in the order of the bearings: "A.x", "A.y", ..., "z".
std::vector<std::string> AxisNames(const RigParameters& rig);
/// Those that [controller] has: of bearings without a controller of their own.
std::vector<std::size_t> ControlledAxes(const RigParameters& rig);

/// Paths of all numbers of the rig's parameter tables, and of a beam's shaft.
std::vector<std::string> ParameterPaths(const RigParameters& rig);
/// The number behind a path such as "rotor.mass", "bearings.A.gap" or "rotor.section[2].od" (of a
/// shaft: those with an sd); nullptr when there is none.
const double* ParameterAt(const RigParameters& rig, const std::string& path);
/// Another value of it, and of all that follows from it. A sensor's z counts from nominal_com_z.
/// False when there is no such number.
bool SetParameter(RigParameters& rig, const std::string& path, double value);
/// Its range from the parameter table.
bool ParameterRange(const RigParameters& rig, const std::string& path, double* lo, double* hi,
                    std::string* unit);

/// Every parameter table of a rig file: section, key, unit, range, doc, for help and docs.
std::vector<ParameterRow> RigParameterRows();

}  // namespace ambrig
