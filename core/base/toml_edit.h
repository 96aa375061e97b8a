#pragma once
/// TOML files written again with some values changed. Comments and layout are lost, every value
/// stays the same double.
#include <string>
#include <variant>
#include <vector>

namespace ambrig {

/// "controller.kp", "controller.filter[0].frequency", "controller.speeds[1]",
/// "bearings.Z.controller.kd"; a key that is not there yet is added.
struct TomlEdit {
  std::string path;
  std::variant<double, std::string> value;
};

/// `text` (of `file`, for errors) with the edits made; a number written { value, sd } keeps its sd.
/// Relative names under a key `file` become absolute, beside `file`, so that the text may be stored
/// elsewhere.
/// @throws InputError for a path through something that is not there or not of its kind.
std::string EditedToml(const std::string& text, const std::string& file,
                       const std::vector<TomlEdit>& edits);

/// The number at a path; of { value, sd } the value. @throws InputError when there is none.
double TomlNumberAt(const std::string& text, const std::string& file, const std::string& path);

}  // namespace ambrig
