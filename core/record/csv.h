#pragma once
/// Records as text: a header such as `t [s],A.x [um],bus` and one row per sample, in any of the
/// spellings of text_table.h.
#include <map>
#include <string>

#include "core/record/record.h"
#include "core/record/text_table.h"

namespace ambrig {

struct CsvOptions {
  std::map<std::string, std::string> units = {};  // column -> unit, instead of the header's
  double rate = 0;                                // [Hz], of a file without a column t or time
  double start = 0;                               // [s]
};

/// Units as in the file (core/record/units.h converts).
/// @throws InputError "FILE:LINE:COLUMN: ..." for what is no number, "FILE: row N: ..." for a time
/// that is not uniform (rows are lines of the file).
Record ReadCsv(const std::string& path, const CsvOptions& options = {});

/// The same of a table that was read already.
Record RecordOfTable(TextTable table, const std::string& path, const CsvOptions& options = {});

/// Shortest text of each number that reads back as the same double. Attributes are not written.
/// @throws InputError
void WriteCsv(const Record& record, const std::string& path);

}  // namespace ambrig
