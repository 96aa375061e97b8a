#pragma once
/// What a campaign over plants ([plants] of its file) says of detection and fault tolerance: per
/// effect and size, per kind of fault, counted by plant, with and without commissioning.
#include <string>

#include "campaign/journal.h"

namespace ambrig {

/// Tables in Markdown, one for plants that were commissioned and one for those that were not. Empty
/// when the rows are of no plants.
std::string PlantTables(const Rows& rows);

/// FOLDER/plants.md and FOLDER/matrix.md (plant_matrix.h). Nothing is written when the rows are of
/// no plants. @throws InputError
bool WritePlantTables(const std::string& folder, const Rows& rows);

}  // namespace ambrig
