#include "core/record/formats/universal_function.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>

#include "core/base/errors.h"
#include "core/record/text_cells.h"

namespace ambrig {

namespace {

/// A field of a line in columns; counted in characters, which writers of UTF-8 do.
std::string FieldOfLine(std::string_view line, std::size_t from, std::size_t width) {
  const std::string text = Utf8(line);
  std::size_t begin = std::string::npos, end = text.size(), character = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if ((static_cast<unsigned char>(text[k]) & 0xc0) == 0x80) continue;
    if (character == from) begin = k;
    if (character == from + width) end = k;
    ++character;
  }
  if (begin == std::string::npos) return "";
  const std::string field(Trim(std::string_view(text).substr(begin, end - begin)));
  return field == "NONE" ? "" : field;
}

long Integer(const std::string& field) {
  long value = 0;
  std::from_chars(field.data(), field.data() + field.size(), value);
  return value;
}

/// A FORTRAN number: 1.5E+00, 1.5D+00.
bool FortranNumber(std::string_view cell, double& value) {
  std::string text(Trim(cell));
  std::replace(text.begin(), text.end(), 'D', 'E');
  std::replace(text.begin(), text.end(), 'd', 'e');
  return ToNumber(text, value);
}

UniversalAxis Axis(std::string_view line) {
  return {static_cast<int>(Integer(FieldOfLine(line, 0, 10))), FieldOfLine(line, 26, 20),
          FieldOfLine(line, 47, 20)};
}

std::vector<std::string_view> Words(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t at = line.find_first_not_of(" \t\r"); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(" \t\r", end);
  }
  return words;
}

struct DataForm {
  bool is_double = false;
  std::size_t points = 0;
};

/// Record 7: 3I10,3E13.5, by columns or, where a writer kept other ones, by words.
DataForm ReadForm(UniversalText& text, UniversalFunction& f) {
  double v[5] = {};
  bool good = true;
  const std::size_t from[] = {0, 10, 20, 30, 43}, width[] = {10, 10, 10, 13, 13};
  for (int k = 0; k < 5 && good; ++k)
    good = FortranNumber(FieldOfLine(text.line(), from[k], width[k]), v[k]);
  if (!good) {
    const auto words = Words(text.line());
    good = words.size() >= 5;
    for (std::size_t k = 0; k < 5 && good; ++k) good = FortranNumber(words[k], v[k]);
  }
  const auto type = static_cast<int>(good && v[0] >= 0 && v[0] < 100 ? v[0] : -1);
  if (type != 2 && type != 4 && type != 5 && type != 6)
    text.Fail("ordinate type " + FieldOfLine(text.line(), 0, 10) +
              ", allowed 2, 4 (real), 5, 6 (complex) in a record 7 of 3I10,3E13.5");
  if (!(v[1] >= 0 && v[1] < 1e15))
    text.Fail("number of points " + FieldOfLine(text.line(), 10, 10));
  f.complex = type >= 5;
  f.even = v[2] != 0;
  f.first = v[3];
  f.step = v[4];
  return {type == 4 || type == 6, static_cast<std::size_t>(v[1])};
}

DataForm ReadHead(UniversalText& text, UniversalFunction& f) {
  const auto next = [&text](const char* record) {
    if (!text.Next() || text.AtMark()) text.Fail(std::string("the data set ends before ") + record);
    return text.line();
  };
  for (std::string& id : f.id) id = FieldOfLine(next("its text"), 0, 80);
  const std::string_view dof = next("record 6");
  f.type = static_cast<int>(Integer(FieldOfLine(dof, 0, 5)));
  f.response = {FieldOfLine(dof, 31, 10), Integer(FieldOfLine(dof, 41, 10)),
                static_cast<int>(Integer(FieldOfLine(dof, 51, 4)))};
  f.reference = {FieldOfLine(dof, 56, 10), Integer(FieldOfLine(dof, 66, 10)),
                 static_cast<int>(Integer(FieldOfLine(dof, 76, 4)))};
  next("record 7");
  const DataForm form = ReadForm(text, f);
  f.abscissa = Axis(next("record 8"));
  f.ordinate = Axis(next("record 9"));
  f.denominator = Axis(next("record 10"));
  next("record 11");
  return form;
}

/// One after the other the numbers of the function: abscissa (uneven only), real, imaginary part.
void Put(UniversalFunction& f, std::size_t which, double value) {
  if (!f.even && which-- == 0) return f.x.push_back(value);
  (which == 0 ? f.real : f.imaginary).push_back(value);
}

/// The numbers of a line in columns of these widths (over and over); false when one is none or
/// begins within another.
bool InColumns(std::string_view line, const std::vector<std::size_t>& widths,
               std::vector<double>& out) {
  out.clear();
  std::size_t at = 0;
  for (std::size_t k = 0; !Trim(line.substr(std::min(at, line.size()))).empty(); ++k) {
    const std::size_t width = widths[k % widths.size()];
    const std::string_view cell = line.substr(at, width);
    const bool cut = at > 0 && line[at] != ' ' && line[at] != '-' && line[at - 1] != ' ';
    double value = 0;
    if (cut || !FortranNumber(cell, value)) return false;
    out.push_back(value);
    at += width;
  }
  return true;
}

void ReadValuesAsText(UniversalText& text, UniversalFunction& f, const DataForm& form) {
  const std::size_t each = 1 + (f.even ? 0 : 1) + (f.complex ? 1 : 0);
  std::vector<std::size_t> widths(1, form.is_double ? 20 : 13);
  if (form.is_double && !f.even)
    widths = f.complex ? std::vector<std::size_t>{13, 20, 20} : std::vector<std::size_t>{13, 20};
  const std::size_t wanted = form.points * each;
  std::vector<double> numbers;
  for (std::size_t count = 0; count < wanted;) {
    if (!text.Next() || text.AtMark())
      text.Fail("the function ends after " + std::to_string(count) + " of " +
                std::to_string(wanted) + " numbers");
    if (!InColumns(text.line(), widths, numbers)) {
      numbers.clear();
      for (const std::string_view word : Words(text.line())) {
        numbers.push_back(0);
        if (!FortranNumber(word, numbers.back()))
          text.Fail("'" + Utf8(word.substr(0, 60)) + "' is not a number");
      }
    }
    for (const double value : numbers)
      if (count < wanted) Put(f, count++ % each, value);
  }
}

double Raw(const char* at, std::size_t size, bool little) {
  const auto number = [&](auto bits) {
    std::memcpy(&bits, at, sizeof bits);
    if (!little) {
      auto* bytes = reinterpret_cast<unsigned char*>(&bits);
      std::reverse(bytes, bytes + sizeof bits);
    }
    return bits;
  };
  return size == 4 ? static_cast<double>(std::bit_cast<float>(number(std::uint32_t{})))
                   : std::bit_cast<double>(number(std::uint64_t{}));
}

/// Whether the mark that ends a data set follows.
bool MarkFollows(std::string_view left) {
  const std::size_t at = left.find_first_not_of(" \r\n");
  return at != std::string_view::npos && left.substr(at).starts_with("-1");
}

/// The bytes that the head states are not used: writers state those of real numbers for complex
/// ones. An uneven abscissa is single precision by the specification, double with some writers.
void ReadBinary(UniversalText& text, UniversalFunction& f, const DataForm& form, bool little) {
  const std::size_t size = form.is_double ? 8 : 4, parts = f.complex ? 2 : 1;
  const std::string_view left = text.left();
  std::size_t x_size = f.even ? 0 : 4;
  const auto total = [&] { return form.points * (x_size + parts * size); };
  const auto fits = [&] { return form.points <= left.size() / (x_size + parts * size); };
  const bool marked = fits() && MarkFollows(left.substr(total()));
  if (!f.even && size == 8 && !marked) {
    x_size = 8;
    if (!fits() || !MarkFollows(left.substr(total()))) x_size = 4;
  }
  if (!fits())
    text.FailAtByte("the function says " + std::to_string(form.points) + " points of " +
                    std::to_string(x_size + parts * size) + " bytes, the file has " +
                    std::to_string(left.size()) + " bytes left");
  const char* at = left.data();
  for (std::size_t k = 0; k < form.points; ++k) {
    std::size_t which = 0;
    if (!f.even) {
      Put(f, which++, Raw(at, x_size, little));
      at += x_size;
    }
    for (std::size_t p = 0; p < parts; ++p, at += size) Put(f, which++, Raw(at, size, little));
  }
  text.Skip(total());
}

}  // namespace

bool UniversalText::Next() {
  if (at_ >= bytes_.size()) return false;
  const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
  line_ = bytes_.substr(at_, end - at_);
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  at_ = std::min(end + 1, bytes_.size());
  ++number_;
  return true;
}

void UniversalText::Skip(std::size_t bytes) { at_ = std::min(at_ + bytes, bytes_.size()); }

bool UniversalText::AtMark() const { return line_.size() <= 80 && Trim(line_) == "-1"; }

void UniversalText::Fail(const std::string& what) const {
  throw InputError(path_ + ':' + std::to_string(number_) + ": " + what);
}

void UniversalText::FailAtByte(const std::string& what) const {
  throw InputError(path_ + ": byte " + std::to_string(at_) + ": " + what);
}

std::string UniversalDof::text() const {
  constexpr std::array<const char*, 7> kAxes = {"", "X", "Y", "Z", "RX", "RY", "RZ"};
  std::string out = name;
  if (node != 0 || (name.empty() && direction != 0))
    out += (out.empty() ? "" : ":") + std::to_string(node);
  const int axis = direction < 0 ? -direction : direction;
  if (direction != 0 && axis <= 6) out += (direction > 0 ? "+" : "-") + std::string(kAxes[axis]);
  return out;
}

UniversalFunction ReadUniversalFunction(UniversalText& text) {
  const std::string_view head = Trim(text.line());
  const bool binary = head.starts_with("58b");
  const auto words = Words(head.substr(std::min<std::size_t>(3, head.size())));
  const std::string order(words.empty() ? "" : words[0]), kind(words.size() < 2 ? "" : words[1]);
  if (binary && ((order != "1" && order != "2") || kind != "2"))
    text.Fail("58b with byte order '" + order + "' and numbers of kind '" + kind +
              "', allowed 1 (little endian) or 2 (big endian) and 2 (IEEE 754)");
  UniversalFunction f;
  const DataForm form = ReadHead(text, f);
  if (binary)
    ReadBinary(text, f, form, order == "1");
  else
    ReadValuesAsText(text, f, form);
  return f;
}

}  // namespace ambrig
