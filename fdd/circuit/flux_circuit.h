#pragma once
/// The magnetic circuit of one bearing with what its iron adds, driven by measured currents, and
/// the slopes of its fluxes in both phases of a switching period. All coils at once, one lane each.
///
/// psi [A]: flux of a pole as the magnetomotive current that the nominal gap asks for,
/// psi = phi R_gap/|n|. At ADC sample k, of step h, with i of this sample:
///
///   rho_j psi_j + sum_m e_jm + sb psi^7/3^6 + sa psi^15/3^14 = s_j i_j - u
///   rho = (R(g)/R(g0) + path)/(1 + fringing (g/g0 - 1)),   g = g0 - (x - dx) c - (y - dy) d
///   e_m <- a_m e_m + b_m (psi - last psi),  a_m = exp(-p_m h),  b_m = r_m (1 - a_m)/(p_m h)
///
/// x, y: as measured, less the run-out. u: potential of the rotor, from sum psi = 0 (radial); on a
/// thrust side both windings add up and u = 0. The four poles p_m are fixed (kRelaxationPoles),
/// only their residues r_m are learned: a free pole sticks in local minima. Every relaxation of the
/// iron, eddy currents first, is a sum of such terms. The powers of psi are a tangent at the last
/// sample: no iteration.
///
/// Samples that do not count in the slopes: the first two of a period and the first after the edge,
/// so that dead time up to 4 us and errors of the edge do no harm; of an off phase those at which
/// the diodes may have ceased to conduct.
#include <array>

#include "fdd/circuit/run_out.h"
#include "fdd/measurement/period_slopes.h"

namespace ambrig {

inline constexpr int kRelaxations = 4;
inline constexpr double kRelaxationPoles[kRelaxations] = {100, 1200, 12e3, 120e3};  // [Hz]

/// What a bearing's circuit has beside the nominal one; all zero: nothing. The numbers trade
/// against each other: together they predict fluxes, one alone is no property of the bearing.
struct FluxCircuit {
  double dx = 0, dy = 0;                             // zero of the position sensors [m]
  double path = 0;                                   // iron over the nominal gap [-]
  double fringing = 0;                               // [-]
  std::array<double, kRelaxations> relaxation = {};  // r_m [-]
  double knee7 = 0, knee15 = 0;                      // sb, sa [-]
  RunOut run_out;                                    // of the position sensors
};

/// One phase of a period. Lanes of a phase without three samples hold zeros.
struct FluxPhase {
  Lane samples;  // that count
  Lane flux;     // slope of s psi [A/s]
  Lane current;  // slope [A/s]
  Lane mean;     // current [A]
  Lane voltage;  // of the healthy bridge [V]
  Lane scale;    // variance of a slope over that of a sample [1/s^2]
};

struct FluxPeriod {
  FluxPhase phase[2];  // on, off
  Lane flux;           // psi at the last sample [A]
  Lane largest_flux;   // |psi| of the period [A]
  Lane largest;        // sample of the period [A]
  // smallest sample of the on phase; of the whole period where all are above kSurelyConducts [A]
  Lane least_on;
  Lane own;               // d psi/d i within one sample [-]
  bool conducts = false;  // every sample of every coil is above kSurelyConducts
};

class FluxFilter {
 public:
  /// `nominal` as the controller knows the bearing.
  FluxFilter(const LinkageModel& nominal, const SamplingSettings& sampling,
             const FluxCircuit& circuit);

  /// The next period; the first one starts at rest, with the iron's currents decayed.
  void Period(const MeasuredPeriod& in, FluxPeriod* out);
  /// Forgets the past: the next period starts at rest.
  void Restart() { started_ = false; }
  /// A coil keeps this share of its turns from now on; 0: it carries no magnetomotive force,
  /// whatever its reading says.
  void SetTurns(int coil, double share) { turns_[coil] = share; }

  const LinkageModel& nominal() const { return model_; }
  const FluxCircuit& circuit() const { return circuit_; }
  /// M0 of every coil: n^2 over the nominal gap's reluctance [H].
  const Lane& inductances() const { return inductance_; }

  /// State between samples: psi of the last one, a_m (e_m - b_m psi) of the poles that
  /// have a residue.
  struct State {
    Lane psi;
    Lane held[kRelaxations];
  };
  const State& state() const { return state_[now_]; }
  /// The state before the last period.
  const State& before() const { return state_[1 - now_]; }
  /// Goes on from a state of this filter or of another one of the same circuit.
  void Resume(const State& state) {
    state_[now_] = state;
    started_ = true;
  }
  /// Constants of a period in lanes.
  struct Step {
    Lane rho, rho_change;  // at its start, over the period
    // of the poles that have a residue, then zeros: a_m, a_m b_m (1 - a_m)
    double decay[kRelaxations] = {}, gain[kRelaxations] = {};
    double total = 0, of_last = 0;  // sum b_m, sum b_m (1 - a_m)
  };

 private:
  void Begin(const MeasuredPeriod& in, FluxPeriod* out);
  /// Takes the reluctances of a period's positions.
  void Follow(const MeasuredPeriod& in);
  void SetBridge(const MeasuredPeriod& in, Lane* edge, FluxPeriod* out) const;

  LinkageModel model_;
  SamplingSettings sampling_;
  FluxCircuit circuit_;
  bool round_;                                     // no run-out
  Lane turns_, sense_, inductance_, per_nominal_;  // per_nominal_: 1/R(g0) [H]
  Step step_;
  State state_[2];    // after the last period, before it
  int now_ = 0;       // which of them
  int relaxing_ = 0;  // poles that have a residue
  bool started_ = false;
};

}  // namespace ambrig
