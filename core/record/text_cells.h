#pragma once
/// Lines, cells and numbers of the text files that instruments write.
#include <cstddef>
#include <string>
#include <string_view>

namespace ambrig {

/// Without blanks, tabs and carriage returns at both ends.
std::string_view Trim(std::string_view text);
/// Without quotes at both ends.
std::string_view Unquote(std::string_view text);
/// a to z instead of A to Z; other characters stay.
std::string LowerCase(std::string_view text);
/// Text as UTF-8: what is no UTF-8 is taken for Latin-1, in which older instruments write units.
std::string Utf8(std::string_view text);

/// A whole cell as a number, with a decimal point or a decimal comma; false for anything else.
bool ToNumber(std::string_view cell, double& value);

/// Lines of a text with their numbers; the last may lack its end.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  bool Next();
  std::string_view line() const { return line_; }
  std::size_t number() const { return number_; }  // from 1
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_, line_;
  std::size_t number_ = 0;
};

/// One after the other the cells of a line, with the column [characters] where each begins. A
/// separator within quotes is text.
class Cells {
 public:
  Cells(std::string_view line, char separator) : line_(line), separator_(separator) {}

  bool Next();
  /// Without blanks and quotes round it.
  std::string_view cell() const { return Unquote(Trim(cell_)); }
  std::size_t column() const;  // from 1

 private:
  std::string_view line_, cell_;
  char separator_;
  std::size_t begin_ = 0, next_ = 0;
};

}  // namespace ambrig
