#pragma once
/// Shifts of columns in time: how late columns are together, and from which instant on.
#include <string>
#include <vector>

#include "discovery/data_gate/gate_columns.h"

namespace ambrig {

inline constexpr double kLeastColumn = 1e-3;  // [s], of a single column: electronics delay too
inline constexpr double kLeastForce =
    4e-3;  // [s], of load cells: eddy currents delay forces by some ms

struct FoundShift {
  double late = 0, from = 0;  // [s], [s] after the first row
  double left = 1;            // share of the error that remains
  bool all_rows = true;       // from the record's beginning on, else rows were lost within it
};

/// The shift that leaves the least error of these columns together; `rate` of their rows [Hz].
FoundShift ShiftOf(const std::vector<const GateColumn*>& columns, double rate);

/// "lag" or "lost", with the line that mends it; `channel`: "" for all columns of the record.
DataFault TimeFault(const CaseRecord& r, const std::string& channel, const FoundShift& s);

/// Whether the error of any column is gross, also beside its movement.
bool AnyGross(const std::vector<const GateColumn*>& columns);

/// Whether the prediction comes back to itself within the shifts that are tried: then a shift may
/// be one of its periods, or the phase of a whirl.
bool RepeatsItself(const std::vector<const GateColumn*>& columns);

/// Whether columns agree with the prediction as it is rather than `late` seconds later.
bool AreOnTime(const std::vector<const GateColumn*>& columns, double late, double rate);

/// Columns that share an instrument or a converter and are late together, while all others are on
/// time: of a kind, of a bearing, of a kind at one bearing.
void FindLateGroups(const CaseRecord& r, std::vector<GateColumn>& columns,
                    std::vector<DataFault>& out);

}  // namespace ambrig
