#pragma once
/// Journals of shards put together by run, and what a table says in a few numbers.
#include <map>
#include <string>

#include "campaign/journal.h"

namespace ambrig {

/// @throws InputError when the folders are of different campaigns, two rows of one run differ, or
/// runs are missing and `partial` is false.
JournalContent MergeJournals(const std::vector<std::string>& folders, bool partial);

struct RowCounts {
  std::size_t rows = 0, up = 0, touchdown = 0, drop = 0, error = 0;
  // single faults of all runs, those before the rotor was lost
  std::size_t faults = 0, undetected = 0, wrong_class = 0;
  std::map<std::string, std::size_t> reasons;  // of runs that touched down or dropped
  double false_alarms = 0, coil_periods = 0;
  double worst_delay = 0;    // [s]
  double largest_orbit = 0;  // of the runs that stayed up [m]
};
RowCounts CountRows(const Rows& rows);

}  // namespace ambrig
