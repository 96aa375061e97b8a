#pragma once
/// A study file (TOML): detectors of coil faults on the same healthy and faulty runs. The runs are
/// those of two campaign files; docs/guide/detectors.md explains each key by example.
#include "campaign/detector_trial.h"
#include "campaign/journal.h"
#include "campaign/run_plan.h"

namespace ambrig {

struct DetectorStudy {
  std::string name, file, fingerprint;  // of the file and all that it names
  Campaign healthy, faulty;             // the latter: one coil fault in every run
  std::vector<CoilDetectorKind> detectors;
  TrialSettings trial;
  // false alarms per coil and window at which detectors are compared
  double budget = 1e-4;

  std::size_t runs() const { return healthy.runs() + faulty.runs(); }
};

/// @throws InputError "file:line: key = value, allowed ..." for every mistake.
DetectorStudy ReadDetectorStudy(const std::string& file);

/// Runs 0 .. healthy.runs() - 1 are the healthy campaign's, then come the faulty one's.
class DetectorStudyPlan {
 public:
  explicit DetectorStudyPlan(const DetectorStudy& study);
  const DetectorStudy& study() const { return study_; }
  JournalHeader Header() const;
  /// Columns of the table: conditions, one per detector, note.
  std::vector<std::string> Columns() const;
  /// Simulates a run with all detectors watching and none acting. Thread-safe. A run that the
  /// program cannot finish is a row too, its reason in the note. @throws Interrupted
  Row Simulate(std::size_t run, const std::atomic<bool>* stop) const;

 private:
  DetectorStudy study_;
  RunPlan healthy_, faulty_;
};

/// What a row says.
struct DetectorStudyRow {
  bool faulty = false;
  double fault_time = 0;  // [s]
  // kind and coil of the fault: "partial-short fraction=0.1", "A:3"
  std::string scenario, kind, coil, plant, note;
  // one per detector; empty when the run could not be finished
  std::vector<DetectorOutcome> outcomes;
};
/// @throws InputError when the row has not the cells of a study with that many detectors.
void CheckDetectorStudyRow(const Row& row, std::size_t detectors, const std::string& where);
/// @throws InputError when it is no row of a study with that many detectors.
DetectorStudyRow ParseDetectorStudyRow(const Row& row, std::size_t detectors);

}  // namespace ambrig
