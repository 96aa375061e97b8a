#include "core/record/units.h"

#include <algorithm>
#include <utility>

#include "core/base/errors.h"
#include "core/math/constants.h"

namespace ambrig {
namespace {

struct Unit {
  std::string_view name;
  std::string_view si;  // names the quantity
  double factor;        // SI = factor * value
};

// The first unit of a quantity is the SI unit itself. Hz stands twice: alone it is a frequency;
// where a speed is wanted it is revolutions per second.
constexpr Unit kUnits[] = {
    {"m", "m", 1},
    {"mm", "m", 1e-3},
    {"um", "m", 1e-6},
    {"nm", "m", 1e-9},
    {"m/s", "m/s", 1},
    {"mm/s", "m/s", 1e-3},
    {"m/s2", "m/s2", 1},
    {"N", "N", 1},
    {"kN", "N", 1e3},
    {"mN", "N", 1e-3},
    {"N m", "N m", 1},
    {"A", "A", 1},
    {"mA", "A", 1e-3},
    {"uA", "A", 1e-6},
    {"A/s", "A/s", 1},
    {"V", "V", 1},
    {"mV", "V", 1e-3},
    {"kV", "V", 1e3},
    {"W", "W", 1},
    {"Wb", "Wb", 1},
    {"mWb", "Wb", 1e-3},
    {"T", "T", 1},
    {"mT", "T", 1e-3},
    {"rad", "rad", 1},
    {"mrad", "rad", 1e-3},
    {"deg", "rad", kPi / 180},
    {"rad/s", "rad/s", 1},
    {"rpm", "rad/s", kPi / 30},
    {"1/min", "rad/s", kPi / 30},
    {"deg/s", "rad/s", kPi / 180},
    {"Hz", "Hz", 1},
    {"kHz", "Hz", 1e3},
    {"Hz", "rad/s", 2 * kPi},
    {"s", "s", 1},
    {"ms", "s", 1e-3},
    {"us", "s", 1e-6},
    {"ns", "s", 1e-9},
    {"K", "K", 1},
    {"degC", "K", 1},
    {"-", "-", 1},
    {"%", "-", 1e-2},
    {"ohm", "ohm", 1},
    {"mohm", "ohm", 1e-3},
    {"H", "H", 1},
    {"mH", "H", 1e-3},
    {"uH", "H", 1e-6},
    {"kg", "kg", 1},
    {"g", "kg", 1e-3},
    {"kg m2", "kg m2", 1},
    {"N/m", "N/m", 1},
    {"N/um", "N/m", 1e6},
    {"N/A", "N/A", 1},
    {"N s/m", "N s/m", 1},
    {"dB", "dB", 1},
};

/// Words for units, in small letters.
constexpr std::pair<std::string_view, std::string_view> kUnitWords[] = {
    {"volt", "V"},      {"volts", "V"},    {"ampere", "A"},   {"amperes", "A"},   {"amp", "A"},
    {"amps", "A"},      {"newton", "N"},   {"newtons", "N"},  {"meter", "m"},     {"meters", "m"},
    {"metre", "m"},     {"metres", "m"},   {"sec", "s"},      {"second", "s"},    {"seconds", "s"},
    {"micron", "um"},   {"microns", "um"}, {"degree", "deg"}, {"degrees", "deg"}, {"radian", "rad"},
    {"radians", "rad"}, {"hertz", "Hz"},   {"hz", "Hz"},
};

void ReplaceAll(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at))
    text.replace(at, from.size(), to);
}

bool IsBlank(char c) { return c == ' ' || c == '\t'; }

std::string Normalise(std::string_view unit) {
  std::string text(unit);
  constexpr std::pair<const char*, const char*> kSpellings[] = {
      {"\u00b5", "u"},    // micro sign
      {"\u03bc", "u"},    // Greek mu
      {"\u03a9", "ohm"},  // Greek Omega
      {"\u2126", "ohm"},  // ohm sign
      {"\u00b0C", "degC"}, {"\u00b0", "deg"}, {"\u00b2", "2"},
      {"^2", "2"},         {"\u00b7", " "},  // middle dot
      {"\u00a0", " "},                       // no-break space
      {"*", " "},          {"Ohm", "ohm"},
  };
  for (const auto& [from, to] : kSpellings) ReplaceAll(text, from, to);
  // One blank between factors, none at the ends and round a fraction bar.
  std::string out;
  for (char c : text) {
    if (IsBlank(c) && (out.empty() || out.back() == ' ' || out.back() == '/')) continue;
    if (c == '/' && !out.empty() && out.back() == ' ') out.pop_back();
    out += IsBlank(c) ? ' ' : c;
  }
  if (!out.empty() && out.back() == ' ') out.pop_back();
  if (out == "1") return "-";
  if (out == "kgm2") return "kg m2";
  if (out == "Nm") return "N m";
  std::string small = out;
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
  for (const auto& [word, sign] : kUnitWords)
    if (small == word) return std::string(sign);
  return out;
}

const Unit* FindUnit(std::string_view name, std::string_view si) {
  for (const Unit& u : kUnits)
    if (u.name == name && u.si == si) return &u;
  return nullptr;
}

std::string Allowed(const std::string& si) {
  std::string list;
  for (const Unit& u : kUnits)
    if (u.si == si) list += (list.empty() ? "" : ", ") + std::string(u.name);
  return list.empty() ? si : list;
}

}  // namespace

double UnitFactor(std::string_view from, std::string_view to_si, std::string_view where) {
  const std::string name = Normalise(from), si = Normalise(to_si);
  if (const Unit* unit = FindUnit(name, si)) return unit->factor;
  if (name == si) return 1;
  throw InputError((where.empty() ? "" : std::string(where) + ": ") + "unit " +
                   (name.empty() ? "missing" : name) + ", allowed " + Allowed(si));
}

std::string SiUnit(std::string_view unit) {
  const std::string name = Normalise(unit);
  for (const Unit& u : kUnits)
    if (u.name == name) return std::string(u.si);
  return name;
}

bool KnownUnit(std::string_view unit) {
  const std::string name = Normalise(unit);
  return std::any_of(std::begin(kUnits), std::end(kUnits),
                     [&name](const Unit& u) { return u.name == name; });
}

void ConvertToSi(Record& record) {
  for (Channel& c : record.channels) {
    if (c.unit.empty()) continue;
    const std::string si = SiUnit(c.unit);
    const double factor = UnitFactor(c.unit, si, c.name);
    if (factor != 1)
      for (double& x : c.samples) x *= factor;
    c.unit = si;
  }
}

}  // namespace ambrig
