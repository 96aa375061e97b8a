#pragma once
/// The lockstep update of up to eight coils of one bearing, one lane each.
///
/// State is the linkage λ of each driven winding. With leakage L_l per coil the circuit is solved
/// pole by pole (Norton form), so the inverse of the diagonal-plus-rank-one L costs O(8):
///
///   λ* = λ + ∫v dt - (R h/2) i                 trapezoid; ∫v exact, the switching edge included
///   φ (1/P + n c) = c λ* - U,   c = n/(L_l + R h/2)
///   i = (λ* - n φ)/(L_l + R h/2),   λ = n φ + L_l i
///
/// n is the signed number of turns. U is the rotor's potential: Σφ = 0 over the poles (radial), the
/// two windings of a side share a core (thrust), or none (opposed magnets). A coil whose diodes
/// block (off, i = 0) has c = 0: it carries no current and its linkage follows the others' flux.
/// Because every λ depends on its own voltage only, blocking inside a step leaves no error.
///
/// Source: docs/theory/base_model.md sections 2, 3, 6; docs/theory/engine.md.
#include <array>
#include <functional>
#include <vector>

#include "actuators/magnetics/flux_law.h"
#include "actuators/magnetics/network_lanes.h"
#include "actuators/magnetics/stator_geometry.h"
#include "actuators/magnetics/stator_loop.h"
#include "actuators/magnetics/stator_sample.h"

namespace ambrig {

/// Turns of one coil shorted through a resistance: a winding on its pole that nobody drives.
struct ShortedTurns {
  int coil = 0;
  double n = 0, leakage = 0, resistance = 0;  // signed turns, [H], of the whole loop [ohm]
  double lambda = 0, i = 0;                   // [Wb], [A]
  double theta = 0.5;                         // implicitness of a step, fitted to R h / L
  double target = 0;                          // λ* of the present step [Wb]
};

/// Its geometry is the true one: effects move gaps and change reluctances of this
/// copy. Lanes beyond `coils` stay inert (no turns, blocked).
class StatorLanes : public StatorGeometry {
 public:
  std::vector<FluxLaw*> laws;        // iron laws, empty for ideal iron
  std::vector<ShortedTurns> shorts;  // any number, several on one coil too
  std::array<bool, kLanes> open{};   // broken for good
  bool unipolar = true;              // two-quadrant bridges: i >= 0
  /// All switches open: the current ends, of either sign, and its diodes block until the
  /// bridge drives again.
  std::array<bool, kLanes> released{};

  // State.
  Lane lambda, i, phi;  // [Wb], [A], [Wb]
  std::array<bool, kLanes> blocked{};

  // Results of the last period.
  Lane samples[160];      // i at the start of every step [A]
  double fx = 0, fy = 0;  // mean force [N]

  void SetStep(double h);  // [s] between ADC samples
  /// Sets currents and linkages of a standing start at (x, y).
  void Settle(const Lane& currents, double x, double y);
  /// One step of h where Settle has put the shaft, under these currents: the iron laws remember it.
  /// Not for any stator (coupling kNetwork), which has no laws.
  void StepCurrents(const Lane& currents);
  /// Recomputes currents and flux from the linkages after a parameter changed (fault).
  void Refresh(double x, double y);
  /// Coil j breaks: its current is gone, the other linkages stay.
  void Break(int j, double x, double y);
  /// A fraction s of the turns that coil j still drives is shorted through r [ohm] (infinite:
  /// bypassed).
  void ShortTurns(int j, double s, double r, double x, double y);

  /// One switching period of `samples_per_period` steps while the gap moves from (x0, y0) to
  /// (x1, y1); constant bus, ideal iron, no shorted turns: the fast path.
  void RunPeriod(const VoltagePattern& pattern, double bus, double x0, double y0, double x1,
                 double y1, int samples_per_period);
  /// The same for several bearings side by side: three cost little more than one.
  struct PeriodOfBearing {
    StatorLanes* lanes;
    const VoltagePattern* pattern;
    double x0, y0, x1, y1;
  };
  static void RunPeriods(const PeriodOfBearing* bearings, int count, double bus,
                         int samples_per_period);

  /// The general path, one sample at a time: any flux law, shorted turns, moving bus, late edges.
  void RunGeneralPeriod(const VoltagePattern& pattern, double bus, double x0, double y0, double x1,
                        double y1, int samples_per_period);
  void BeginPeriod(double x0, double y0, double x1, double y1, int samples_per_period);
  void StepSample(const VoltagePattern& pattern, double bus, int k);
  void EndPeriod();
  /// Mean current drawn from the bus over sample k, the last one stepped [A].
  double BusCurrent(const VoltagePattern& pattern, int k) const;

  /// Of the fixed point of a start: none where the circuit is solved at once.
  int RoundsOfSettling() const {
    return coupling == Coupling::kNetwork ? 0 : laws.empty() ? 1 : 200;
  }
  bool NeedsGeneralPath() const {
    return !shorts.empty() || !laws.empty() || coupling == Coupling::kNetwork || SomeRunOut();
  }
  /// Instantaneous force at the present flux.
  void Force(double x, double y, double* out_x, double* out_y) const;
  double FieldEnergy(double x, double y) const;  // [J], ideal iron
  /// Of any stator (coupling kNetwork): what `current` [A] of its coils counts in the
  /// network as drawn, when coils have other turns.
  Eigen::VectorXd CountedCurrents(const double* current) const;

 private:
  double GapAt(int j, double x, double y) const {
    const double gap = gap_offset[j] - x * direction_x[j] - y * direction_y[j];
    const double least = kGapAtPole * reluctance.gap0;
    return gap < least ? least : gap;
  }
  void UpdateConductance(int j);
  void Block(int j);
  void Unblock(int j);
  /// Whether the diodes of a coil block that is not broken.
  bool SomeBlock() const;
  /// Whether a current of either sign runs out through the diodes of a released coil. Currents that
  /// flow one way need no such look: their floor is zero anyway.
  bool SomeRunOut() const;
  StatorSample SampleAt(const VoltagePattern* pattern, double bus, int k);
  void AddLawTerms(LawTerms* terms) const;
  void Converge(const StatorSample& sample, const SampleWork& work, LawTerms* terms);
  bool StepDriven(const StatorSample& sample);
  void StepWithDiodes(const StatorSample& sample);
  /// Flux and currents that carry the targets λ* of `work`, the shorted turns' too, after the
  /// sample's h (0: at once); Newton over the laws.
  void SolveGeneral(const StatorSample& sample, SampleWork* work);
  // Of any stator (coupling kNetwork): the same steps over its whole circuit,
  // stator_lanes_network.cc.
  void BeginNetwork(double x0, double y0, double x1, double y1);
  void PlaceNetwork(double fraction);
  void TakeNetwork();
  void SettleNetwork(double x, double y);
  Lane AmpereTurns() const;
  StatorLoop LoopOver(const VoltagePattern& pattern, double bus);
  void RunChecked(const StatorLoop& loop);
  void OpenDriven(const VoltagePattern& pattern, double t);
  void UnblockDriven(const VoltagePattern& pattern, double bus, double t, Lane* target);

  double h_ = 0;
  Lane half_rh_, inverse_l_, c_;  // R h/2, 1/(L_l + R h/2) (0 when blocked), n * inverse_l
  Lane rel0_, rel1_, g0_, dg_;    // reluctance at both ends, conductance and its change
  Lane pulls_;                    // 1/2 of a lane's (d rel/dg) φ²; 0: no pole of its own
  Lane weight_, sum_, start_sq_;  // force weight, sums of φ²
  double x0_ = 0, y0_ = 0, x1_ = 0, y1_ = 0;
  int per_period_ = 18;
  bool blocks_ = false;  // some diode blocked in the last period
  Lane rel_;
  bool affine_laws_ = true;  // one round of Newton is exact
  // Of any stator: its circuit at both ends of the period and now; forces at its start, of its
  // samples, and at its end [N].
  NetworkPlace start_, end_, now_;
  Eigen::Vector2d force_start_ = Eigen::Vector2d::Zero(), force_sum_ = Eigen::Vector2d::Zero(),
                  force_end_ = Eigen::Vector2d::Zero();
};

}  // namespace ambrig
