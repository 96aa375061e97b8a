#pragma once
/// Effect against fault, from the rows of a campaign over plants: at which size of an effect the
/// detection of a fault breaks, the share of the faults that is found and how late, and what fault
/// tolerance does to healthy plants with this effect.
#include <string>

#include "campaign/journal.h"

namespace ambrig {

/// Tables in Markdown: one of faults and one of healthy plants, of the commissioned plants, then
/// the same of those that were not. Empty when the rows are of no plants.
std::string PlantMatrix(const Rows& rows);

}  // namespace ambrig
