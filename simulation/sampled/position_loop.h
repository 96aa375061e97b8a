#pragma once
/// The controller's clock of a rig, the same in every fidelity (base_model.md section 4):
///
///   t_n = n T, n % M == 0   the sensors are read; the position loop computes set-points from them
///   t_(n+M)                 those set-points are in force, and in a record
///   ... + loop delay        they reach the current loops (effect loop-delay)
#include <memory>
#include <vector>

#include "control/current/bearing_control.h"
#include "control/position/controller_switch.h"
#include "effects/plant.h"
#include "rig/nominal_rig.h"
#include "scenarios/scenario.h"
#include "simulation/sampled/command_plan.h"
#include "simulation/sampled/measurement_noise.h"

namespace ambrig {

class PositionLoop {
 public:
  /// `plant`, `commands` and `noise` must outlive the loop; `noisy`: readings with the sensors'
  /// noise. `nominal`: the rig as the controller's designer knows it.
  PositionLoop(const NominalRig& nominal, Plant& plant, const CommandPlan& commands,
               MeasurementNoise& noise, bool noisy);

  /// Starts with these forces per axis [N] while the readings rest at zero.
  void Hold(const std::vector<double>& force);
  /// Where the sensors see the shaft and how fast it turns, before noise and faults.
  void ReadSensors(const MotionState& s);
  /// Where the sensors see the shaft alone: may be asked at any time.
  void ReadPositions(const MotionState& s);
  /// What sensor `axis` hands over in period n [m].
  double Reading(std::size_t axis, long long n);
  /// Readings of the controller, at time t [s] of period n.
  void Sample(long long n, double t);
  /// Position loop of period n, a multiple of M; its set-points are on their way.
  void Tick(long long n, const std::vector<BearingControl>& control);
  /// This controller is in charge from the next Tick on, without a bump. Only where the
  /// scenario may change controllers.
  void TakeOver(std::unique_ptr<PositionController> controller);
  /// Set-points that are due in period n, into `set_point` and `commanded`.
  void Apply(long long n, std::vector<BearingControl>& control);

  const std::vector<double>& readings() const { return readings_; }
  double reading_time() const { return reading_time_; }
  double speed_reading() const { return speed_reading_; }
  double angle_reading() const { return angle_reading_; }
  std::size_t axes() const { return axes_.size(); }
  /// Whether the set-points of a bearing come from its current map.
  bool Mapped(std::size_t bearing) const { return controller_->SetPoints(bearing) == nullptr; }

 private:
  struct Axis {
    std::size_t bearing = 0, side = 0;
  };
  struct UnderWay {
    long long due = 0;  // period
    bool recorded = false;
    std::vector<Lane> values;
  };

  Plant& plant_;
  const CommandPlan& commands_;
  MeasurementNoise& noise_;
  bool noisy_;
  double T_;
  int M_;
  std::vector<Axis> axes_;
  std::vector<std::size_t> first_axis_;  // of each bearing, and the end
  std::unique_ptr<PositionController> controller_;
  ControllerSwitch* switch_ = nullptr;  // the same, when the scenario changes over
  std::vector<double> readings_, reference_, excitation_, force_;  // per axis
  // [s], [rad/s], [rad]
  double reading_time_ = 0, speed_reading_ = 0, angle_reading_ = 0;
  std::vector<UnderWay> under_way_;
  UnderWay spare_;  // its memory: no allocation in the loop
};

}  // namespace ambrig
