#pragma once
/// Numbers of a TOML table within their physical range, and files that a file names.
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/toml.h"

namespace ambrig {

/// What a number of a file may be: a closed interval in SI units ("-": without unit).
struct Range {
  std::string_view unit;
  double lo, hi;
  std::string_view doc;  // one line
};

/// A number inside its range; a fallback of kRequired: the file must give it. A fallback itself is
/// not checked. @throws InputError naming key, value, range, unit and meaning.
double Within(const TomlTable& t, std::string_view key, double fallback, const Range& range);
/// An array of numbers, each inside the range.
std::vector<double> AllWithin(const TomlTable& t, std::string_view key,
                              const std::vector<double>& fallback, const Range& range);

/// A file that this one names, beside it unless the name begins with a slash: the path to open.
/// Without `fallback` the key is required. @throws InputError "file:line: key = name, allowed: a
/// file (...)" when it does not exist.
std::string ExistingFile(const TomlTable& t, std::string_view key,
                         const std::string& fallback = "");

/// The innermost table that a file has of a path such as "bearings.A.sensor.z", and the rest of the
/// path there: the last key where the file has all of its tables.
std::pair<TomlTable, std::string> InnermostOf(const TomlTable& root, const std::string& path);

/// A one-sigma spread [unit] that its parameter can have: at most the width of the range, and at
/// most the value itself where that must be positive. @throws InputError "where.sd = ..., allowed".
void CheckSpread(std::string_view where, double sd, double value, double lo, double hi,
                 std::string_view unit);

}  // namespace ambrig
