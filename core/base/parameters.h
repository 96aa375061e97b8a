#pragma once
/// Table-driven parameters: one table per struct is the only place that knows key, unit, range and
/// meaning. The reader, the range check, `--help`, docs/parameters.md and the bounds of a fit walk
/// it.
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "core/base/errors.h"

namespace ambrig {

/// Default of a parameter that has none: the file must give it.
inline constexpr double kRequired = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// One row of a parameter table.
template <class P>
struct Field {
  std::string_view key;   // TOML key
  double P::*at;          // where it lives
  std::string_view unit;  // SI, "-" if dimensionless
  double lo, hi;          // physically possible, closed interval
  std::string_view doc;   // one line
};

/// "where.key = value unit, allowed lo to hi unit (doc)", thrown as InputError.
[[noreturn]] void ThrowOutOfRange(std::string_view where, std::string_view key, double value,
                                  std::string_view unit, double lo, double hi,
                                  std::string_view doc);

/// Throws InputError for the first field outside its range. `where(key)` gives "rig.toml:31:
/// bearings.A.gap".
template <class P, std::size_t n, class Where>
void CheckRanges(const P& p, const Field<P> (&fields)[n], const Where& where) {
  for (const Field<P>& f : fields) {
    const double value = p.*f.at;
    if (f.lo <= value && value <= f.hi) continue;
    ThrowOutOfRange(where(f.key), f.key, value, f.unit, f.lo, f.hi, f.doc);
  }
}

/// Shortest text that reads back as the same double.
std::string NumberText(double value);

}  // namespace ambrig
