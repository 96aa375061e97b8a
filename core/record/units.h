#pragma once
/// Units of files: everything inside is SI, radians too; conversion happens where a file is read.
///
/// A quantity is named by its SI unit. Units are compared after normalising: the signs µ and μ
/// become u, Ω becomes ohm, ° deg, exponents ² ^2 become 2, white space is reduced; words that
/// instruments write ("Volts", "sec") become their signs.
#include <string>
#include <string_view>

#include "core/record/record.h"

namespace ambrig {

/// value in `to_si` = UnitFactor(from, to_si) * value in `from`.  `to_si` is an SI unit of the
/// table (m, N, A, V, rad, rad/s, s, Hz, K, -, ohm, H, kg, kg m2 ...) or any text equal to `from`
/// after normalising ("N s/m"). Speeds are rad/s: Hz to rad/s is revolutions per second (2π).
/// degC is a difference of temperatures.
/// @throws InputError "WHERE: unit um, allowed A, mA, uA", `where` (file, key) may be empty.
double UnitFactor(std::string_view from, std::string_view to_si, std::string_view where = "");

/// The SI unit of the quantity that `unit` measures ("um" -> "m", "rpm" -> "rad/s", "Hz" -> "Hz");
/// a unit outside the table is its own, normalised; empty stays empty (unknown).
std::string SiUnit(std::string_view unit);

/// Whether the unit is in the table.
bool KnownUnit(std::string_view unit);

/// Converts every channel to the SI unit of its quantity; channels without unit stay as they are.
void ConvertToSi(Record& record);

}  // namespace ambrig
