#pragma once
/// One line of a campaign's table: a run's conditions, then what came out. Text is CSV; numbers
/// are the shortest that read back as the same double, so equal results are equal bytes.
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "campaign/run_plan.h"

namespace ambrig {

/// Header of the table; the order of Row's values.
const std::vector<std::string>& RowColumns();

/// The text without what ends a cell of the table: commas, quotes, tabs, ends of lines become
/// blanks.
std::string OneCell(std::string text);

/// Kept as its line, which takes a tenth of the memory of its cells: a campaign may have 10^5 rows.
struct Row {
  std::size_t run = 0;
  std::string csv;  // cells as in RowColumns(), the first is the run

  std::vector<std::string_view> Cells() const;  // valid as long as the row
  /// @throws std::logic_error for an unknown column, InputError when the row is not a campaign's.
  std::string At(std::string_view column) const;
  double Number(std::string_view column) const;  // nan for an empty cell
};
Row RowOfCells(std::size_t run, const std::vector<std::string>& cells);

/// @throws InputError when the text has no run number.
Row ParseRow(std::string_view csv, const std::string& where);
/// What the readers of a campaign's table count on: all cells, numbers where numbers stand, none
/// missing that every run has. @throws InputError
void CheckRow(const Row& row, const std::string& where);
/// The check of the rows of one kind of table; `where` begins its complaint.
using RowCheck = std::function<void(const Row& row, const std::string& where)>;

/// Simulates a run (fast engine, detection and redistribution on). A run that the program cannot
/// finish is a row too: verdict "error", the reason in `note`. @throws Interrupted
Row SimulateRow(const RunPlan& plan, std::size_t run, const std::atomic<bool>* stop);

/// "A:1+3", "A:healthy".
std::string SetText(const FailureSet& set);

}  // namespace ambrig
