#include "core/record/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/errors.h"
#include "core/base/parameters.h"
#include "core/base/read_file.h"
#include "core/record/column_names.h"
#include "core/record/text_cells.h"
#include "core/record/text_table.h"
#include "core/record/time_base.h"

namespace ambrig {
namespace {

void AppendNumber(std::string& text, double value) {
  if (std::isnan(value)) return;
  char buffer[32];
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

}  // namespace

Record ReadCsv(const std::string& path, const CsvOptions& options) {
  return RecordOfTable(ReadTextTable(path, ReadFile(path)), path, options);
}

Record RecordOfTable(TextTable table, const std::string& path, const CsvOptions& options) {
  Record record;
  record.channels = std::move(table.columns);
  record.notes = std::move(table.notes);
  if (!table.first_instant.empty()) record.attributes["first_instant"] = table.first_instant;
  for (Channel& c : record.channels) {
    const auto given = options.units.find(c.name);
    if (given != options.units.end()) c.unit = given->second;
  }
  const bool timed = std::any_of(record.channels.begin(), record.channels.end(),
                                 [](const Channel& c) { return IsTimeName(c.name); });
  if (!timed && options.rate == 0 && !record.channels.empty())
    throw InputError(
        path + ": neither a rate [Hz] nor a time channel, allowed: " + kTimeNames +
        "; there are: " + Utf8(ColumnsOf(record, "time")) +
        "; a table of values at rest is a [[record]] of a case with kind = \"static\"");
  record.rate = timed ? 0 : options.rate;
  record.start = timed ? 0 : options.start;
  FinishRecord(record, path, table.header_rows);
  if (options.rate != 0 && std::abs(record.rate - options.rate) > 1e-3 * options.rate)
    throw InputError(path + ": rate = " + NumberText(options.rate) + " Hz, but the times have " +
                     NumberText(record.rate) + " Hz");
  return record;
}

void WriteCsv(const Record& record, const std::string& path) {
  CheckRecord(record, "cannot write " + path);
  std::string text = "t [s]";
  for (const Channel& c : record.channels) {
    if (c.name.empty() || (c.name + c.unit).find_first_of(",;\t\n\r\"[]#") != std::string::npos)
      throw InputError("cannot write " + path + ": channel name '" + c.name + "', unit '" + c.unit +
                       "'");
    text += ',' + c.name + (c.unit.empty() ? "" : " [" + c.unit + ']');
  }
  text += '\n';
  for (std::size_t row = 0; row < record.rows(); ++row) {
    AppendNumber(text, record.TimeAt(row));
    for (const Channel& c : record.channels) {
      text += ',';
      AppendNumber(text, c.samples[row]);
    }
    text += '\n';
  }
  WriteFileAtomically(path, text);
}

}  // namespace ambrig
