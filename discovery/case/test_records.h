#pragma once
/// Records of the test (use = "test"): no fit and no choice of a search sees them.
#include <optional>

#include "discovery/case/case.h"

namespace ambrig {

/// The case as a search may see it, without its records of the test; nothing where it has none.
std::optional<Case> WithoutTestRecords(const Case& c);

/// Those alone; nothing where the case has none.
std::optional<Case> TestRecordsOf(const Case& c);

/// Whether some record is kept from the fits for the choices of a search.
bool AnyValidates(const Case& c);

}  // namespace ambrig
