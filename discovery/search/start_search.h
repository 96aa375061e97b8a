#pragma once
/// Starts of effects that answer to their law far from linearly (resonances, contact): only a
/// simulation tells what a start explains, so many are simulated, on the records that show most of
/// the error.
#include <vector>

#include "discovery/search/fit.h"
#include "discovery/search/probes.h"

namespace ambrig {

/// A start, its score (likelihood.h) with the rig parameters as they are (infinity: the rotor is
/// lost) and the share of the squared error above the noise that it explains on the records looked
/// at (below 0: it adds).
struct SimulatedStart {
  EffectInstance effect;
  double score = kInfinity, share = 0;
  double amount = 1;  // of its answer that the error of responses asks for, by least squares
};

/// Where starts are tried: on top of `now`, on the fitted records of free rotors that hold most of
/// its error. Throws InputError where the plant refuses the effect.
class StartSearch {
 public:
  StartSearch(const CaseModel& model, const FitResult& now, double effective_sample_size);

  /// Score without an effect, same fidelity as the starts' scores.
  double here() const { return here_; }
  /// Whether effects that the rig file does not have are in the model already.
  bool beside_others() const { return beside_others_; }
  /// Whether a start is worth more simulations: it gains score, and beside effects that were
  /// adopted, whose laws leave details, a tenth of what is left where it is largest (to be adopted
  /// it has to explain most of it).
  bool Explains(const SimulatedStart& s) const;
  /// Fills in the scores.
  void Simulate(std::vector<SimulatedStart>& starts) const;
  /// Moves each start to the neighbour (size, frequency, one of two gains) that explains most until
  /// none explains more: a loop that a resonance brings near its limit answers out of all
  /// proportion to the size, and at another frequency than the resonance's own. One that loses the
  /// rotor, or explains less than nothing, shrinks first. The steps become finer; the finest are
  /// taken by the better half of the starts, and beside adopted effects only by those that explain
  /// something by then. Leaves all, best first.
  void Climb(std::vector<SimulatedStart>& starts) const;

 private:
  const CaseModel& model_;
  const FitResult& now_;
  double effective_sample_size_;
  /// Σ r² less the noise's, of the records looked at.
  double Excess(const std::vector<double>& residual) const;

  /// Of what a start changes, by the residuals without and with it.
  double AmountOf(const std::vector<double>& residual) const;

  RecordSubset look_;
  std::vector<double> residual_;  // without a start, where responses are looked at; else empty
  double here_ = 0, excess_ = 0;
  bool beside_others_;
};

/// Whether two starts differ in size only: frequency and the signs of their values are the same.
bool SameValley(const EffectInstance& a, const EffectInstance& b);

/// Starts `estimated` from the records (resonance_starts.h) in several sizes and, unless one of
/// them explains much or adopted effects stand beside, the probes of one narrow effect (`groups`:
/// of a resonance, a frequency each) in several sizes and patterns of their gains: those that
/// explain most, each as a probe of finite size. Empty where none explains anything.
std::vector<ProbeGroup> ScanStarts(const StartSearch& search, const std::vector<ProbeGroup>& groups,
                                   const std::vector<EffectInstance>& estimated);

}  // namespace ambrig
