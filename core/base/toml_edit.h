#pragma once
/// TOML files with some values changed in place: comments, order and layout of the
/// user's text stay, every other value keeps its digits.
#include <string>
#include <variant>
#include <vector>

namespace ambrig {

/// A value as TOML text, such as "{ value = 1.0, sd = 0.1 }".
struct TomlLiteral {
  std::string text;
};

/// "controller.kp", "controller.filter[0].frequency", "controller.speeds[1]",
/// "bearings.Z.controller.kd"; a key that is not there yet is added to its table.
struct TomlEdit {
  std::string path;
  std::variant<double, std::string, TomlLiteral> value;
};

/// `text` (of `file`, for errors) with the edits made, one after the other; a number written
/// { value, sd } keeps its sd unless a literal replaces it.
/// @throws InputError for a path through something that is not there or not of its kind.
std::string EditedToml(const std::string& text, const std::string& file,
                       const std::vector<TomlEdit>& edits);

/// `text` without the table `path` ("effect[1]", "controller"), its header and lines up to its last
/// value, and the same of the tables inside it. @throws InputError when it is not there or inline
std::string WithoutTomlTable(const std::string& text, const std::string& file,
                             const std::string& path);

/// Relative names under a key `file` become absolute, beside `file`, so that the text may be stored
/// elsewhere.
std::string WithAbsoluteFiles(const std::string& text, const std::string& file);

/// Whether there is a value or a table at the path. @throws InputError for text that is no path
bool HasTomlPath(const std::string& text, const std::string& file, const std::string& path);

/// The number at a path; of { value, sd } the value. @throws InputError when there is none.
double TomlNumberAt(const std::string& text, const std::string& file, const std::string& path);

/// The shortest text of a number that reads back as the same double: "1.0", "1e-07", "inf".
std::string TomlNumber(double value);

}  // namespace ambrig
