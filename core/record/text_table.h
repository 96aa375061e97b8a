#pragma once
/// Tables in text files: one line of names, with units as `[um]`, `(um)` or behind
/// ` / `, perhaps one line of units, then rows of numbers. The separator (tab, semicolon or comma)
/// is that of the line of names. Numbers have a decimal point or a decimal comma; an empty cell is
/// NaN. Lines that start with # before the names are comments.
///
/// Columns of dates, times of day or both become one column `t` [s] from the first row on.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/record/record.h"

namespace ambrig {

struct TextTable {
  std::vector<Channel> columns = {};
  std::size_t header_rows = 0;     // lines of the file before the first row
  std::string first_instant = {};  // of the columns of dates, as it stands in the file
  std::vector<std::string> notes = {};
};

/// `path` is for messages. @throws InputError "PATH:LINE:COLUMN: ..."
TextTable ReadTextTable(const std::string& path, std::string_view text);

/// A column's name and unit from its head: "pos_ax (um)" is "pos_ax" in um. Round brackets and
/// ` / ` hold a unit only when it is one; an unclosed '[' leaves `unit_closed` false.
struct ColumnHead {
  std::string name, unit;
  bool unit_closed = true;
};
ColumnHead ParseHead(std::string_view head);

}  // namespace ambrig
