/// LabVIEW Measurement Files (.lvm; "Specification for the LabVIEW Measurement File", National
/// Instruments): a head of the file, then segments, each with a head of its own that ends with
/// ***End_of_Header***, a line of names and rows of numbers.
///
/// The separator and the decimal separator are those of the head; a decimal comma is understood
/// beside a tab whatever it says. Segments that follow each other in time become one record.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "core/base/errors.h"
#include "core/base/parameters.h"
#include "core/base/read_file.h"
#include "core/record/date_time.h"
#include "core/record/formats/format.h"
#include "core/record/text_cells.h"
#include "core/record/time_base.h"
#include "core/record/time_groups.h"

namespace ambrig {

namespace {

constexpr std::string_view kEndOfHeader = "***End_of_Header***";
constexpr int kDeltaDigits = 6;  // of Delta_X

/// One channel of one segment.
struct Piece {
  std::string name, unit;
  double x0 = 0, step = 0;               // [s] of Delta_X; 0: not stated
  std::optional<DateTime> instant = {};  // of its date and time
  std::vector<double> x = {}, y = {};    // x: only where the file has a column of it
  bool over_time = true;                 // X_Dimension
};

class LvmReader {
 public:
  LvmReader(const std::string& path, std::string_view text) : path_(path), lines_(text) {}

  std::vector<std::vector<Piece>> Read() {
    ReadFileHead();
    std::vector<std::vector<Piece>> segments;
    while (lines_.Next()) {
      if (Blank()) continue;
      segments.push_back(ReadSegment());
    }
    if (segments.empty()) throw InputError(path_ + ": no segment of data behind the head");
    return segments;
  }

 private:
  [[noreturn]] void Fail(const std::string& what) const {
    throw InputError(path_ + ':' + std::to_string(lines_.number()) + ": " + what);
  }

  bool Blank() const { return lines_.line().find_first_not_of(" \t\r,;") == std::string::npos; }

  std::vector<std::string> Row() const {
    std::vector<std::string> out;
    for (Cells cells(lines_.line(), separator_); cells.Next();)
      out.emplace_back(Utf8(cells.cell()));
    return out;
  }

  void ReadFileHead() {
    lines_.Next();
    while (lines_.Next()) {
      const std::string_view line = Trim(lines_.line());
      if (line.starts_with(kEndOfHeader)) return;
      // The separator itself is told by a line that has it between its two words.
      if (line.starts_with("Separator")) {
        const bool comma = line.find("Comma") != std::string_view::npos;
        if (!comma && line.find("Tab") == std::string_view::npos)
          Fail("'" + Utf8(line.substr(0, 60)) + "', allowed: Tab, Comma");
        separator_ = comma ? ',' : '\t';
      }
      const std::vector<std::string> row = Row();
      if (row.size() < 2) continue;
      if (row[0] == "X_Columns") x_columns_ = row[1];
      if (row[0] == "Reader_Version" && row[1] > "2")
        Fail("reader version " + row[1] + ", allowed: 1, 2");
    }
    Fail("the head of the file does not end with " + std::string(kEndOfHeader));
  }

  /// From its first line, which is there already, to the next segment.
  std::vector<Piece> ReadSegment() {
    std::map<std::string, std::vector<std::string>> head;
    for (bool more = true; more; more = lines_.Next()) {
      const std::string_view line = Trim(lines_.line());
      if (line.starts_with("***Start_Special")) SkipSpecial();
      if (line.starts_with(kEndOfHeader)) break;
      const std::vector<std::string> row = Row();
      if (!row.empty() && !row[0].empty()) head[row[0]] = {row.begin() + 1, row.end()};
    }
    if (!Trim(lines_.line()).starts_with(kEndOfHeader) || !lines_.Next())
      Fail("a segment without " + std::string(kEndOfHeader) + " and a line of names");
    std::vector<Piece> pieces = ReadNames(head);
    ReadRows(pieces);
    return pieces;
  }

  void SkipSpecial() {
    while (lines_.Next())
      if (Trim(lines_.line()).starts_with("***End_Special")) return;
  }

  /// Columns of x and y by the line of names; the cells of the head stand above those of y.
  std::vector<Piece> ReadNames(const std::map<std::string, std::vector<std::string>>& head) {
    const std::vector<std::string> names = Row();
    if (names.empty() || names[0] != "X_Value") Fail("'X_Value' expected, then names of channels");
    const auto cell = [&](const char* key, std::size_t column) -> std::string {
      const auto it = head.find(key);
      // The first cell of a line of the head is its key, above the first column.
      return it == head.end() || column - 1 >= it->second.size() ? "" : it->second[column - 1];
    };
    std::vector<Piece> pieces;
    columns_.assign(names.size(), {});
    const bool multi = x_columns_ == "Multi";
    for (std::size_t k = 1; k < names.size(); ++k) {
      if (names[k] == "Comment" && k + 1 == names.size()) continue;
      if (multi && names[k] == "X_Value") continue;
      if (names[k].empty()) continue;
      Piece p{names[k], cell("Y_Unit_Label", k)};
      // Multi: the heads stand above the column of x or of y, by the version of the writer.
      const auto either = [&](const char* key) {
        const std::string own = cell(key, k);
        return own.empty() && multi && k >= 2 ? cell(key, k - 1) : own;
      };
      if (p.unit.empty()) p.unit = either("Y_Unit_Label");
      ToNumber(either("X0"), p.x0);
      ToNumber(either("Delta_X"), p.step);
      const std::string dimension = either("X_Dimension");
      p.over_time = dimension.empty() || dimension == "Time";
      p.instant = ParseDateTime(either("Date") + " " + either("Time"));
      columns_[k] = {true, pieces.size(), multi ? k - 1 : 0};
      pieces.push_back(std::move(p));
    }
    if (pieces.empty()) Fail("no channels");
    return pieces;
  }

  void ReadRows(std::vector<Piece>& pieces) {
    while (lines_.Next()) {
      // A blank line ends a segment; row by row the file says how many rows there are.
      if (Blank() && lines_.line().find(separator_) == std::string_view::npos) return;
      ReadRow(pieces);
    }
  }

  void ReadRow(std::vector<Piece>& pieces) {
    numbers_.clear();
    Cells cells(lines_.line(), separator_);
    for (std::size_t k = 0; k < columns_.size() && cells.Next(); ++k) {
      double value = std::numeric_limits<double>::quiet_NaN();
      const bool read = columns_[k].y || k == 0 || (k + 1 < columns_.size() && columns_[k + 1].y);
      if (read && !cells.cell().empty() && !ToNumber(cells.cell(), value))
        throw InputError(path_ + ':' + std::to_string(lines_.number()) + ':' +
                         std::to_string(cells.column()) + ": '" + Utf8(cells.cell().substr(0, 60)) +
                         "' is not a number");
      numbers_.push_back(value);
    }
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      if (!columns_[k].y) continue;
      Piece& p = pieces[columns_[k].piece];
      const double y = k < numbers_.size() ? numbers_[k] : kMissing;
      if (x_columns_ != "No") {
        const std::size_t at = columns_[k].x;
        p.x.push_back(at < numbers_.size() ? numbers_[at] : kMissing);
      }
      p.y.push_back(y);
    }
  }

  static constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  struct ColumnRole {
    bool y = false;
    std::size_t piece = 0, x = 0;  // index of the piece, column of its x
  };

  const std::string& path_;
  Lines lines_;
  char separator_ = '\t';
  std::string x_columns_ = "One";
  std::vector<ColumnRole> columns_;
  std::vector<double> numbers_;
};

/// Rows behind the last sample of a channel that is shorter than others.
void CutEmptyEnd(Piece& p) {
  while (!p.y.empty() && std::isnan(p.y.back())) {
    p.y.pop_back();
    if (!p.x.empty()) p.x.pop_back();
  }
}

/// Time of the first sample of a piece that states X0 and Delta_X.
double StartOf(const Piece& p, const Piece& first) {
  const bool dated = p.instant && first.instant && p.x0 == first.x0;
  return p.x0 + (dated ? SecondsBetween(*first.instant, *p.instant) : 0);
}

/// The same channel in all segments, one behind the other.
TimedChannel Join(const std::vector<std::vector<Piece>>& segments, std::size_t k,
                  const std::string& path) {
  const Piece& first = segments.front()[k];
  TimedChannel out{{first.name, first.unit, {}}};
  std::vector<double> x;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const Piece& p = segments[s][k];
    out.channel.samples.insert(out.channel.samples.end(), p.y.begin(), p.y.end());
    x.insert(x.end(), p.x.begin(), p.x.end());
    if (s == 0 || !p.x.empty() || !(first.step > 0)) continue;
    const double expected =
        first.x0 + first.step * static_cast<double>(out.channel.samples.size() - p.y.size());
    // Clocks of computers stamp the blocks; a fifth of a period is no gap.
    if (std::abs(StartOf(p, first) - expected) > 0.2 * first.step || p.step != first.step)
      throw InputError(path + ": segment " + std::to_string(s + 1) + " of " + p.name +
                       " begins at " + NumberText(StartOf(p, first)) + " s, expected " +
                       NumberText(expected) +
                       " s; segments with gaps between them are records of their own");
  }
  // X_Value may have too few digits for the rate; where it agrees with Delta_X, that tells more.
  bool regular = first.step > 0;
  for (std::size_t n = 0; n < x.size() && regular; ++n)
    regular = std::abs(x[n] - x[0] - static_cast<double>(n) * first.step) <=
              std::max(0.1 * first.step, 1.01e-6);
  if (x.empty() || regular) {
    if (!(first.step > 0))
      throw InputError(path + ": " + first.name + ": Delta_X = " + NumberText(first.step) +
                       ", allowed: above 0");
    out.rate = RateOfPeriod(first.step, kDeltaDigits);
    out.start = x.empty() ? first.x0 : x[0];
  } else {
    const TimeBase base = UniformTimeBase(x, path + ": X_Value of " + first.name);
    out.rate = base.rate;
    out.start = base.start;
  }
  return out;
}

void CheckSegments(const std::vector<std::vector<Piece>>& segments, const std::string& path) {
  for (std::size_t s = 1; s < segments.size(); ++s) {
    bool same = segments[s].size() == segments[0].size();
    for (std::size_t k = 0; same && k < segments[s].size(); ++k)
      same = segments[s][k].name == segments[0][k].name;
    if (!same)
      throw InputError(path + ": segment " + std::to_string(s + 1) +
                       " has other channels than the first; they are records of their own");
  }
}

Measurement ReadLabviewText(const std::string& path) {
  std::string text = ReadFile(path);
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  std::vector<std::vector<Piece>> segments = LvmReader(path, text).Read();
  CheckSegments(segments, path);
  for (std::vector<Piece>& segment : segments)
    for (Piece& p : segment) CutEmptyEnd(p);
  std::vector<std::string> notes;
  std::vector<TimedChannel> channels;
  for (std::size_t k = 0; k < segments.front().size(); ++k) {
    const Piece& p = segments.front()[k];
    if (!p.over_time)
      notes.push_back(path + ": " + p.name + " is not over time, left out");
    else if (p.y.empty())
      notes.push_back(path + ": " + p.name + " has no rows, left out");
    else
      channels.push_back(Join(segments, k, path));
  }
  Measurement out;
  out.record = OneTimeBase(std::move(channels), path);
  out.record.notes.insert(out.record.notes.end(), notes.begin(), notes.end());
  FinishRecord(out.record, path);
  return out;
}

bool IsLabviewText(std::string_view begin) {
  if (begin.starts_with("\xef\xbb\xbf")) begin.remove_prefix(3);
  return begin.starts_with("LabVIEW Measurement");
}

}  // namespace

RecordFormat LabviewText() { return {"LVM", ".lvm", IsLabviewText, ReadLabviewText}; }

}  // namespace ambrig
