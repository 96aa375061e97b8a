#pragma once
/// Rows of a campaign's table that are written down.
#include <map>
#include <string>

#include "campaign/row.h"

namespace ambrig::testing {

/// Row `run` with these cells by the names of their columns, without units; the others are empty.
inline Row RowOf(std::size_t run, const std::map<std::string, std::string>& cells) {
  std::vector<std::string> row;
  for (const std::string& column : RowColumns()) {
    const auto it = cells.find(column.substr(0, column.find(" [")));
    row.push_back(it == cells.end() ? "" : it->second);
  }
  row[0] = std::to_string(run);
  return RowOfCells(run, row);
}

}  // namespace ambrig::testing
