#pragma once
/// An error that unseen records alone show: a coast-down that was kept for validation is the only
/// record of a free shaft, say. No fitted record tells what makes it.
#include <optional>

#include "discovery/explain/explain.h"

namespace ambrig {

/// Number of the unseen record that shows most of an error which no fitted record shows, by the
/// answer `e` of the case; nothing where there is none.
std::optional<std::size_t> OnlyUnseen(const Case& c, const Explanation& e);

/// The case with this record among those that are fitted.
Case WithFitted(const Case& c, std::size_t record);

/// `before`, or `again` (the answer of WithFitted) if that explains all records to the noise; the
/// answer says which record no longer confirms it.
Explanation TheBetter(const Case& c, std::size_t record, Explanation before, Explanation again);

}  // namespace ambrig
