#pragma once
/// Checked numbers of a campaign file.
#include <vector>

#include "core/base/toml.h"

namespace ambrig {

/// One number or a list of different ones. @throws InputError
std::vector<double> List(const TomlTable& t, const char* key, const std::vector<double>& fallback,
                         double lo, double hi, const char* unit);
/// @throws InputError
double In(const TomlTable& t, const char* key, double fallback, double lo, double hi,
          const char* unit);

}  // namespace ambrig
