#pragma once
/// The models of a case in which a search looks for what is missing. Owns the model of all rows
/// (floors, frequencies) and the one of fewer rows (fits), the noise and the branches in both, the
/// number of independent residuals, and the signatures of effects, which hold for the nuisances and
/// floors that the models have.
#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "discovery/data_gate/data_gate.h"
#include "discovery/search/effect_round.h"
#include "discovery/search/signature_bank.h"

namespace ambrig {

class SearchModels {
 public:
  SearchModels(const Case& c, const std::atomic<bool>* stop, RunStore* store);

  const CaseModel& full() const { return full_; }
  const CaseModel& thinned() const { return thinned_; }
  const Case& data() const { return full_.data(); }
  const RigParameters& rig() const { return full_.data().rig; }
  const NoiseModel& noise() const { return full_.noise_model; }
  double effective_sample_size() const { return effective_sample_size_; }
  SignatureBank& signatures() { return signatures_; }
  void ForgetSignatures() { signatures_ = SignatureBank(); }
  /// Record simulations so far.
  long runs() const { return full_.runs + thinned_.runs; }

  /// Records that this hypothesis does not hold to their end count up to there only; a line for
  /// each.
  /// @throws InputError where no row counts
  std::vector<std::string> LimitToHeld(const Hypothesis& nominal);
  /// Predictions of the rig file and the floors that the stated noise makes of each target.
  struct FoundNoise {
    std::vector<double> clean, stated_floors;
  };
  /// The noise that the records show, and the floors that it makes.
  FoundNoise FindNoise(const Hypothesis& nominal);
  /// Leaves out the first rows of clamped records that begin under a current which nothing states;
  /// a line for each.
  std::vector<std::string> PassOverUnstatedStarts(const std::vector<double>& clean);
  /// Gross errors of the data, none of them hidden by noise that was estimated from them.
  std::vector<DataFault> InspectData(const Hypothesis& nominal, const FoundNoise& found);
  /// Leaves single wrong samples out; a line for each column.
  std::vector<std::string> PassOverLonely(const std::vector<double>& clean);
  /// Floors of all rows and the branches of the rig's tolerances, in both models.
  void UseFloors(const Hypothesis& nominal);
  /// What a reader is told of the noise and the branches.
  std::vector<std::string> Remarks() const;

  /// Nuisances in both models; the signatures stay as they are. As UseNuisancesInBoth.
  void UseNuisances(const std::vector<NuisanceKind>& of_records,
                    const std::vector<NuisanceKind>& of_coils, double coil_doubt);
  /// What stands in both models, to be put back after a trial.
  struct UsedNuisances {
    Nuisances full, thinned;
  };
  UsedNuisances nuisances() const { return {full_.nuisances, thinned_.nuisances}; }
  void SetNuisances(const UsedNuisances& used);

  /// These samples do not count from now on.
  void LeaveOut(const std::vector<SampleSpan>& spans);
  /// A fit to which these samples do not count.
  FitResult FitWithoutRows(const std::vector<SampleSpan>& spans, const Hypothesis& start);
  /// Where some rows count only as far as a hypothesis held the rotor: they count as far as this
  /// one does, and the signatures are forgotten. Whether there were such rows.
  bool CountWhatHolds(const Hypothesis& h);

  /// The floors of both models, rms, and what goes with them.
  struct Floors {
    std::vector<Target> targets;  // of all rows
    double effective_sample_size = 0;
  };
  Floors floors() const { return {full_.targets(), effective_sample_size_}; }
  /// The larger of each floor and of that which noise makes with this hypothesis. False: with noise
  /// it loses its rotor.
  bool RaiseFloors(const Hypothesis& h);
  void SetFloors(const Floors& before);
  /// The same of floors alone, one per target.
  void SetFloors(const std::vector<double>& floors);
  /// The signatures follow floors that were raised from these, and the nuisances over them.
  void RescaleSignatures(const Floors& before);

  /// A fit of the thinned model. `jacobian`: sensitivities of the rig parameters for its first
  /// pass, null: none known.
  FitResult FitFrom(const Hypothesis& start, const Eigen::MatrixXd* jacobian = nullptr) const;
  /// The point itself, with its sensitivities.
  FitResult At(const Hypothesis& h) const;
  /// The same point seen with all rows, without sensitivities.
  FitResult AtAllRows(const FitResult& fit) const;
  /// Only the best of a round were fitted to the end. `before` lends its sensitivities.
  FitResult FittedToTheEnd(const FitResult& before, const FitResult& found) const;
  /// -2 log posterior of a fit of the thinned model with the price of its parameters; smaller is
  /// better.
  double ScoreOf(const FitResult& fit) const;
  double Gain(const FitResult& before, const FitResult& after) const;
  /// What a round of `candidates` full fits works with.
  RoundSetting Round(int candidates, std::function<void(double, const std::string&)> progress);

 private:
  FitOptions Options() const;

  CaseModel full_, thinned_;
  SignatureBank signatures_;
  std::vector<BranchSpan> branches_;
  double effective_sample_size_ = 0;
};

}  // namespace ambrig
