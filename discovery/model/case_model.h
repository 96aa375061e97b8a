#pragma once
/// The rig as a function: a hypothesis (rig parameters, effects and their parameters) in, the
/// channels of every record of a case out, sampled where the data are.
#include <algorithm>
#include <atomic>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "discovery/case/case.h"
#include "discovery/model/branch_rows.h"
#include "discovery/model/hypothesis.h"
#include "discovery/model/model_fidelity.h"
#include "discovery/model/noise_model.h"
#include "discovery/model/nuisances.h"
#include "discovery/model/record_predictor.h"
#include "discovery/model/record_subset.h"
#include "discovery/model/run_memo.h"
#include "discovery/model/run_store.h"
#include "discovery/model/target.h"
#include "discovery/model/unpredictable_rows.h"
#include "simulation/sampled/command_plan.h"

namespace ambrig {

/// Runs hypotheses against the records of a case.
class CaseModel {
 public:
  /// One row of `thin` takes part (at alternating phases, so that nothing periodic hides); 1: all.
  explicit CaseModel(const Case& c, std::size_t thin = 1);
  CaseModel(const Case& c, const std::vector<std::size_t>& thin);  // of each record

  const Case& data() const { return case_; }
  const std::vector<Target>& targets() const { return targets_; }
  std::vector<Target>& targets() { return targets_; }
  std::size_t size() const { return measured_.size(); }
  const std::vector<double>& measured() const { return measured_; }
  const std::vector<char>& ok() const { return ok_; }
  /// First row of a record in the flat vectors and the one behind its last.
  std::pair<std::size_t, std::size_t> RowsOf(std::size_t record) const;
  /// Index of a row in its channel.
  std::size_t sample(std::size_t row) const { return sample_[row]; }

  /// Predicted values in the order of the targets; nullopt when the hypothesis falls out of
  /// control.
  std::optional<std::vector<double>> Predict(const Hypothesis& h) const;
  /// The same with noise of a seed: what the data would look like again.
  std::optional<std::vector<double>> PredictNoisy(const Hypothesis& h, std::uint64_t seed) const;
  /// Many at once on all cores, in order. What is predicted coarsely is to be compared with coarse
  /// predictions only. With a `look`, some records only.
  std::vector<std::optional<std::vector<double>>> PredictAll(
      const std::vector<Hypothesis>& all, ModelFidelity fidelity = ModelFidelity::kAsSampled,
      const RecordSubset* look = nullptr) const;
  /// Simulated record of one record's scenario, which is over time. `channels`: those wanted;
  /// empty: all. `rows`: those wanted besides the last one (SimulatedRows); nullptr: all.
  Record Simulated(const Hypothesis& h, std::size_t record, bool noise, std::uint64_t seed,
                   const std::vector<std::string>& channels = {},
                   const std::vector<std::size_t>* rows = nullptr) const;
  /// The same with the channels of the data; nullopt: the motion became infinite, this hypothesis
  /// cannot be.
  std::optional<Record> SimulatedChannels(const Hypothesis& h, std::size_t record, bool noise,
                                          std::uint64_t seed,
                                          const std::vector<std::size_t>* rows = nullptr) const;

  /// Records that this hypothesis does not hold to their end count up to there only, those that it
  /// loses at once do not count. Returns one line for each.
  std::vector<std::string> LimitToHeld(const Hypothesis& h);
  /// Counts as many rows of each record as `other`, a model of the same case.
  void LimitAs(const CaseModel& other);
  /// These samples of all channels of their records do not count from now on.
  void LeaveOut(const std::vector<SampleSpan>& spans);
  /// The rows that LeaveOut has left in, a flag each; SetSound puts an earlier state of them back.
  const std::vector<char>& sound() const { return sound_; }
  void SetSound(std::vector<char> rows);
  /// Whether the measured rotor reaches its auxiliary bearings in some record.
  bool touches() const { return std::ranges::count(touches_, 0) < std::ssize(touches_); }
  /// Whether some record counts in part only.
  bool limited() const { return std::ranges::count(horizon_, kInfinity) < std::ssize(horizon_); }

  NoiseModel noise_model;          // as stated, until EstimateNoise
  Nuisances nuisances;             // eliminated from every residual; none at first
  std::vector<RowRange> branches;  // rows whose errors count little (branch_rows.h); none at first
  mutable std::atomic<long> runs{0};  // record simulations so far
  const std::atomic<bool>* stop = nullptr;
  RunStore* store = nullptr;  // looked up before a record is simulated

 private:
  bool SimulateRecord(const RigParameters& rig, std::size_t record, bool noise, std::uint64_t seed,
                      std::vector<double>& out) const;
  /// From the disk where a store is kept, else simulated.
  bool SimulateOrFind(const RigParameters& rig, std::size_t record, bool noise, std::uint64_t seed,
                      std::vector<double>& out) const;
  /// Samples of a record's longest channel that take part; a shorter one has the first of them.
  std::span<const std::size_t> SamplesOf(std::size_t record) const;
  /// Of a record that is not over time.
  bool PredictPoints(const RigParameters& rig, std::size_t record, std::vector<double>& out) const;
  bool FillRecord(const RigParameters& rig, std::size_t record, bool noise, std::uint64_t seed,
                  std::vector<double>& out) const;

  /// Rows behind a record's horizon do not count.
  void ApplyHorizons();

  const Case& case_;
  std::vector<double> horizon_;  // [s] of each record's scenario that is simulated; infinity: all
  std::vector<char> touches_;    // of each record: the measured rotor touches something
  std::vector<std::size_t> order_;  // in which the records are simulated
  std::vector<char> sound_;         // rows as the data-quality pass left them
  std::vector<Target> targets_;
  std::vector<double> measured_;
  std::vector<char> ok_;
  std::vector<std::size_t> sample_;
  std::vector<std::unique_ptr<CommandPlan>> plans_;           // of records over time
  std::vector<std::unique_ptr<RecordPredictor>> predictors_;  // of all others
  std::vector<Record> driving_;  // of records with imposed motion, else empty
  mutable RunMemo memo_;
};

}  // namespace ambrig
