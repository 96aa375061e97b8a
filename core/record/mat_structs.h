#pragma once
/// Structs of MATLAB files that hold signals and their time:
///
///   dSPACE ControlDesk   s.X(i).Data times; s.Y(k).Name, .Data, perhaps .Unit, .XIndex
///   Simulink             s.time; s.signals(k).values (rows x signals), .label
///                        ("structure with time", of To Workspace and Scope)
///   struct(timeseries)   s.Time; s.Data
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/record/mat_library.h"
#include "core/record/time_groups.h"

namespace ambrig::mat {

struct TimedStruct {
  std::vector<TimedChannel> channels = {};
  std::vector<std::string> notes = {};  // without the file's name
};

/// nullopt for any other struct. `check` throws for an array that is not whole.
/// @throws InputError starting with `path`
std::optional<TimedStruct> ReadTimedStruct(
    const matvar_t& v, const std::string& name, const std::string& path,
    const std::function<void(const matvar_t&, const std::string&)>& check);

/// Objects of MATLAB's classes (timeseries, timetable, Simulink.SimulationOutput, table ...), whose
/// content only MATLAB knows.
bool IsObject(const matvar_t& v);
/// What to do about one.
std::string ObjectText(const std::string& name);

}  // namespace ambrig::mat
