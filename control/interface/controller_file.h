#pragma once
/// The controllers that a rig file may name (controller_kind.h): [controller] and, for changing
/// over in a run, [controllers.NAME]. Keys: docs/guide/controllers.md; numbers: docs/parameters.md.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "control/position/filter.h"
#include "control/position/pid.h"
#include "control/position/tilt_translation.h"
#include "control/position/unbalance_control.h"
#include "control/synthesis/h_infinity.h"
#include "control/synthesis/lqg.h"
#include "control/synthesis/mode_weight.h"
#include "control/synthesis/plane_weight.h"

namespace ambrig {

/// PID gains at one speed; what is not given is the controller's own.
struct PidPoint {
  double speed = kRequired;
  double kp = 0, kd = 0, ki = 0;
};

inline constexpr Field<PidPoint> kPidPointFields[] = {
    {"speed", &PidPoint::speed, "rad/s", 0, 1e5,
     "ascending; gains are linear in between, held outside"},
    {"kp", &PidPoint::kp, "N/m", -1e12, 1e12, "default: the controller's"},
    {"kd", &PidPoint::kd, "N s/m", -1e9, 1e9, "default: the controller's"},
    {"ki", &PidPoint::ki, "N/(m s)", -1e15, 1e15, "default: the controller's"},
};

/// One axis' system, force [N] from error [m], sampled.
struct AxisSystem {
  std::vector<std::string> axes;  // empty: every axis that no other names
  StateSpace system;
};

/// A system of all axes at one speed [rad/s], sampled.
struct SystemPoint {
  double speed = 0;
  StateSpace system;
};

/// Numbers that a kind of controller keeps to itself: its file derives from this.
struct ControllerSettings {
  virtual ~ControllerSettings() = default;
};

struct ControllerParameters {
  PidParameters pid;  // f_max of every kind; gains 0 unless the kind is pid
  double rate = kRequired;
  double bias_current = kRequired;
  std::string kind = "pid";
  std::string name = "main", where;  // file:line
  std::vector<FilterParameters> filters;
  std::vector<PidPoint> schedule;
  std::vector<AxisSystem> transfers;
  std::vector<SystemPoint> systems;
  std::vector<double> speeds{0};    // that an LQG or H-infinity control is designed for [rad/s]
  std::vector<PlaneWeight> planes;  // that its synthesis weighs beside the bearings
  std::optional<ModeWeight> modes;  // the same of the bending modes
  // bending modes in the model of its synthesis, the lowest; -1: all of the rig
  int model_modes = -1;
  LqgParameters lqg;
  HInfinityParameters h_infinity;
  CoordinateGains translation, tilt;
  double gyroscopic_compensation = 0;
  std::optional<UnbalanceControlParameters> unbalance;
  std::shared_ptr<const ControllerSettings> own;  // of a kind whose numbers are not above

  /// The base controller of docs/theory/base_model.md: one PID per axis and nothing else.
  bool IsPlainPid() const {
    return kind == "pid" && filters.empty() && schedule.empty() && !unbalance;
  }
};

inline constexpr Field<ControllerParameters> kControllerFields[] = {
    {"rate", &ControllerParameters::rate, "Hz", 1, 1e6,
     "an integer fraction of the switching frequency"},
    {"bias_current", &ControllerParameters::bias_current, "A", 1e-6, 1e4, "c0"},
};
inline constexpr Field<ControllerParameters> kTiltTranslationFields[] = {
    {"gyroscopic_compensation", &ControllerParameters::gyroscopic_compensation, "-", 0, 2,
     "share of the gyroscopic moment that is cancelled"},
};

/// Kind and what belongs to it; rate and bias current are read by the caller, who also rejects
/// unknown keys. `axes`: names of the axes that it controls, in the rig's order; `planes`: of
/// bearings, disks and stations. @throws InputError
void ReadControllerKind(const TomlTable& table, const std::vector<std::string>& axes,
                        const std::vector<std::string>& planes, ControllerParameters& c);

/// f_max alone, for kinds that are no PID.
inline constexpr Field<PidParameters> kForceLimitField[] = {kPidFields[4]};

}  // namespace ambrig
