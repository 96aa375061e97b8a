#pragma once
#include <map>
#include <string>

#include "app/pages/run_report.h"
#include "simulation/verdict/expect.h"

namespace ambrig {

/// A run turned into what its report shows.
RunReportData MakeRunReportData(const RigParameters& rig, const Scenario& scenario,
                                const RunResult& result, const std::vector<ExpectResult>& expect,
                                const std::string& fidelity);

/// Peak orbit [m] of every named plane of a beam rotor about its place at the start, at the rows of
/// the record.
std::map<std::string, double> StationOrbits(const RigParameters& rig, const Record& record);

/// One line for a person: "detected open at A.coil3" and the like.
std::string EventText(const RunEvent& event);

}  // namespace ambrig
