#pragma once
/// Memory and time of a run, known before it starts.
#include <cstddef>
#include <string>

#include "scenarios/scenario.h"
#include "simulation/simulate.h"

namespace ambrig {

/// Columns of a run's record.
std::size_t RecordColumns(const RigParameters& rig, bool clamped);
/// Memory [bytes] of a run with its record: the samples, and once more as the image of the file.
double RunMemory(const RigParameters& rig, const Scenario& scenario, double rate);
/// Computing time [s] on a core of 2020, the settling before t = 0 included, within a factor of
/// four; a rotor that lies in its auxiliary bearings takes longer.
double RunSeconds(const RigParameters& rig, const Scenario& scenario,
                  Fidelity fidelity = Fidelity::kSwitching);
/// "40 s", "12 min", "3.5 h".
std::string DurationText(double seconds);
/// Memory [bytes] that this process may still take.
double FreeMemory();

/// @throws InputError when the rate [Hz] does not divide the switching frequency or the ADC's.
void CheckRecordRate(const RigParameters& rig, double rate, const std::string& where);
/// @throws InputError when the run needs more than nine tenths of the free memory, or more than an
/// hour unless `long_runs`. `rate` 0: the scenario's.
void CheckRunSize(const RigParameters& rig, const Scenario& scenario, double rate, bool long_runs,
                  Fidelity fidelity = Fidelity::kSwitching);

}  // namespace ambrig
