#pragma once
/// What fault detection is given of every bearing in each switching period, from measurements and the
/// nominal rig alone: samples, duties, mean bus, and shaft positions that the sensors tell.
#include "fdd/bearing_detector.h"
#include "fdd/position_monitor.h"
#include "scenarios/rig_file.h"
#include "scenarios/supervisor.h"

namespace ambrig {

/// Nominal circuit of a bearing.
LinkageModel LinkageModelOf(const BearingParameters& b);
/// Sampling, noise and tolerances as the rig file gives them; `rig` must outlive them.
DetectorSettings DetectorSettingsOf(const RigParameters& rig, const BearingParameters& b, const LinkageModel& m);

class DetectionFeed {
 public:
  /// `nominal` must outlive it.
  explicit DetectionFeed(const RigParameters& nominal);

  /// A new period; then Period(k) of every bearing.
  void Read(const PeriodMeasurement& m);
  /// Without its position a bearing's inductances are not known: nothing is comparable then.
  MeasuredPeriod Period(std::size_t bearing, const PeriodMeasurement& m) const;

  /// Name of the axis whose reading became faulty with the last Read; empty: none.
  std::string TakeFaultyAxis();

 private:
  struct View {
    const BearingParameters* bearing = nullptr;
    std::size_t first_axis = 0;
    std::vector<double> weights;  // of the sensor planes, radial
  };
  bool Uses(const View& v, std::size_t axis) const;
  void Position(const View& v, double t, double* x, double* y) const;

  const RigParameters& rig_;
  double T_ = 0, bus_ = 0, last_bus_ = 0;  // [s], [V]
  std::vector<std::string> axis_names_;
  std::vector<SensedPlane> planes_;
  std::vector<View> views_;
  PositionMonitor positions_;
};

}  // namespace ambrig
