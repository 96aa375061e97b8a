#pragma once
/// The value of any channel of a running rig, the same in every fidelity: what the controller knows
/// at the start of a switching period, or at an ADC sample inside it. Source: docs/guide/files.md
/// "Record".
#include <vector>

#include "core/record/channels.h"
#include "rig/rig_assembly.h"
#include "rotor/motion/rotor_model.h"
#include "scenarios/scenario.h"
#include "simulation/sampled/measurement_noise.h"
#include "simulation/sampled/position_loop.h"
#include "simulation/sampled/sampled_bearing.h"

namespace ambrig {

/// Where the values of a row are read; must outlive the record.
struct RowSource {
  const Plant& plant;
  const MotionState& motion;
  PositionLoop& loop;
  MeasurementNoise& noise;
  const std::vector<BearingControl>& control;
  /// Of a bus that moves, its voltage [V] at each ADC sample of the last period.
  const std::vector<double>& bus_samples;
  std::vector<const SampledBearing*> bearings;
};

class ChannelValues {
 public:
  /// Where the values of one channel come from.
  struct Column {
    ChannelKind kind;
    std::size_t owner = 0;  // axis of a reading, else bearing or station
    int index = 0;          // direction or coil
    bool station = false;
  };
  struct Named {
    ChannelId id;
    Column column;
  };

  ChannelValues(const RigParameters& rig, const Scenario& scenario, const RowSource& source)
      : rig_(rig),
        scenario_(scenario),
        source_(source),
        T_(1 / rig.amplifier.switching_frequency),
        samples_(rig.samples_per_period()),
        M_(rig.periods_per_control()) {}

  /// All channels in the order of a record: readings, then per bearing the kinds of `of_bearings`,
  /// stations, speed, angle, bus.
  std::vector<Named> Columns(const std::vector<ChannelKind>& of_bearings, bool stations) const;
  /// In period n. A reading is the controller's own at its tick; `ahead`: the tick is
  /// still to come.
  double At(const Column& column, long long n, bool ahead = false) const;
  /// Where what `At` gives of a column stands during the whole run; nullptr: it has to be computed.
  const double* Place(const Column& column) const;
  /// In ADC sample `sample` of period n, which has been measured.
  double InBurst(const Column& column, long long n, int sample) const;

 private:
  double Value(const Column& column, long long n, int sample, bool burst, bool ahead) const;
  double BearingValueInBurst(const Column& column, int sample) const;
  double BusAt(int sample, bool burst) const;

  const RigParameters& rig_;
  const Scenario& scenario_;
  RowSource source_;
  double T_;         // switching period [s]
  int samples_, M_;  // ADC samples per period, periods per controller period
};

}  // namespace ambrig
