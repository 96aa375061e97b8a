#pragma once
/// What every reader does once its channels are in memory: find the time base, check the lengths.
#include <string>
#include <string_view>
#include <vector>

#include "core/record/record.h"

namespace ambrig {

/// t, time, in any case, also with their unit in the name: t_s, t_ms, Time (ms), time_us.
bool IsTimeName(std::string_view name);
/// The unit in such a name ("ms"), empty without one.
std::string TimeUnitOf(std::string_view name);
/// What IsTimeName takes, for messages.
inline constexpr const char* kTimeNames =
    "t, time (s), t [ms], t_ms, Time (ms), with units s, ms, us, ns";

struct TimeBase {
  double rate;   // [Hz]
  double start;  // [s]
};

/// Rate and start of equidistant times t [s]: t_k = start + k / rate, each within `tolerance`
/// periods (default: what a time column of few digits needs).
/// @throws InputError "WHERE: row 17: ...", rows counted from 1 plus `header_rows`.
TimeBase UniformTimeBase(const std::vector<double>& t, const std::string& where,
                         std::size_t header_rows = 0, double tolerance = 0.1);

/// At least one channel, equal lengths, no name twice, a positive finite rate, a finite start.
/// @throws InputError starting with `where`: the name of the file, "cannot write NAME" ...
void CheckRecord(const Record& record, const std::string& where);

/// What every reader does last. Names become UTF-8. A channel of times (unit s, ms, us) is the time
/// base, not a signal: removes it, takes rate and start from it where rate is 0, otherwise
/// checks that they agree. Then CheckRecord. @throws InputError starting with `where`.
void FinishRecord(Record& record, const std::string& where, std::size_t header_rows = 0);

}  // namespace ambrig
