#pragma once
/// Single wrong samples: a logger's or a converter's glitch. They are too few to stop a search:
/// their rows are left out and told. What cannot be at all is a fault of the data (CheckSpikes).
#include <string>
#include <vector>

#include "discovery/model/case_model.h"

namespace ambrig {

struct LonelyRow {
  std::size_t record = 0, channel = 0;  // into case.records[].data.channels
  std::size_t sample = 0;
};

/// Samples of any predicted channel that stand apart from the two on either side by far more than
/// the channel's noise, in the data and in what `predicted` leaves of them, where nothing is
/// expected to come and go within one row, no other column stands apart, and which are few in their
/// column. `model` holds all rows.
std::vector<LonelyRow> LonelyRowsOf(const CaseModel& model, const std::vector<double>& predicted);

/// For CaseModel::LeaveOut.
std::vector<SampleSpan> SpansOf(const std::vector<LonelyRow>& rows);

/// One line for each column: "record-3.h5: A.fx: 2 samples stand alone (first at 0.1234 s), left
/// out".
std::vector<std::string> LonelyRemarks(const Case& c, const std::vector<LonelyRow>& rows);

}  // namespace ambrig
