#pragma once
/// Records whose clock was found off.
#include <vector>

#include "discovery/case/case.h"

namespace ambrig {

/// By which the clock of a record or of its input may be off [rows], [s] and be set right,
/// whichever is more. A larger shift is an error of the data.
inline constexpr long kMostRowsOff = 4;
inline constexpr double kMostClockOff = 5e-4;
/// The same in rows at this rate [Hz].
long MostRowsOff(double rate);

/// The case with every record's clock set back by `late` [s], one number for each record (negative:
/// it is early). Its rows are moved by whole ones, and what is left of a row becomes the start of
/// the record. Rows for which no measured one is left are missing (NaN) and do not count.
Case WithClocks(const Case& c, const std::vector<double>& late);

}  // namespace ambrig
