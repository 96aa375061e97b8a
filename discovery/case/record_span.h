#pragma once
/// Which rows of a record belong to its scenario and count.
#include <string>
#include <vector>

#include "core/base/toml.h"
#include "discovery/case/case.h"

namespace ambrig {

/// Cuts off rows before the scenario begins and behind its end, as loggers with a trigger write
/// them. A note tells it where no offset of the clock was stated; `r.behind` is set where a record
/// is so much longer that another scenario may have made it.
void CutToScenario(CaseRecord& r, std::vector<std::string>& notes);

/// Rows of `r.gaps`.
std::size_t EmptyRows(const CaseRecord& r);

/// Rows of these times [s] get no numbers (nan); `r.gaps` become the blocks of lost rows that are
/// not among them.
/// @throws InputError for a span without two ends.
void LeaveOutSpans(CaseRecord& r, const std::vector<std::vector<double>>& spans,
                   const TomlTable& t);

}  // namespace ambrig
