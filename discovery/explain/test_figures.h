#pragma once
/// The errors of the records of the test, which no fit and no choice of the search has seen: looked
/// at once, at the end.
#include "discovery/explain/explain.h"

namespace ambrig {

/// Puts them into the closure of a finished explanation of `c`: before and after what was found,
/// over noise floors of the noise that the search used. Nuisances of kinds that the search used are
/// taken off these records too. Where the records are wrong, or no model holds their rotor, a
/// warning says so. Nothing changes without such records.
void AddTestFigures(const Case& c, const ExplainOptions& options, Explanation& e);

}  // namespace ambrig
