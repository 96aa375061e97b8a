#pragma once
/// What fault detection is given of every bearing in each switching period, from measurements and
/// the nominal rig alone: samples, duties, mean bus, and shaft positions that the sensors tell.
///
/// Between readings a free shaft follows their parabola. One that is within a step of an auxiliary
/// bearing may be thrown back at any instant: then its velocity is known within twice its speed
/// only, and for as long as the parabola holds readings from before. How far the last readings
/// departed from the parabola counts too.
#include "control/measurements.h"
#include "fdd/detectors/run_detector.h"
#include "fdd/measurement/position_monitor.h"
#include "rig/nominal_rig.h"

namespace ambrig {

/// Nominal circuit of a bearing.
LinkageModel LinkageModelOf(const BearingParameters& b);
/// Sampling, noise and tolerances as the rig file gives them; `rig` or a copy of it must outlive
/// them.
DetectorSettings DetectorSettingsOf(const NominalRig& rig, const BearingParameters& b,
                                    const LinkageModel& m);

/// All that a detector of a run is told of the bearing beforehand; `rig` must outlive it.
RunDetectorSetup RunDetectorSetupOf(const NominalRig& rig, const BearingParameters& b);

class DetectionFeed {
 public:
  explicit DetectionFeed(const NominalRig& nominal);

  /// A new period; then Period(k) of every bearing.
  void Read(const PeriodMeasurement& m);
  /// Without its position a bearing's inductances are not known: nothing is comparable then,
  /// nor while the bus is below half of its nominal voltage.
  MeasuredPeriod Period(std::size_t bearing, const PeriodMeasurement& m) const;

  /// Names of the axes whose readings became faulty since the last call.
  std::vector<std::string> TakeFaultyAxes();

 private:
  struct View {
    const BearingParameters* bearing = nullptr;
    std::size_t first_axis = 0, end_axis = 0;
    std::size_t group = 0;  // of `impacts_`
    // of the sensor planes, radial: at the bearing, at its stop
    std::vector<double> weights, auxiliary_weights;
    MotionUncertainty uncertainty;  // until the next reading
  };
  bool Uses(const View& v, std::size_t axis) const;
  /// After a reading: whether the shaft may strike an auxiliary bearing before the next one, or has
  /// just done so, and what is not known of its motion then.
  void WatchImpacts();
  /// Of the bearing, or of its stop, from what `of` says of every axis.
  template <class Of>
  void Place(const View& v, const std::vector<double>& weights, const Of& of, double* x,
             double* y) const;

  const NominalRig rig_;
  double T_ = 0, bus_ = 0, last_bus_ = 0;  // [s], [V]
  std::vector<std::string> axis_names_;
  std::vector<SensedPlane> planes_;
  std::vector<View> views_;
  PositionMonitor positions_;
  /// Radial planes shake each other, the axial stops only the thrust bearing.
  struct Impacts {
    int readings_since = 1000;  // that the shaft was within reach
    double travel = 0;          // largest of any plane between two of the last readings [m]
  };
  Impacts impacts_[2];
  // what the parabolas say of every axis at the period's ends [m]
  std::vector<double> start_, end_;
  bool sensed_ = false;         // they hold
  std::vector<double> struck_;  // by how much impacts may throw each axis off its parabola [m]
};

}  // namespace ambrig
