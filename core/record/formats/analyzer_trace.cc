/// ASCII traces of Stanford Research SR780 and SR785 (manual, "Load Trace Data
/// (ASCII)"): the number N of points, then N lines `real, imaginary`. The frequencies are not
/// in the file.
#include <charconv>

#include "core/base/errors.h"
#include "core/base/read_file.h"
#include "core/record/formats/format.h"
#include "core/record/text_cells.h"

namespace ambrig {

namespace {

/// The number of points in the first line; 0 when it holds anything else.
std::size_t Points(std::string_view line) {
  const std::string_view text = Trim(line);
  std::size_t n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  return error == std::errc() && end == text.data() + text.size() ? n : 0;
}

/// "0.000, 0.500"; a decimal comma cannot stand beside a comma that separates.
bool Pair(std::string_view line, std::complex<double>& value) {
  Cells cells(line, line.find('\t') == std::string_view::npos ? ',' : '\t');
  double parts[2] = {};
  for (double& part : parts)
    if (!cells.Next() || !ToNumber(cells.cell(), part)) return false;
  value = {parts[0], parts[1]};
  return !cells.Next();
}

bool IsAnalyzerTrace(std::string_view begin) {
  Lines lines(begin);
  if (!lines.Next() || Points(lines.line()) == 0 || !lines.Next()) return false;
  std::complex<double> ignored;
  return Pair(lines.line(), ignored);
}

Measurement ReadAnalyzerTrace(const std::string& path) {
  const std::string text = ReadFile(path);
  Lines lines(text);
  lines.Next();
  const std::size_t points = Points(lines.line());
  MeasuredResponse trace{"trace", "", {}};
  while (lines.Next()) {
    if (Trim(lines.line()).empty()) continue;
    std::complex<double> value;
    if (!Pair(lines.line(), value))
      throw InputError(path + ':' + std::to_string(lines.number()) + ": '" +
                       Utf8(Trim(lines.line()).substr(0, 60)) + "', expected: real, imaginary");
    trace.values.push_back(value);
  }
  if (trace.values.size() != points)
    throw InputError(path + ": " + std::to_string(trace.values.size()) +
                     " points, the first line says " + std::to_string(points));
  Measurement out;
  out.frequency.responses.push_back(std::move(trace));
  out.record.notes.push_back(path + ": a trace without its frequencies");
  return out;
}

}  // namespace

RecordFormat AnalyzerTrace() { return {"SR785 trace", "", IsAnalyzerTrace, ReadAnalyzerTrace}; }

}  // namespace ambrig
