#pragma once
/// One interface for whatever watches the coils of a bearing in a run: the measurements of one
/// switching period go in, alarms and diagnoses come out, and the supervisor acts on them
/// (faulttolerance/supervision/fault_supervisor.h). `[detection] kind` of a rig file names one.
///
/// There are two ways to be one:
///   - A detector that flags only (coil_detector.h: a statistic per coil and a threshold) needs
///     nothing more than its line in detector_catalogue.cc. examined_detector.h makes a RunDetector
///     of it: the alarm is the detector's, the class and the size of the fault come from the
///     examination of the raw samples that bearing_detector.h has (coil_examination.h). An alarm
///     that the examination does not confirm within 12 periods is cleared, and no coil is touched.
///   - A detector that classifies by itself derives from RunDetector and gives its kind
///     (CoilDetectorKind) a `make_run`. BearingDetector ("coupled") is one.
///
/// A detector learns nothing from outside beside RunDetectorSetup and what Period() is given.
#include <memory>
#include <string>
#include <vector>

#include "fdd/diagnosis.h"
#include "fdd/measurement/kept_period.h"

namespace ambrig {

/// What a period led to. `coil`: of the alarm that was raised, cleared or diagnosed, from 0; -1:
/// none.
struct DetectorAlarm {
  bool raised = false;   // in this period, for `coil`
  bool cleared = false;  // in this period: the alarm of `coil` was a false one
  // In this period: `coil` has this share of its turns, more than it was taken to have; 0: not so.
  double restored = 0;
  int coil = -1;
  Diagnosis diagnosis;          // cls other than kNone: decided in this period
  std::vector<Diagnosis> more;  // of other coils, decided together with it
  // Of a coil whose short was told before, -1: none. This share of its turns carries the shaft, by
  // its flux since.
  int carrying = -1;
  double carried = 0;
};

/// Mean slope of a coil's current while its bridge drives up, and the band that a healthy coil
/// keeps to [A/s]; for the report.
struct SlopeBand {
  double slope = 0, expected = 0, half_width = 0;
};

/// Of a coil that a small current is driven through; interrupted: nothing was seen of it, as
/// another coil may have failed meanwhile.
enum class ProbeAnswer { kNone, kHealthy, kFaulty, kInterrupted };

class RunDetector {
 public:
  virtual ~RunDetector() = default;
  /// Called once per switching period, in order, without gaps. Pointers in `in` are valid during
  /// the call only; `in.set_point` is present.
  virtual DetectorAlarm Period(const MeasuredPeriod& in) = 0;
  /// Of the last period; `coil` from 0. Zeros where a detector knows no band.
  virtual SlopeBand Band(int coil) const = 0;
  /// Whether it doubts its own model (not commissioned, outside the commissioned range): then the
  /// supervisor reports but changes no current.
  virtual bool doubtful() const { return false; }

  /// The supervisor has not done what the last diagnosis of a coil says: the coil goes on with this
  /// share of its turns, 0: switched off.
  virtual void SetTurns(int /*coil*/, double /*share*/) {}

  /// A look at a coil that was given up, or that its loop asks for no current: from the next period
  /// on a small current is asked of it. Returns false where the detector cannot take one. No coil
  /// is diagnosed meanwhile.
  virtual bool BeginProbe(int) { return false; }
  /// What the probe that runs has shown so far.
  virtual ProbeAnswer Probed() const { return ProbeAnswer::kNone; }
  /// The current is taken away again at t; `healthy`: a coil that was given up is judged like the
  /// others from now on. Of a coil that had not been given up: its fault, if the probe showed one.
  virtual Diagnosis EndProbe(bool /*healthy*/, double /*t*/) { return {}; }
};

/// A bearing as the controller knows it: nominal circuit, sampling, noise and tolerances.
struct CoilDetectorSetup {
  LinkageModel model;
  DetectorSettings settings;
  std::string bearing = "";        // its name in the rig file
  std::string commissioning = "";  // [detection] commissioning, a path; may be empty
};

struct RunDetectorSetup : CoilDetectorSetup {
  double threshold = 0;  // [detection] threshold, 0: the catalogue's
};

/// The detector of [detection] kind. `where`: file, line and key for the error of an unknown name.
/// @throws InputError
std::unique_ptr<RunDetector> MakeRunDetector(const std::string& kind, const std::string& where,
                                             const RunDetectorSetup& setup);

}  // namespace ambrig
