#pragma once
/// Which column of a measured file is which channel of a rig, as far as their names and units say.
#include <string>
#include <vector>

#include "core/record/record.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

struct ColumnChoice {
  std::string channel, column;
  std::string unit;    // of the column; empty: SI
  double gain = 1;     // beside the unit
  double offset = 0;   // behind both [SI]
  std::string reason;  // "same name", "name and unit", "said"
};

/// At most one column for each reading, current, set-point, duty, load cell and the bus. A column
/// that fits two channels equally is left out.
std::vector<ColumnChoice> ChooseColumns(const RigParameters& rig, const Record& record);

/// "A.x=pos_ax", "A.x=pos_ax:um", "A.x=pos_ax:um:-1", "A.x=pos_ax:um:-1:0.01": what the user says
/// (column, unit, gain, offset in SI), in place of a choice.
/// @throws InputError
void SayColumn(const std::string& text, const RigParameters& rig, const Record& record,
               std::vector<ColumnChoice>& choices);

}  // namespace ambrig
