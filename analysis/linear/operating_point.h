#pragma once
/// Where a rig is linearised: levitated at rest, every sensor reads zero, the coils carry what
/// holds the weight, with the laws of the iron and the errors of sensors and bridges. What turns
/// with the shaft is no part of it; speed enters the derivatives only.
#include <memory>
#include <string>
#include <vector>

#include "analysis/linear/equilibrium.h"
#include "analysis/linear/linear_bearing.h"
#include "analysis/linear/linear_sensor.h"
#include "rig/true_rig.h"

namespace ambrig {

/// One coil at the operating point.
struct CoilPoint {
  double current = 0;     // carried [A]
  double duty = 0;        // that holds it [-]
  bool commanded = true;  // false: its set-point is at a limit and does not follow the force
};

class OperatingPoint {
 public:
  OperatingPoint() = default;
  /// `nominal`: what the controller knows. `maps`: from forces to currents, one per bearing, in
  /// place of those of healthy bearings; empty: those.
  OperatingPoint(const TrueRig& rig, const NominalRig& nominal,
                 const std::vector<CurrentMap>& maps = {});

  const RigParameters& rig() const { return *model_->rig; }
  const RigParameters& nominal() const { return *model_->nominal; }
  Plant& plant() const { return model_->plant; }
  /// The controller's side of each bearing.
  const std::vector<BearingControl>& control() const { return model_->control; }
  /// Names of the controlled axes, in the order of the bearings.
  std::vector<std::string> Axes() const;
  /// The first axis of a bearing, and how many it has.
  std::size_t FirstAxis(std::size_t bearing) const;
  std::size_t AxisCount(std::size_t bearing) const { return AxesOf(plant().bearings[bearing]); }
  /// The duty that holds `current` [A] in a coil.
  double HoldingDuty(std::size_t bearing, int coil, double current) const;
  /// The bearing that an axis belongs to.
  std::size_t BearingOf(std::size_t axis) const;

  MotionState motion;
  std::vector<double> force;                  // per axis [N]
  std::vector<std::vector<CoilPoint>> coils;  // per bearing
  std::vector<LinearBearing> bearings;
  std::vector<LinearSensor> sensors;  // per bearing
  std::vector<std::string> notes;     // what of this rig the linear model leaves out, one line each

 private:
  /// Shared by copies: the control refers to the parameters, the plant to itself.
  struct Model {
    Model(const TrueRig& true_rig, const NominalRig& known, const std::vector<CurrentMap>& maps);
    const TrueRig rig;
    const NominalRig nominal;
    Plant plant;
    std::vector<BearingControl> control;
  };

  void PlaceCoils(std::size_t bearing);
  void NoteWhatIsLeftOut();

  std::shared_ptr<Model> model_;
};

/// Of a rig file: calibrated values in the plant, nominal ones in the controller.
OperatingPoint FindOperatingPoint(const RigParameters& rig);

}  // namespace ambrig
