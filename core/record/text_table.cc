#include "core/record/text_table.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/errors.h"
#include "core/record/date_time.h"
#include "core/record/text_cells.h"
#include "core/record/time_base.h"
#include "core/record/units.h"

namespace ambrig {

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

char Separator(std::string_view header) {
  for (const char c : {'\t', ';'})
    if (header.find(c) != std::string_view::npos) return c;
  return ',';
}

/// "(ms)" or "[ms]" -> "ms"; nullopt for anything else.
std::optional<std::string_view> InBrackets(std::string_view cell) {
  const bool bracketed = cell.size() >= 2 && ((cell.front() == '(' && cell.back() == ')') ||
                                              (cell.front() == '[' && cell.back() == ']'));
  if (!bracketed) return std::nullopt;
  return Trim(cell.substr(1, cell.size() - 2));
}

/// Whether a cell begins with a letter and so is no number that was written wrongly.
bool IsWord(std::string_view cell) {
  const char c =
      cell.size() > 1 && (cell.front() == '"' || cell.front() == '\'') ? cell[1] : cell[0];
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

/// A column while it is read: numbers, dates and times of day, or words.
struct Column {
  Channel channel = {};
  bool dates = false;
  std::string first_word = {};  // what a cell of words is refused with, once a number follows
  bool has_date = false, has_time = false;  // of all its dates
  std::vector<DateTime> instants = {};
  std::string first = {};  // the first date, as written
};

class TableReader {
 public:
  TableReader(const std::string& path, std::string_view text) : path_(path), lines_(text) {}

  TextTable Read() {
    std::string_view header;
    while (header.empty() && lines_.Next())
      if (!lines_.line().starts_with('#') && !lines_.line().starts_with("sep="))
        header = Trim(lines_.line());
    if (header.empty()) throw InputError(path_ + ": no header, expected e.g. t [s],A.x [um]");
    ReadHeads(lines_.line());
    ReadRows();
    return Finish();
  }

 private:
  [[noreturn]] void Fail(std::size_t line, std::size_t column, const std::string& what) const {
    throw InputError(Place(line, column) + what);
  }

  std::string Place(std::size_t line, std::size_t column) const {
    return path_ + ':' + std::to_string(line) + ':' + std::to_string(column) + ": ";
  }

  void ReadHeads(std::string_view line) {
    table_.header_rows = lines_.number();
    separator_ = Separator(line);
    for (Cells cells(line, separator_); cells.Next();) {
      const std::string cell = Utf8(cells.cell());
      // Some loggers end every line with a separator.
      if (cell.empty() && cells.column() > Trim(line).size() && !columns_.empty()) break;
      double ignored = 0;
      if (ToNumber(cell, ignored))
        Fail(lines_.number(), cells.column(), "header expected, e.g. t [s],A.x [um]");
      const ColumnHead head = ParseHead(cell);
      if (head.name.empty()) Fail(lines_.number(), cells.column(), "column without a name");
      if (!head.unit_closed)
        Fail(lines_.number(), cells.column(), "']' expected after the unit of " + head.name);
      columns_.push_back({{head.name, head.unit, {}}});
    }
  }

  /// A second line that names units only, as oscilloscopes write it.
  bool ReadUnits(std::string_view line) {
    std::vector<std::string> units;
    bool any = false;
    for (Cells cells(line, separator_); cells.Next();) {
      const std::string cell = Utf8(cells.cell());
      const auto bracketed = InBrackets(cell);
      if (!bracketed && !cell.empty() && !KnownUnit(cell)) return false;
      units.emplace_back(bracketed ? std::string(*bracketed) : cell);
      any = any || (!units.back().empty() && cell != "1");  // a number, and a unit beside others
    }
    if (!any || units.size() > columns_.size()) return false;
    for (std::size_t k = 0; k < units.size(); ++k)
      if (!units[k].empty()) columns_[k].channel.unit = units[k];
    return true;
  }

  void ReadRows() {
    std::size_t blank = 0, rows = 0;
    while (lines_.Next()) {
      if (Trim(lines_.line()).empty() && (columns_.size() > 1 || rows == 0)) {
        if (rows > 0) blank = lines_.number();
        if (rows == 0) table_.header_rows = lines_.number();
        continue;
      }
      if (rows == 0 && ReadUnits(lines_.line())) {
        table_.header_rows = lines_.number();
        continue;
      }
      // Skipping a row would shift all that follow; only the end may be blank.
      if (blank != 0) Fail(blank, 1, "blank line between rows");
      ReadRow(lines_.line(), ++rows);
    }
  }

  void ReadRow(std::string_view line, std::size_t row) {
    std::size_t k = 0;
    for (Cells cells(line, separator_); cells.Next(); ++k) {
      if (k == columns_.size() && cells.cell().empty() && cells.column() > Trim(line).size()) break;
      if (k == columns_.size())
        Fail(lines_.number(), cells.column(), "more cells than the header's " + std::to_string(k));
      ReadCell(columns_[k], cells, row);
    }
    if (k < columns_.size())
      Fail(lines_.number(), line.size() + 1,
           std::to_string(k) + " cells, header has " + std::to_string(columns_.size()));
  }

  void ReadCell(Column& column, const Cells& cells, std::size_t row) {
    const std::string_view cell = cells.cell();
    double value = kMissing;
    const bool number = cell.empty() || ToNumber(cell, value);
    if (row == 1 && !number && ParseDateTime(cell)) {
      column.dates = true;
      column.first = cell;
    }
    if (!column.dates) {
      if (number && !cell.empty() && !column.first_word.empty())
        throw InputError(column.first_word);
      if (!number) ReadWord(column, cells);
      column.channel.samples.push_back(value);
      return;
    }
    const auto instant = ParseDateTime(cell);
    if (!instant ||
        (row > 1 && (instant->has_date != column.has_date || instant->has_time != column.has_time)))
      Fail(lines_.number(), cells.column(),
           column.channel.name + ": '" + Utf8(cell.substr(0, 60)) +
               "' is not a date or time of day like '" + Utf8(column.first.substr(0, 60)) + "'");
    column.has_date = instant->has_date;
    column.has_time = instant->has_time;
    column.instants.push_back(*instant);
  }

  /// A cell that is no number: a column of nothing but words is left out, one among numbers refuses
  /// the file.
  void ReadWord(Column& column, const Cells& cells) {
    const bool numbers = std::any_of(column.channel.samples.begin(), column.channel.samples.end(),
                                     [](double v) { return !std::isnan(v); });
    const std::string what = Place(lines_.number(), cells.column()) + column.channel.name + ": '" +
                             Utf8(cells.cell().substr(0, 60)) + "' is not a number";
    if (column.first_word.empty()) column.first_word = what;
    if (numbers || !IsWord(cells.cell()) || IsTimeName(column.channel.name)) throw InputError(what);
  }

  /// The columns that tell the instant: one with date and time of day, else one of each.
  std::vector<Column*> InstantColumns() {
    Column *both = nullptr, *date = nullptr, *time = nullptr;
    for (Column& c : columns_) {
      if (!c.dates) continue;
      Column*& slot = c.has_date && c.has_time ? both : c.has_date ? date : time;
      if (slot == nullptr) slot = &c;
    }
    if (both != nullptr) return {both};
    if (date != nullptr && time != nullptr) return {date, time};
    if (time != nullptr) return {time};
    if (date != nullptr) return {date};
    return {};
  }

  void AddSeconds(const std::vector<Column*>& from) {
    Channel t{"t", "s", std::vector<double>(from.front()->instants.size(), 0)};
    for (const Column* c : from) {
      table_.first_instant += (table_.first_instant.empty() ? "" : " ") + Utf8(c->first);
      for (std::size_t k = 0; k < t.samples.size(); ++k)
        t.samples[k] += SecondsBetween(c->instants.front(), c->instants[k]);
    }
    table_.columns.push_back(std::move(t));
  }

  TextTable Finish() {
    const bool timed = std::any_of(columns_.begin(), columns_.end(), [](const Column& c) {
      return !c.dates && IsTimeName(c.channel.name);
    });
    const std::vector<Column*> instants = InstantColumns();
    if (!timed && !instants.empty()) AddSeconds(instants);
    for (Column& c : columns_) {
      const bool used = !timed && std::count(instants.begin(), instants.end(), &c) > 0;
      if (!c.first_word.empty())
        table_.notes.push_back(path_ + ": " + c.channel.name + " holds words, left out");
      else if (!c.dates)
        table_.columns.push_back(std::move(c.channel));
      else if (!used)
        table_.notes.push_back(path_ + ": " + c.channel.name +
                               " holds dates or times of day, left out");
    }
    return std::move(table_);
  }

  const std::string& path_;
  Lines lines_;
  char separator_ = ',';
  std::vector<Column> columns_;
  TextTable table_;
};

}  // namespace

ColumnHead ParseHead(std::string_view head) {
  const std::size_t bracket = head.find('[');
  if (bracket != std::string_view::npos) {
    const bool closed = head.back() == ']';
    const std::string_view unit = head.substr(bracket + 1, head.size() - bracket - 2);
    return {std::string(Trim(head.substr(0, bracket))), closed ? std::string(Trim(unit)) : "",
            closed};
  }
  if (const std::size_t round = head.rfind('('); round != std::string_view::npos && round > 0)
    if (const auto unit = InBrackets(head.substr(round)); unit && KnownUnit(*unit))
      return {std::string(Trim(head.substr(0, round))), std::string(*unit)};
  if (const std::size_t bar = head.rfind(" / "); bar != std::string_view::npos && bar > 0)
    if (const std::string_view unit = Trim(head.substr(bar + 3)); KnownUnit(unit))
      return {std::string(Trim(head.substr(0, bar))), std::string(unit)};
  return {std::string(Trim(head)), ""};
}

TextTable ReadTextTable(const std::string& path, std::string_view text) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw InputError(path + ": UTF-16 text, allowed: UTF-8 or Latin-1 (save it as such)");
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // byte order mark
  return TableReader(path, text).Read();
}

}  // namespace ambrig
