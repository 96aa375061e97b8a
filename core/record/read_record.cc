#include "core/record/read_record.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/base/errors.h"
#include "core/base/inputs_read.h"
#include "core/base/read_file.h"
#include "core/record/formats/format.h"
#include "core/record/text_cells.h"

namespace ambrig {
namespace {

/// Files of instruments that cannot be read, by how they begin, and the way round.
struct Foreign {
  std::string_view begin, what;
};
constexpr Foreign kForeign[] = {
    {"MDF     ", "an MDF file (MF4); export it as CSV or MAT, e.g. asammdf -> export mat"},
    {"UnFinMF ", "an MDF file that was not finished; finish it and export it as CSV or MAT"},
    {"PAR1", "a Parquet file; export it as CSV, e.g. pandas.read_parquet(...).to_csv(...)"},
    {"TDSh", "the index of a TDMS file; the data are in the file .tdms beside it"},
    {"PK\x03\x04", "a ZIP archive or spreadsheet; unpack it or save the sheet as CSV"},
    {"\x1f\x8b", "compressed with gzip; unpack it (gunzip)"},
    {"\xff\xfe", "UTF-16 text; save it as UTF-8"},
    {"\xfe\xff", "UTF-16 text; save it as UTF-8"},
};

bool HasExtension(const RecordFormat& format, const std::string& extension) {
  for (Cells words(format.extensions, ' '); words.Next();)
    if (!extension.empty() && words.cell() == extension) return true;
  return false;
}

const RecordFormat& FormatOf(const std::string& path) {
  const std::string begin = ReadFile(path, kRecognised);
  for (const RecordFormat& f : RecordFormats())
    if (f.recognises(begin)) return f;
  for (const Foreign& f : kForeign)
    if (begin.starts_with(f.begin)) throw InputError(path + ": is " + std::string(f.what));
  const std::string extension = LowerCase(std::filesystem::path(path).extension().string());
  std::string allowed;
  for (const RecordFormat& f : RecordFormats()) {
    if (HasExtension(f, extension)) return f;
    allowed += (allowed.empty() ? "" : ", ") + std::string(f.name) +
               (f.extensions.empty() ? "" : " (" + std::string(f.extensions) + ")");
  }
  throw InputError(path + ": unknown kind of file, allowed " + allowed);
}

}  // namespace

Measurement ReadMeasurement(const std::string& path, std::string* format) {
  const RecordFormat& f = FormatOf(path);
  NoteInput(path);
  if (format != nullptr) *format = f.name;
  return f.read(path);
}

Record ReadRecord(const std::string& path) {
  std::string format;
  Measurement m = ReadMeasurement(path, &format);
  const FrequencyResponses& f = m.frequency;
  if (m.record.channels.empty()) {
    const std::string axis =
        f.frequency.empty()
            ? ""
            : fmt::format(" from {:.6g} to {:.6g} Hz", f.frequency.front(), f.frequency.back());
    throw InputError(
        fmt::format("{}: holds frequency responses ({}, {} points{}), allowed here: a "
                    "record over time",
                    path, f.responses.size(), f.points(), axis));
  }
  if (!f.responses.empty())
    m.record.notes.push_back(path + ": " + std::to_string(f.responses.size()) +
                             " frequency responses, left out");
  return std::move(m.record);
}

}  // namespace ambrig
