#pragma once
/// The record of a run while it grows: its channels and rows, the same in every fidelity. A row
/// shows what the controller knows at the start of a period, or, in a burst, at every so many ADC
/// samples. Source: docs/guide/files.md "Record".
#include <string>
#include <vector>

#include "core/record/channels.h"
#include "faulttolerance/supervision/supervisor.h"
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
  std::vector<const SampledBearing*> bearings;
};

class RunRecord {
 public:
  /// `rate` [Hz]; 0: the scenario's. `clamped` runs have load cells in place of true positions.
  RunRecord(const RigParameters& rig, const Scenario& scenario, double rate, bool clamped,
            const RowSource& source);

  /// The row of period n, if one is due at its start.
  void AtPeriodStart(long long n) {
    if (n >= 0 && row_samples_ == 0 && n % row_periods_ == 0) Row(n, 0);
  }
  /// The rows inside period n, which has been measured (bursts only).
  void AfterMeasurement(long long n) {
    for (int k = 0; n >= 0 && row_samples_ > 0 && k < samples_; k += row_samples_) Row(n, k);
  }
  Record Take();

 private:
  /// Where the values of one channel come from.
  struct Column {
    ChannelKind kind;
    std::size_t owner = 0;  // axis of a reading, else bearing or station
    int index = 0;          // direction or coil
    bool station = false;
  };

  void AddChannels(std::size_t rows);
  void Add(const std::vector<ChannelId>& channels, Column column, std::size_t rows);
  void Row(long long n, int sample);
  double Value(const Column& column, long long n, int sample) const;
  double BearingValue(const Column& column, int sample) const;

  const RigParameters& rig_;
  const Scenario& scenario_;
  RowSource source_;
  bool clamped_;
  double T_;                               // switching period [s]
  int samples_, M_;                        // ADC samples per period, periods per controller period
  int row_periods_ = 1, row_samples_ = 0;  // a row every so many periods, or every so many samples
  Record record_;
  std::vector<Column> columns_;  // one per channel of the record
  std::size_t row_ = 0;          // the next one
};

}  // namespace ambrig
