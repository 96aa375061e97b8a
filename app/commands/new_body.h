#pragma once
/// Whether the body of a record hovers, and whether the record holds all that drove its coils.
#include <vector>

#include "app/commands/new_columns.h"

namespace ambrig {

/// What the user says of the body: nothing, that it hovers, or that something holds it.
enum class BodySaid { kNothing, kFree, kHeld };

/// Mean force that the nominal magnets make of the measured currents where the body was measured,
/// over the weight: near one for a body that nothing but the magnets holds. NaN without a weight,
/// or without currents and positions.
double CarriedShare(const RigParameters& rig, const Record& record,
                    const std::vector<ColumnChoice>& all);

/// Whether nothing but the magnets carries the body: as said, else by its weight. What was taken
/// for what is printed; in doubt the body is none that hovers.
bool IsFree(const RigParameters& rig, const Record& record, const std::vector<ColumnChoice>& all,
            BodySaid said);

/// Whether commands that change from row to row were logged more slowly than the controller gives
/// them. Printed, and also where a current loop may have given more of them than the controller.
bool LacksCommands(const RigParameters& rig, const Record& record,
                   const std::vector<ColumnChoice>& all);

}  // namespace ambrig
