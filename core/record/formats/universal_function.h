#pragma once
/// One function of a Universal File: data set 58 or 58b ("Function at Nodal DOF" of the SDRC I-DEAS
/// Universal File specification).
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ambrig {

/// The bytes of a Universal File, read line by line or as raw numbers.
class UniversalText {
 public:
  UniversalText(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  bool Next();  // the next line; false at the end
  std::string_view line() const { return line_; }
  std::string_view left() const { return bytes_.substr(at_); }
  void Skip(std::size_t bytes);
  bool AtMark() const;  // the line is "    -1"
  /// "FILE:LINE: ..." [[noreturn]]
  [[noreturn]] void Fail(const std::string& what) const;
  /// "FILE: byte N: ..."
  [[noreturn]] void FailAtByte(const std::string& what) const;

 private:
  const std::string& path_;
  std::string_view bytes_, line_;
  std::size_t at_ = 0, number_ = 0;
};

/// What is measured along one axis: records 8 to 11.
struct UniversalAxis {
  int type = 0;  // 8 displacement, 12 acceleration, 13 force, 17 time, 18 frequency ...
  std::string label, unit;
};

/// A degree of freedom of record 6.
struct UniversalDof {
  std::string name;  // empty: NONE
  long node = 0;
  int direction = 0;  // 1 to 6: +X, +Y, +Z and rotations about them; negative: against; 0 scalar
  std::string text() const;  // "NAME:5+X", as much as is there
};

struct UniversalFunction {
  std::array<std::string, 5> id;  // NONE is empty
  int type = 0;                   // 1 time response, 4 frequency response ...
  UniversalDof response, reference;
  bool complex = false, even = true;
  double first = 0, step = 0;  // of an even abscissa
  UniversalAxis abscissa, ordinate, denominator;
  std::vector<double> x;                // of an uneven abscissa
  std::vector<double> real, imaginary;  // the second of complex functions only
};

/// Reads on behind the line "    58" or "    58b ...", which is `text.line()`; the mark that ends
/// the data set stays unread. @throws InputError with line or byte
UniversalFunction ReadUniversalFunction(UniversalText& text);

}  // namespace ambrig
