#pragma once
/// One instance of a rig's FMU, the same for FMI 2.0 and 3.0 (fmu/library): values of its
/// variables, and the run that they drive.
///
/// A state is all values that were set and when: taking one costs nothing, going back to one runs
/// the simulation again up to there and gives the same bits. Nothing else would hold for every
/// controller, effect and detector that a rig can have.
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "fmu/variables.h"

namespace ambrig {

enum class FmuPhase : std::uint32_t { kInstantiated, kInitialising, kStepping, kTerminated };

struct FmuState {
  struct Change {
    long long period = 0;  // since t = 0 of the run, before which
    std::uint64_t reference = 0;
    double value = 0;
  };
  FmuPhase phase = FmuPhase::kInstantiated;
  double start_time = 0, time = 0;           // of the importer [s]
  long long period = 0;                      // of the run
  std::vector<double> start_values, values;  // at the start of the run; now
  std::vector<Change> changes;               // of inputs since

  std::string Bytes() const;
  /// @throws InputError for bytes that are no state of an FMU with so many variables.
  static FmuState FromBytes(const std::string& bytes, std::size_t variables);
};

class FmuInstance {
 public:
  /// `resources`: the folder of the unpacked FMU, which holds setup.json and the rig's files.
  /// @throws InputError
  explicit FmuInstance(const std::filesystem::path& resources);

  const std::vector<FmuVariable>& variables() const { return variables_; }
  FmuPhase phase() const { return state_.phase; }
  double time() const { return state_.time; }

  // All throw InputError for what is not allowed now, NoSolution when the motion diverges.
  double Get(std::size_t reference);
  void Set(std::size_t reference, double value);
  void EnterInitialization(double start_time);
  void ExitInitialization();
  /// From `t` over `h` [s]: all switching periods that end by then.
  void Step(double t, double h);
  void Terminate();
  void Reset();
  const FmuState& state() const { return state_; }
  void Restore(const FmuState& state);

  /// What happened since the last call, a line each.
  std::vector<std::string> TakeEvents();

 private:
  RigParameters RigAsSet() const;
  Scenario ScenarioAsSet() const;
  void Build();
  std::vector<std::size_t> ChangedInputs(const std::vector<double>& values) const;
  void Apply(std::size_t reference, double value);
  void Happen(const FmuVariable& fault);
  void ReadOutputs();

  RigParameters rig_;
  Scenario scenario_;
  std::vector<FmuVariable> variables_;
  std::size_t first_output_ = 0, acceleration_ = 0;
  FmuState state_;
  std::unique_ptr<SteppedRun> run_;
  std::vector<double> applied_;  // values that the run has
  std::vector<double> outputs_;
  std::size_t told_ = 0;  // events
};

}  // namespace ambrig
