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

/// Instant from which on the shaft is past a pole face and nothing of it is a figure [s]; infinity:
/// never.
double ModelEnd(const RunResult& result);

/// Peak orbit [m] of every named plane of a beam rotor about its place at the start, at the rows of
/// the record up to ModelEnd.
std::map<std::string, double> StationOrbits(const RigParameters& rig, const RunResult& result);

/// For a run whose detector doubted its model: that it has not learnt the rig (ambrig commission),
/// or for which share of the run it doubted what it has learnt. Empty: it did for less than one per
/// cent of it.
std::string DoubtfulModelNote(const RigParameters& rig, const RunResult& result);

/// Whether the rig has an auxiliary bearing, to which a clearance can be left.
bool HasAuxiliary(const RigParameters& rig);

/// One line for a person: "detected open at A.coil3" and the like.
std::string EventText(const RunEvent& event);

}  // namespace ambrig
