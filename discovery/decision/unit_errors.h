#pragma once
/// What the coils of a machine differ by although the rig file draws them alike: it states the size of these errors
/// (amplifier.current_gain_spread, amplifier.edge_spread), not what each coil has. They are no effect to be named.
#include <vector>

#include "discovery/model/model.h"

namespace ambrig {

/// Errors over the noise of machines of one type, each compared with the drawing: the largest of some that are drawn.
struct UnitErrors {
  double largest = 1;  // of all fitted records, or of all unseen ones
  // of each target, by any channel of its kind in its record; empty where the rig file states no spread
  std::vector<double> most;
};

UnitErrors ErrorsOfUnits(const CaseModel& model, const Hypothesis& h);

/// Whether another unit of this type would leave a residual as large as this one, in every channel of every record.
bool IsWithinUnits(const CaseModel& model, const std::vector<double>& residual,
                   const UnitErrors& of_units);

}  // namespace ambrig
