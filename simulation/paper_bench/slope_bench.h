#pragma once
/// The experiment of the slope detector's paper on a single coil: what its detector
/// (fdd/detectors/slope.h) makes of records that hold every sample of the converter. The coil is
/// the one magnet of a rig whose rotor is clamped (bearing kind "opposed", one coil), simulated
/// like any other rig.
///
/// Source: [loadcurrentslope] (docs/references.bib), sections 3 and 4; docs/paper.md.
#include <vector>

#include "fdd/detectors/slope.h"
#include "scenarios/scenario.h"
#include "simulation/record/run_result.h"

namespace ambrig {

/// The converter of a rig in the terms of Eq. 19: one volt an ampere over -range to +range.
SlopeConverter ConverterOf(const RigParameters& rig);
/// The nominal coil, centred, and its bridge. @throws InputError when the rig is not one coil
/// ("opposed", coils = 1)
SlopeCircuit SingleCoil(const RigParameters& rig);
/// Name of the current's channel: "M.i1".
std::string CoilCurrent(const RigParameters& rig);

/// Mean slopes of every switching period of a record of single samples.
struct SlopeSeries {
  std::vector<double> t, i0;                   // start of the period [s], first sample [A]
  std::vector<double> increasing, decreasing;  // k̄ [A/s]
  std::vector<double> low, high;               // Eq. 9 and the margin, increasing [A/s]
};
/// @throws InputError when the record does not hold every sample of the converter
SlopeSeries SlopesOf(const RigParameters& rig, const Record& record, double margin);

/// Slopes between neighbouring samples: the steepest one from the start of each on-phase, and the
/// one at its end, means over the record's periods [A/s]. The on-phase lasts `on` samples.
SlopeRange EndsOfOnPhase(const RigParameters& rig, const Record& record, int on);

/// The detector as the paper's processor runs it: one look in a cycle. 0: in every period.
struct DetectorLooks {
  double flagged = -1;  // instant of the first flag [s], -1: none
  FaultClass cls = FaultClass::kNone;
};
DetectorLooks RunPaperDetector(const RigParameters& rig, const Record& record, double cycle,
                               double margin);

/// Time for fault diagnosis with the fault at every place within the cycle.
struct DiagnosisDelays {
  int runs = 0, found = 0, too_early = 0;  // too_early: flagged before the fault
  int named = 0;                           // found, and of the fault's class
  double least = 0, mean = 0, most = 0;    // [s]
};
/// The scenario's only fault is moved in steps of a switching period over `cycle`.
/// @throws InputError when it has not exactly one
DiagnosisDelays DelaysOverCycle(const RigParameters& rig, const Scenario& scenario, double cycle,
                                double margin);

}  // namespace ambrig
