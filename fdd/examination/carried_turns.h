#pragma once
/// Share of a shorted coil's turns that carries the shaft, told by the balance of its voltage over
/// the milliseconds after the fault. A loop of shorted turns keeps its flux for a time constant tau
/// (0.1 to 40 ms), so that neither the ripple nor the instant of the fault shows its size. With the
/// share a of the turns left between the terminals, fluxes from a and the measured currents of all
/// coils (flux_circuit.h), and means over whole periods,
///
///   integral of v dt = a (R integral of i dt + N (phi - phi_0)) + a² L_l (i - i_0),
///   tau dphi/dt = phi_a - phi,      phi_a: flux without the loop's current
///
/// from the last healthy period on. What the bridge adds to its voltage is taken from the same
/// balance before the fault. The pair (a, tau) is sought on a grid by least squares; all a whose
/// error is about as small as the least one are possible, and the share told before moves no
/// further than to the nearest of them. Turns that are bypassed obey the same with tau = 0. Where
/// the current comes near zero the diodes may block, and the balance ends: the volt-seconds of the
/// bridge are not the coil's any more.
#include <array>

#include "fdd/circuit/slope_excess.h"

namespace ambrig {

class CarriedTurns {
 public:
  /// `filter`: of the whole bearing, before its first period.
  CarriedTurns(const FluxFilter& filter, const SamplingSettings& sampling,
               const CoilEquations& coils);

  /// One period; `flux` of it, `mean` currents in it [A].
  void Keep(const MeasuredPeriod& in, const FluxPeriod& flux, const Lane& mean);
  /// Nothing is known of the periods before.
  void Clear();
  /// A short of `coil` was told, with `share` of the turns carrying the shaft, and no less than
  /// `least` by the slopes of the ripple. `onset`: start of the first period that looked faulty
  /// [s]. Nothing follows where too little of before is known.
  void Begin(int coil, double onset, double share, double least);
  /// Other turns of some coil are believed: ends what was not begun in this period.
  void TurnsChange();

  bool running() const { return coil_ >= 0; }
  int coil() const { return coil_; }
  /// Share of the turns that carries, as far as it is told by now [-].
  double share() const { return share_; }
  /// Whether it has moved in the last period.
  bool moved() const { return moved_; }

 private:
  static constexpr int kKept = 24;  // periods
  static constexpr int kMarks = 4;  // places that the bridge's error is told from
  static constexpr int kShares = 14, kLags = 8, kNodes = 3;
  struct Row {
    MeasuredPeriod in;   // without its samples
    Lane duty, mean;     // [-], [A]
    Lane least;          // current in the on phase [A]
    Lane volts, charge;  // integrals up to its end [Vs], [As]
  };
  struct Mark {
    long long count = 0;  // of periods; 0: none
    Lane volts, charge, linkage;
  };
  /// Flux of every pole, by its sense, under the mean currents of a period [A].
  Lane FluxOf(const Row& row, FluxFilter* filter) const;
  Mark MarkAt(const Row& row, long long count) const;
  void Follow(const Row& row);
  /// Moves the share to the nearest of those that are possible.
  void Tell();

  FluxFilter whole_;
  SamplingSettings sampling_;
  CoilEquations coils_;
  std::array<Row, kKept> row_;
  std::array<Mark, kMarks> mark_;
  Lane volts_, charge_;
  long long count_ = 0;

  int coil_ = -1;
  bool moved_ = false, told_ = false;  // in the last period; at any time since it began
  double share_ = 1, least_ = 0;
  double offset_ = 0;              // that the bridge adds in one period [Vs]
  long long followed_ = 0;         // periods
  Row start_;                      // last healthy one
  double flux_ = 0, linkage_ = 0;  // of the coil then [A], [Vs]
  std::array<FluxFilter, kNodes> node_;
  double lagging_[kShares][kLags] = {}, error_[kShares][kLags] = {};  // [A], [Vs^2]
};

}  // namespace ambrig
