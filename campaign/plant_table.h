#pragma once
/// What a campaign over plants ([plants] of its file) says of detection and fault tolerance: per
/// effect and size, per kind of fault, counted by plant, with and without commissioning.
#include <string>

#include "campaign/journal.h"

namespace ambrig {

/// Upper end of the one-sided 95 % interval of a probability of which `hits` of `trials` were seen
/// (Clopper and Pearson); about 3/n where none was. 1 without trials.
double UpperBound95(std::size_t hits, std::size_t trials);

/// Tables in Markdown, one for plants that were commissioned and one for those that were not. Empty
/// when the rows are of no plants.
std::string PlantTables(const Rows& rows);

/// FOLDER/plants.md. Nothing is written when the rows are of no plants. @throws InputError
bool WritePlantTables(const std::string& folder, const Rows& rows);

}  // namespace ambrig
