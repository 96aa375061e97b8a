#pragma once
/// The search behind Explain: its state and its steps.
#include <optional>

#include "discovery/decision/unit_errors.h"
#include "discovery/explain/explain.h"

namespace ambrig {

/// What was found of the records and is set right exactly, after which the search begins again. One number for each
/// record; empty: nothing.
struct RecordsSetRight {
  std::vector<int> rows_late;
  std::vector<double> inputs_larger;
  bool any() const { return !rows_late.empty() || !inputs_larger.empty(); }
};

class Explainer {
 public:
  Explainer(const Case& c, const ExplainOptions& options);
  /// Stops early where records have to be set right first (set_right).
  Explanation Run();
  const RecordsSetRight& set_right() const { return set_right_; }

 private:
  /// Stated noise, a look at the data with it, then the noise that the records show.
  /// Returns what it left out, one line each.
  std::vector<std::string> PrepareNoise(const Hypothesis& nominal);
  /// The nuisances that the case declares, or those that usually are.
  void UseNuisances(const Hypothesis& h, const std::vector<double>& predicted, bool declared_only);
  /// These nuisances of the records beside the errors of the coils.
  void SetNuisances(const std::vector<NuisanceKind>& kinds);
  /// Both kinds in both models; the bank of signatures stays as it is.
  void ApplyNuisances();
  /// What stands in both models now, to be put back after a trial without it.
  struct UsedNuisances {
    std::vector<NuisanceKind> of_records, of_coils;
    double coil_doubt = 1, coils_seen_at = 1;
    UnitErrors of_units;
    Nuisances full, thinned;
  };
  UsedNuisances Used() const;
  void UseAgain(const UsedNuisances& used);
  /// Puts the errors of coils aside: residual and sensitivities of `now` from which none was taken off.
  FitResult WithoutCoilErrors(const FitResult& now);
  /// Of the amounts reported, beside everything else that is free.
  void StateSdOfCoilErrors(const FitResult& now);
  /// What the coils differ by, where the rig file states how much that may be: taken off everything from now on.
  void UseCoilErrors(const FitResult& as_filed, FitResult& now);
  /// The possible ones, with the floors as they are; `as_filed` beside none of them.
  void FindCoilErrors(const FitResult& as_filed);
  /// All of it after the floors have changed.
  void RenewCoilFloors(const Hypothesis& as_filed, const FitResult& now);
  /// Those that are believable beside the effects that are adopted, seen from `now`.
  void AllowCoilErrors(const FitResult& now);
  /// The same after an effect was adopted that explains much.
  void RenewCoilErrors(FitResult& now);
  /// Whether the errors that any coil may have explain as much as this adopted effect of one coil: then they are
  /// used, and `without` is the fit beside them.
  bool CoilErrorsExplain(std::size_t adopted, const FitResult& now, FitResult& without);
  /// Wrong data: nothing is fitted to them.
  void Stop(const FitResult& as_filed);
  /// Errors of the data that show beside the effects found and did not beside the rig file's model; whether there are any.
  bool FindWrongData(const FitResult& base, const FitResult& now);
  void Search(const Hypothesis& nominal, const FitResult& as_filed);
  /// Tries a fit without the rows where model and machine took different branches as the start of another one.
  void FitPastBursts(FitResult& now);
  /// Leaves out rows of unseen records where hypotheses that the fitted ones allow take different branches.
  /// Whether there were any.
  bool PassOverBursts(FitResult& now);
  /// The search before nuisances were taken off.
  struct BeforeNuisances {
    UsedNuisances used;
    SignatureBank bank;
    FitResult fit;
  };
  /// Zeros, clocks and inputs that differ from record to record, where the case declares none and they explain
  /// this share of the error above the noise: the search before them; nothing where they are not kept.
  std::optional<BeforeNuisances> TryNuisances(FitResult& now, double least_share);
  /// Those, and effects beside them, once effects were found. True: the search is to start again.
  bool FindWhatDiffers(FitResult& base, FitResult& now);
  bool DropNeedless(const FitResult& base, FitResult& now);
  void SettleBesideNuisances(const FitResult& base, FitResult& now, bool found_before);
  /// Whether one effect explains as much as the nuisances of every record together, which are many:
  /// they are then given up, and the search for effects starts from `bare`.
  bool OneEffectInstead(const FitResult& bare, const FitResult& with_nuisances);
  /// Nuisances that the case does not declare go again when the effects found explain as much without.
  void DropNuisances(FitResult& base, FitResult& now);
  /// Records that are whole rows late or early: a shift of whole rows is no small one.
  bool FindLateRows(const FitResult& base);
  /// Inputs whose size the case declares uncertain: where their simulation explains what the slope of the
  /// prediction does not.
  bool FindInputs(const FitResult& base);
  std::vector<NuisanceKind> ChooseFrom(const std::vector<NuisanceKind>& kinds,
                                       const FitResult& now) const;
  /// The amounts of the nuisances at the end.
  void ReportNuisances(const FitResult& now);
  /// An effect that the last fit leaves without a size goes again.
  void DropSizeless(const FitResult& base, FitResult& now);
  /// How large what was not found could still be.
  void FindHidden(const FitResult& now);
  void Progress(double fraction, const std::string& text) const;
  FitOptions Options(const Eigen::MatrixXd* jacobian) const;
  FitResult FitNow(const Hypothesis& start, const Eigen::MatrixXd* jacobian) const;
  /// The point itself, with its sensitivities.
  FitResult At(const Hypothesis& h) const;
  bool Finished(const FitResult& now) const;
  /// One effect was adopted whose law in a free shape leaves the noise: what the catalogue's law leaves is its own.
  bool ShapeExplainsAll() const;
  double ScoreOf(const FitResult& fit) const;
  double Gain(const FitResult& before, const FitResult& after) const;
  /// The most that another candidate of the ranking than this one gains.
  double GainOfOthers(const FitResult& now, const std::vector<RankedEffect>& ranking,
                      const RankedEffect& than) const;
  /// Adds the effect that explains most of what is left; false: nothing left, or none worth it.
  bool AdoptBest(FitResult& now, int round);
  void AdoptMore(FitResult& now);
  /// The model with the effect may hold a rotor that the rig file's loses: then all rows count.
  void Release(FitResult& now);
  /// A rig whose loop is nearly unstable with the hidden effect passes more noise than the rig
  /// file's: what seems unexplained may be noise of the model found. True when the floor was
  /// renewed.
  bool RenewFloor(const FitResult& as_filed, FitResult& base, FitResult& now);
  /// The same point seen with all rows.
  FitResult AllRows(const FitResult& fit) const;
  /// The effect that explains most alone may be none of two that are there: the best pairs of the
  /// screening are fitted too where one effect does not explain nearly all.
  void TryPairs(const FitResult& base, FitResult& now);
  /// Whether a short fit of a pair leaves a full one a chance; `more`: it has more effects than were adopted.
  bool MayBeAdopted(const FitResult& now, const FitResult& brief, bool more) const;
  /// The steps one by one have fitted this pair, or one with more in it.
  bool AlreadyTried(const CandidatePair& p) const;
  /// The effects that the details of another one's law hide (explainer_shapes.cc).
  bool AdoptBesideShape(FitResult& now);
  std::optional<FitResult> BesideFreeShape(const FitResult& now) const;
  /// Whether it was found so: beside the plain laws it explains less than it does.
  bool IsBesideShape(const EffectInstance& e) const;
  /// An effect that its successors made needless goes again.
  void Backward(const FitResult& base, FitResult& now);
  void DropUnnamed(const FitResult& base, FitResult& now);
  /// The rig parameters with all adopted effects but this one; nothing where a short fit shows that it is needed.
  std::optional<FitResult> FitWithout(const FitResult& base, const FitResult& now,
                                      std::size_t adopted) const;
  void TakeOut(std::size_t adopted, FitResult without, FitResult& now);
  /// What no round has judged beside the fit as it is, or all names: what was taken off since tells them apart.
  enum class Names { kNotJudged, kAllAnew };
  /// Names that were open while effects found later were missing: each effect against its rivals beside the
  /// others; a better one takes its place.
  void RejudgeNames(const FitResult& base, FitResult& now, Names which = Names::kNotJudged);
  void JudgeOnlyName(const FitResult& base, FitResult& now);
  /// What a round works with; its progress begins at `from` and takes `share` of the search.
  RoundSetting SettingFrom(double from, double share);
  FitResult FittedToTheEnd(const FitResult& before, const RankedEffect& ranked) const;
  void NoteRound(const std::vector<RankedEffect>& ranking);
  void NoteNames(std::size_t adopted, std::vector<RankedEffect> ranking);
  /// The names that were open where an effect was judged best, and those nearly as good in another's place.
  std::vector<EffectInstance> RivalsOf(std::size_t adopted) const;
  bool ComparedByShape(const EffectInstance& a, const EffectInstance& b) const;
  /// Values and sd of the ranked effects, as the report states them.
  void StateSizes();
  /// A last fit with fresh sensitivities of everything.
  void Polish(FitResult& now);
  /// What belongs to the verdict: shifts of parameters, what is unexplained, hidden or confusable.
  void AddToVerdict(const FitResult& base, const FitResult& now);
  void NoteShifts(const FitResult& base);
  /// Pairs that these records leave open, and the record that would decide.
  void FindConfusable();

  ExplainOptions options_;
  CaseModel full_, model_;  // with all rows: floor and frequencies; with some: the search
  RigParameters rig_;
  Explanation out_;
  SignatureBank bank_;
  std::vector<NuisanceKind> record_kinds_;              // in use, of all rows
  std::vector<NuisanceKind> coil_errors_, coil_kinds_;  // possible; in use; rows of model_
  double coil_doubt_ = 1;                               // by which they are weighed less
  double coils_seen_at_ = 1;                            // what the model left when they were chosen
  Eigen::MatrixXd as_filed_jacobian_;                   // before any error of a coil was taken off
  std::vector<std::vector<double>> unit_changes_;       // of other machines of the type
  UnitErrors of_units_;                                 // what the coils' errors leave of these
  std::vector<BranchSpan> branches_;
  /// A name of a round, as it was fitted there.
  struct RankedName {
    EffectInstance effect;
    double probability = 0, ratio = 0;  // ratio_fit of its fit
    bool by_shape = false;              // with the shape of its law free
  };
  std::vector<std::vector<RankedName>> rounds_;  // of each round that ranked any
  std::vector<std::string>
      of_own_channels_;  // effects adopted for what they explain where they act
  std::vector<std::string>
      beside_shape_;  // effects found beside the free shape of another one's law
  RecordsSetRight set_right_;
  std::size_t steps_before_effects_ = 0;  // of the ladder
  bool floor_renewed_ = false;
  // An effect was sought in place of nuisances that explain as much: beside those nothing would be left for it.
  bool effect_instead_ = false;
  // of the squared ratio on unseen records, by the first effect or by undeclared nuisances
  double first_fall_ = 0;
};

}  // namespace ambrig
