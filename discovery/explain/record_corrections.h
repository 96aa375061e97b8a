#pragma once
/// Records that are corrected exactly, after which the search starts again: clocks that are whole
/// rows off, and commands that are larger or smaller than their scenarios say.
#include <optional>
#include <vector>

#include "discovery/explain/explain.h"
#include "discovery/explain/nuisance_selection.h"

namespace ambrig {

/// One number for each record; empty: nothing.
struct RecordCorrections {
  std::vector<int> rows_late;         // negative: early
  std::vector<double> inputs_larger;  // share of the command's size [-]
  bool any() const { return !rows_late.empty() || !inputs_larger.empty(); }
  /// What one search found, on top of what those before it did.
  void Add(const RecordCorrections& found);
};

/// The case with its records corrected.
Case Corrected(const Case& c, const RecordCorrections& corrections);

/// What was corrected before the last search stands in its answer too: in the sizes of its inputs,
/// else as a warning.
void ReportCorrections(const Case& c, const RecordCorrections& corrections, Explanation& e);

/// Rows by which each record is late, from the shifts of clocks among `found` (a shift of whole
/// rows is no small one): by at most four, and not all by the same, as a delay of the rig would be.
std::optional<std::vector<int>> LateRows(const Case& c, const std::vector<NuisanceFound>& found);

/// How much larger each record's commands are than its scenario says, where the case declares their
/// size uncertain or nuisances of the records found it and the simulation with these sizes explains
/// what the slope of the prediction in `base` does not. Simulates all records once.
std::optional<std::vector<double>> LargerInputs(const SearchModels& models,
                                                const std::vector<NuisanceKind>& of_records,
                                                const FitResult& base);

}  // namespace ambrig
