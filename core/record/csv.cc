#include "core/record/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "core/base/atomic_file.h"
#include "core/base/errors.h"
#include "core/base/parameters.h"
#include "core/base/read_file.h"
#include "core/record/time_base.h"

namespace ambrig {
namespace {

std::string_view Trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::string_view Unquote(std::string_view text) {
  const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return quoted ? Trim(text.substr(1, text.size() - 2)) : text;
}

char Separator(std::string_view header) {
  for (char c : {'\t', ';'})
    if (header.find(c) != std::string_view::npos) return c;
  return ',';
}

/// Lines of a text with their numbers; the last may lack its end.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  bool Next() {
    if (rest_.empty()) return false;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    return true;
  }
  std::string_view line() const { return line_; }
  std::size_t number() const { return number_; }

 private:
  std::string_view rest_, line_;
  std::size_t number_ = 0;
};

/// One after the other the cells of a line, with the column [characters] where each begins.
class Cells {
 public:
  Cells(std::string_view line, char separator) : line_(line), separator_(separator) {}

  bool Next() {
    if (next_ > line_.size()) return false;
    begin_ = next_;
    const std::size_t end = std::min(line_.find(separator_, begin_), line_.size());
    cell_ = line_.substr(begin_, end - begin_);
    next_ = end + 1;
    return true;
  }
  std::string_view cell() const { return cell_; }
  std::size_t column() const {
    const std::size_t blanks = cell_.find_first_not_of(" \t\r");
    return begin_ + 1 + (blanks == std::string_view::npos ? 0 : blanks);
  }

 private:
  std::string_view line_, cell_;
  char separator_;
  std::size_t begin_ = 0, next_ = 0;
};

class CsvReader {
 public:
  CsvReader(const std::string& path, const CsvOptions& options) : path_(path), options_(options) {}

  Record Read() {
    std::string text = ReadFile(path_);
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);  // byte order mark
    Lines lines(text);
    std::string_view header;
    while (header.empty() && lines.Next())
      if (!lines.line().starts_with('#')) header = Trim(lines.line());
    if (header.empty()) throw InputError(path_ + ": no header, expected e.g. t [s],A.x [um]");
    const std::size_t header_row = lines.number();
    ReadHeader(lines.line(), header_row);
    std::size_t blank = 0;
    while (lines.Next()) {
      if (Trim(lines.line()).empty() && record_.channels.size() > 1) {
        blank = lines.number();
        continue;
      }
      // Skipping a row would shift all that follow; only the end may be blank.
      if (blank != 0) Fail(blank, 1, "blank line between rows");
      ReadRow(lines.line(), lines.number());
    }
    Finish(header_row);
    return std::move(record_);
  }

 private:
  [[noreturn]] void Fail(std::size_t line, std::size_t column, const std::string& what) const {
    throw InputError(path_ + ':' + std::to_string(line) + ':' + std::to_string(column) + ": " +
                     what);
  }

  void ReadHeader(std::string_view header, std::size_t line) {
    separator_ = Separator(header);
    for (Cells cells(header, separator_); cells.Next();) {
      const std::string_view cell = Unquote(Trim(cells.cell()));
      const std::size_t bracket = std::min(cell.find('['), cell.size());
      const std::string name(Trim(cell.substr(0, bracket)));
      if (name.empty()) Fail(line, cells.column(), "column without a name");
      if (IsNumber(cell)) Fail(line, cells.column(), "header expected, e.g. t [s],A.x [um]");
      std::string unit;
      if (bracket < cell.size()) {
        if (cell.back() != ']')
          Fail(line, cells.column(), "']' expected after the unit of " + name);
        unit = Trim(cell.substr(bracket + 1, cell.size() - bracket - 2));
      }
      const auto given = options_.units.find(name);
      if (given != options_.units.end()) unit = given->second;
      record_.channels.push_back({name, unit, {}});
    }
  }

  void ReadRow(std::string_view line, std::size_t number) {
    std::size_t k = 0;
    for (Cells cells(line, separator_); cells.Next(); ++k) {
      if (k == record_.channels.size())
        Fail(number, cells.column(), "more cells than the header's " + std::to_string(k));
      Channel& channel = record_.channels[k];
      double value = 0;
      if (!ParseNumber(Unquote(Trim(cells.cell())), value))
        Fail(number, cells.column(),
             channel.name + ": '" + std::string(Trim(cells.cell())) + "' is not a number");
      channel.samples.push_back(value);
    }
    if (k < record_.channels.size())
      Fail(number, line.size() + 1,
           std::to_string(k) + " cells, header has " + std::to_string(record_.channels.size()));
  }

  bool ParseNumber(std::string_view cell, double& value) const {
    if (cell.empty()) {
      value = std::numeric_limits<double>::quiet_NaN();
      return true;
    }
    if (separator_ == ',' || cell.find(',') == std::string_view::npos) return ToDouble(cell, value);
    std::string point(cell);  // decimal comma
    point[point.find(',')] = '.';
    return ToDouble(point, value);
  }

  static bool ToDouble(std::string_view cell, double& value) {
    if (cell.starts_with('+')) cell.remove_prefix(1);
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    return error == std::errc() && end == cell.data() + cell.size();
  }

  static bool IsNumber(std::string_view cell) {
    double ignored = 0;
    return ToDouble(cell, ignored);
  }

  void Finish(std::size_t header_row) {
    const bool timed = std::any_of(record_.channels.begin(), record_.channels.end(),
                                   [](const Channel& c) { return IsTimeName(c.name); });
    record_.rate = timed ? 0 : options_.rate;
    record_.start = timed ? 0 : options_.start;
    FinishRecord(record_, path_, header_row);
    if (options_.rate != 0 && std::abs(record_.rate - options_.rate) > 1e-3 * options_.rate)
      throw InputError(path_ + ": rate = " + NumberText(options_.rate) +
                       " Hz, but the times have " + NumberText(record_.rate) + " Hz");
  }

  const std::string& path_;
  const CsvOptions& options_;
  char separator_ = ',';
  Record record_;
};

void AppendNumber(std::string& text, double value) {
  if (std::isnan(value)) return;
  char buffer[32];
  text.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

}  // namespace

Record ReadCsv(const std::string& path, const CsvOptions& options) {
  return CsvReader(path, options).Read();
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
