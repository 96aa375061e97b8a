#pragma once
/// The plant of a rig as one set of smooth equations between events, for the reference and the
/// averaged engine:
///
///   dλ_w/dt = v_w - R_w i_w          every winding that carries current
///                                    (actuators/magnetics/coil_network.h)
///   q' = v,  v' = a(q, v, magnetic forces, loads, contacts, effects)    rotor/motion/rotor_model.h
///   theta' = Omega, Omega' = 0 or torque / Ip where the speed is free
///
/// Events where the equations change are roots of the integrator: a current that reaches zero
/// (its diodes block), a blocked coil that is driven and would carry current again
/// (n dφ/dt falls to v), contact made or lost. Together with the state run the integrals of force,
/// of current and the energies, so that means and balances are as accurate as the motion:
///
///   electrical + drive = copper + Δfield + Δrotor + contact losses
///
/// where `drive` is the work of the motor that keeps a prescribed speed, and of the scenario's
/// loads. (Races, mounts, bases and effects have energies and losses of their own, not counted.)
/// Source: docs/theory/base_model.md sections 1 to 3, 6, 8.
#include <memory>
#include <vector>

#include "actuators/magnetics/coil_network.h"
#include "core/math/cvode.h"
#include "simulation/sampled/sampled_data_loop.h"

namespace ambrig {

struct IntegratorOptions {
  double tolerance = 1e-10;  // relative, of a step
  int order = 5;             // of ARKODE's explicit Runge-Kutta method
  bool stiff = false;        // CVODE's BDF instead: stiff shorted turns
  /// What a run may cost, steps and events on the average: a healthy rig takes 50, one in hard
  /// contact some hundreds.
  long steps_a_period = 5000;
};

inline constexpr long kStepsAtOnce = 20000;  // of the integrator

/// All since the start of the run [J]. The rates that make them are in ContinuousRig::Rhs.
struct EnergyBalance {
  double electrical = 0, drive = 0;  // in
  double copper = 0, contact = 0;    // out, for good
  double magnetic_work = 0;          // of the magnets on the rotor
  double field = 0, rotor = 0;       // stored now
};

class ContinuousRig {
 public:
  ContinuousRig(SampledDataLoop& rig, const IntegratorOptions& options);

  /// Coils carry the set-points at the present motion.
  void Settle();
  /// Local time back to 0 at t_n; integrals of force and current start again.
  void BeginPeriod(long long n);
  /// What a coil's bridge does from now on.
  struct Drive {
    double volts = 0;       // [V]; of a released coil of four quadrants its size only
    bool driven = false;    // its switches are closed, so that a current may rise from zero
    bool released = false;  // all are open: a current of either sign ends
  };
  void SetVoltage(std::size_t b, int j, const Drive& drive);
  /// Integrates to local time tau [s], handling every event on the way.
  void AdvanceTo(double tau);
  // Faults of a coil's circuit.
  void BreakCoil(std::size_t b, int coil);
  /// A share of the coil's turns, closed by `resistance` [ohm]; infinite: bypassed.
  void ShortTurns(std::size_t b, int coil, double share, double resistance);
  /// Copies motion and mean forces back to the sampled side.
  void EndPeriod();

  double Current(std::size_t b, int j) const { return now_[b].i[static_cast<std::size_t>(j)]; }
  double MeanCurrent(std::size_t b, int j, double over) const;  // [A], since BeginPeriod
  /// Present currents and fluxes (recomputed after every AdvanceTo).
  const NetworkState& network(std::size_t b) const { return now_[b]; }
  EnergyBalance Energies() const;
  long events() const { return events_; }
  /// Rotor state at local time tau of the state vector y.
  MotionState MotionOf(double tau, const double* y) const;

 private:
  struct Bearing {
    CoilNetwork network;
    std::size_t at = 0;  // its λ in the state; ∫f and ∫i likewise
    std::size_t force_at = 0, charge_at = 0;
    std::array<double, kLanes> volts{};
    std::array<bool, kLanes> driven{};
    /// Sign of the current at whose end the diodes block, 0: of none.
    std::array<int, kLanes> way{};
    std::vector<int> loops;  // per fault of the scenario that adds a winding, in its order
    explicit Bearing(const StatorLanes& lanes) : network(lanes) {}
  };
  void LayOut();
  OdeProblem MakeProblem(const IntegratorOptions& options);
  void Rhs(double tau, const double* y, double* f) const;
  void Roots(double tau, const double* y, double* g) const;
  void HandleRoots(const std::vector<int>& roots);
  void DecideConduction(std::size_t b, int must_block, int must_carry);
  void Place(std::size_t k, const MotionState& s, double* x, double* y) const;
  double ContactLoss(const MotionState& s, double* spin_torque) const;
  void Slopes(const Bearing& b, const NetworkState& s, double* slope) const;
  void Restart();
  void Refresh();
  void CountSteps();

  SampledDataLoop& rig_;
  std::vector<Bearing> bearings_;
  std::vector<DofVector> load_Q_;  // of every load of the scenario
  DofVector active_load_{};
  bool free_spin_ = false, restart_ = true;
  std::size_t energy_at_ = 0, q_at_ = 0, v_at_ = 0, spin_at_ = 0;
  std::vector<double> y_, absolute_;
  std::vector<NetworkState> now_;
  double t0_ = 0, tau_ = 0;  // [s]
  long events_ = 0;
  long long periods_ = 0, steps_ = 0;  // begun; of the integrator so far, events included
  long counted_ = 0;                   // of them since its last start
  long steps_a_period_;
  std::unique_ptr<OdeSolver> solver_;
};

}  // namespace ambrig
