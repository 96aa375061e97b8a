#pragma once
/// A run of the switching engine whose clock and inputs are somebody else's: one switching
/// period at a time, with references, forces, loads, speed and faults that change between
/// two periods. Without inputs it is the scenario's run, bit by bit.
#include <memory>
#include <string>
#include <vector>

#include "faulttolerance/supervision/fault_supervisor.h"
#include "simulation/sampled/channel_values.h"
#include "simulation/sampled/command_plan.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {

/// In force from the next period on (reference and force: from the controller's next tick on), on
/// top of the scenario's own.
struct SteppedInputs {
  std::vector<double> reference, force;  // per axis of the rig [m], [N]
  std::vector<Lane> current;             // per bearing, added to the coils' set-points [A]
  std::vector<PlanePoint>
      load;  // on the shaft: at the magnets of every bearing, at every station [N]
};

/// One number that a stepped run shows.
struct SteppedOutput {
  enum class Kind { kChannel, kSlope, kInUse, kContact };
  std::string name, unit, words;
  Kind kind = Kind::kChannel;
  ChannelValues::Column column{};  // of a channel
  std::size_t bearing = 0;         // of a coil
  int coil = 0;
  bool yes_no() const { return kind == Kind::kInUse || kind == Kind::kContact; }
};

class SteppedRun {
 public:
  /// @throws InputError when a controller cannot be made.
  SteppedRun(const RigParameters& rig, const Scenario& scenario);
  ~SteppedRun();
  SteppedRun(const SteppedRun&) = delete;
  SteppedRun& operator=(const SteppedRun&) = delete;

  SteppedInputs inputs;
  /// The shaft turns with `speed` [rad/s] from now on, growing by `acceleration` [rad/s2];
  /// the rest of the scenario's profile is given up. Without effect where the scenario leaves
  /// the speed free.
  void SetSpeed(double speed, double acceleration);
  double speed() const {  // now [rad/s]
    return engine_->loop().plant.rotor.speed().Speed(static_cast<double>(n_) * T());
  }
  /// A fault at the beginning of the next period.
  void AddFault(FaultSpec fault);

  /// From the scenario's start through its warm-up to t = 0.
  void Start();
  /// One switching period. @throws NoSolution when the motion diverges.
  void Period();
  long long periods() const { return n_; }  // since t = 0
  double T() const { return engine_->loop().T; }

  const std::vector<SteppedOutput>& outputs() const { return outputs_; }
  /// All outputs as of now, the beginning of period periods(): as in a record's row, but set-points
  /// and duties are those of the period that has ended. Yes and no are 1 and 0.
  void Read(std::vector<double>& values);
  const std::vector<RunEvent>& events() const { return engine_->events(); }

 private:
  struct LoadedRotor;
  void AddCommands();
  void ListOutputs();
  void ApplyInputs();
  double Value(const SteppedOutput& output);

  const RigParameters rig_;
  const Scenario scenario_;
  CommandPlan plan_;  // the scenario's signals, then one live value per input
  std::size_t first_reference_ = 0, first_force_ = 0, first_current_ = 0;
  std::unique_ptr<FaultSupervisor> supervisor_;
  std::unique_ptr<SwitchingEngine> engine_;
  std::unique_ptr<ChannelValues> values_;
  std::vector<SteppedOutput> outputs_;
  std::vector<std::vector<double>> speed_rows_;  // [s], [rad/s]
  bool started_ = false;
  long long n_ = 0;
};

}  // namespace ambrig
