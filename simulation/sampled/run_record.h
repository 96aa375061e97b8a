#pragma once
/// The record of a run while it grows: its channels and rows, the same in every fidelity. A row
/// shows what the controller knows at the start of a period, or, in a burst, at every so many ADC
/// samples. Source: docs/guide/files.md "Record".
#include "core/record/record.h"
#include "simulation/sampled/channel_values.h"

namespace ambrig {

/// What of a run is recorded.
struct RecordedPart {
  const std::vector<std::string>& channels;  // those of them that there are; empty: all
  // Rows, rising, which are recorded besides the last one; nullptr: all. They stand one behind the
  // other, whatever the record's rate says, and must outlive it.
  const std::vector<std::size_t>* rows = nullptr;
  long long periods = 0;  // switching periods of the run from t = 0
};

class RunRecord {
 public:
  /// `rate` [Hz]; 0: the scenario's. `clamped` runs have load cells in place of
  /// true positions.
  RunRecord(const RigParameters& rig, const Scenario& scenario, double rate, bool clamped,
            const RecordedPart& part, const RowSource& source);

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
  void Row(long long n, int sample);
  /// Whether the row that is due is one of those to record.
  bool Wanted();

  ChannelValues values_;
  int samples_;                            // ADC samples per period
  int row_periods_ = 1, row_samples_ = 0;  // a row every so many periods, or every so many samples
  Record record_;
  struct Written {
    ChannelValues::Column column;
    const double* place;  // of its value; nullptr: it is computed
  };
  std::vector<Written> columns_;  // one per channel of the record
  std::size_t row_ = 0;           // the next one
  const std::vector<std::size_t>* wanted_ = nullptr;
  std::size_t due_ = 0, last_ = 0;  // of all rows: the next one and the last
};

}  // namespace ambrig
