/// Text tables: records over time, or frequency responses.
#include <algorithm>

#include "core/base/read_file.h"
#include "core/record/csv.h"
#include "core/record/formats/format.h"
#include "core/record/frequency_table.h"
#include "core/record/text_table.h"

namespace ambrig {

namespace {

bool LooksLikeCsv(std::string_view begin) {
  // Bytes from 128 on are UTF-8 or Latin-1.
  const auto is_text = [](char c) {
    return static_cast<unsigned char>(c) >= 32 || c == '\t' || c == '\n' || c == '\r';
  };
  return !begin.empty() && std::all_of(begin.begin(), begin.end(), is_text) &&
         begin.find_first_of(",;\t") != std::string_view::npos;
}

Measurement ReadCsvFile(const std::string& path) {
  TextTable table = ReadTextTable(path, ReadFile(path));
  if (IsFrequencyTable(table)) return ResponsesOfTable(table, path);
  return {RecordOfTable(std::move(table), path), {}};
}

}  // namespace

RecordFormat CsvFormat() { return {"CSV", ".csv .txt .tsv", LooksLikeCsv, ReadCsvFile}; }

}  // namespace ambrig
