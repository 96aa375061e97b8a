#pragma once
/// Records that are corrected exactly, after which the search starts again: clocks that are off,
/// and commands that are larger or smaller than their scenarios say.
#include <optional>
#include <vector>

#include "discovery/explain/explain.h"
#include "discovery/explain/nuisance_selection.h"

namespace ambrig {

/// One number for each record; empty: nothing.
struct RecordCorrections {
  std::vector<double> clocks_late;    // [s], negative: early
  std::vector<double> inputs_larger;  // share of the command's size [-]
  bool any() const { return !clocks_late.empty() || !inputs_larger.empty(); }
  /// What one search found, on top of what those before it did.
  void Add(const RecordCorrections& found);
};

/// The case with its records corrected.
Case Corrected(const Case& c, const RecordCorrections& corrections);

/// What was corrected before the last search stands in its answer too: in the sizes of its inputs,
/// else as a warning.
void ReportCorrections(const Case& c, const RecordCorrections& corrections, Explanation& e);

/// Seconds by which each record is late, from the shifts of clocks among `found`, in whole rows or
/// switching periods, whichever are shorter: then all its rows are instants that the simulation
/// has. 0 of a larger shift than MostRowsOff allows.
std::vector<double> ClocksOf(const Case& c, const std::vector<NuisanceFound>& found);

/// The same where the search has to start again for it: nothing where no clock is half a row off
/// (such a shift is small) or all are by the same number of rows, as a delay of the rig would be.
std::optional<std::vector<double>> LateClocks(const Case& c,
                                              const std::vector<NuisanceFound>& found);

/// How much larger each record's commands are than its scenario says, where the case declares their
/// size uncertain or nuisances of the records found it and the simulation with these sizes explains
/// what the slope of the prediction in `base` does not. Simulates all records once.
std::optional<std::vector<double>> LargerInputs(const SearchModels& models,
                                                const std::vector<NuisanceKind>& of_records,
                                                const FitResult& base);

}  // namespace ambrig
