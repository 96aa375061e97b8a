#include "discovery/decision/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "discovery/data/lonely_rows.h"
#include "discovery/decision/conclusion.h"
#include "discovery/decision/describe.h"
#include "discovery/decision/explainer.h"
#include "discovery/decision/likelihood.h"
#include "discovery/decision/parameter_shifts.h"
#include "discovery/decision/prepared_models.h"

namespace ambrig {

namespace {
// share of the error that nuisances explain where they are kept before any effect is sought
constexpr double kHalf = 0.5;
}  // namespace

Explainer::Explainer(const Case& c, const ExplainOptions& options)
    : options_(options), full_(c), model_(c, ThinningTo(c, kSearchRows)), rig_(c.rig) {
  full_.stop = model_.stop = options.stop;
  full_.store = model_.store = options.store;
}

Explanation Explainer::Run() {
  const auto begin = std::chrono::steady_clock::now();
  Progress(0.0, "noise floor");
  const Hypothesis nominal = Hypothesis::Base(rig_);
  const std::vector<std::string> lost = full_.LimitToHeld(nominal);
  RequireCountedRows(full_);
  model_.LimitAs(full_);
  const std::vector<std::string> alone = PrepareNoise(nominal);
  const FitResult as_filed = At(nominal);
  out_.nominal_ratio_validate = UnseenRatio(model_, as_filed.residual);
  out_.ladder.push_back({"", as_filed.ratio_fit, out_.nominal_ratio_validate});
  if (out_.data.empty())
    Search(nominal, as_filed);
  else
    Stop(as_filed);
  for (const std::string& line : lost) out_.warnings.push_back(line);
  for (const std::string& line : alone) out_.warnings.push_back(line);
  for (const std::string& line : NoiseRemarks(out_.noise)) out_.warnings.push_back(line);
  for (const std::string& line : BranchRemarks(model_, branches_)) out_.warnings.push_back(line);
  out_.runs = full_.runs + model_.runs;
  out_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  Progress(1.0, "done");
  return std::move(out_);
}

/// Stated noise, a look at the data with it, then the noise that the records show.
std::vector<std::string> Explainer::PrepareNoise(const Hypothesis& nominal) {
  model_.LeaveOut(FindFloor(full_, nominal).unpredictable);
  std::vector<double> stated;
  for (const Target& t : full_.targets()) stated.push_back(t.floor);
  out_.noise = EstimateNoise(full_, nominal);
  full_.noise_model = model_.noise_model = out_.noise;
  const NoiseFloor floor = FindFloor(full_, nominal);
  model_.LeaveOut(floor.unpredictable);
  out_.effective_sample_size = floor.effective_sample_size;
  Progress(0.02, "are the data possible?");
  out_.data = InspectDataBelow(full_, floor.clean, nominal, stated);
  const std::vector<LonelyRow> lonely = LonelyRowsOf(full_, floor.clean);
  full_.LeaveOut(SpansOf(lonely));
  model_.LeaveOut(SpansOf(lonely));
  if (out_.data.empty()) RequireCountedRows(full_);
  PassFloorsOn(full_, model_);
  branches_ = UseBranchesInBoth(full_, model_, nominal);
  UseNuisances(nominal, floor.clean, true);
  return LonelyRemarks(full_.data(), lonely);
}

/// The nuisances that the case declares, or those that usually are.
void Explainer::UseNuisances(const Hypothesis& h, const std::vector<double>& predicted,
                             bool declared_only) {
  if (declared_only && !full_.data().nuisances.any()) return;
  SetNuisances(NuisanceKindsOf(full_, h, predicted, declared_only));
}

void Explainer::SetNuisances(const std::vector<NuisanceKind>& kinds) {
  record_kinds_ = kinds;
  ApplyNuisances();
  bank_ = SignatureBank();
}

void Explainer::Search(const Hypothesis& nominal, const FitResult& as_filed) {
  Progress(0.03, "rig parameters");
  FitResult base = FitNow(nominal, &as_filed.jacobian);
  if (base.ratio_validate > out_.nominal_ratio_validate &&
      base.ratio_fit > 0.999 * out_.ladder[0].ratio_fit)
    base = as_filed;
  FitPastBursts(base);
  PassOverBursts(base);
  out_.base_ratio_fit = base.ratio_fit;
  out_.base_ratio_validate = base.ratio_validate;
  out_.ladder.push_back({"parameters", base.ratio_fit, base.ratio_validate});
  UseCoilErrors(as_filed, base);
  const FitResult bare = base;
  if (TryNuisances(base, kHalf)) {
    if (OneEffectInstead(bare, base)) {
      base = bare;
    } else {
      first_fall_ = std::pow(bare.ratio_validate, 2) - std::pow(base.ratio_validate, 2);
      FitPastBursts(base);  // they are seen now that the rest is explained
      PassOverBursts(base);
    }
  }
  if ((options_.clocks && FindLateRows(base)) || FindInputs(base)) return;
  FitResult now = base;
  steps_before_effects_ = out_.ladder.size();
  AdoptMore(now);
  TryPairs(base, now);
  if (RenewFloor(as_filed, base, now)) AdoptMore(now);
  while (AdoptBesideShape(now)) continue;
  Backward(base, now);
  RejudgeNames(base, now);
  DropUnnamed(base, now);
  if (!out_.adopted.empty()) {
    FitPastBursts(now);
    if (PassOverBursts(now)) base = At(base.hypothesis);
  }
  Polish(now);
  DropSizeless(base, now);
  DropNuisances(base, now);
  if (!ShapeExplainsAll() && FindWhatDiffers(base, now)) return;
  if (FindWrongData(base, now)) return;
  out_.final_fit = now;
  out_.final_ratio_fit = now.ratio_fit;
  out_.final_ratio_validate = now.ratio_validate;
  out_.warnings.insert(out_.warnings.end(), now.warnings.begin(), now.warnings.end());
  if (floor_renewed_)
    out_.warnings.push_back(
        "the loop of the model found passes more noise than the rig file's: the noise floor is "
        "the found model's");
  ReportNuisances(now);
  StateSizes();
  Conclude(model_, as_filed, base, now, of_units_, out_);
  AddToVerdict(base, now);
}

/// What a reader of this verdict asks next.
void Explainer::AddToVerdict(const FitResult& base, const FitResult& now) {
  NoteShifts(out_.verdict == "effect" ? now : base);
  if (out_.verdict == "unknown") {
    // The model may just hold the rotor on the rows that were fitted.
    const FitResult all = AllRows(now);
    if (all.Stands())
      out_.unexplained = Describe(full_, all);
    else if (now.Stands())
      out_.unexplained = Describe(model_, now);
  }
  if (out_.verdict == "none" || out_.verdict == "parameters") FindHidden(now);
  if (out_.verdict == "effect" || out_.verdict == "unknown") FindConfusable();
}

/// How large what was not found could still be.
void Explainer::FindHidden(const FitResult& now) {
  Progress(0.96, "how large could an effect be without being seen?");
  if (bank_.entries().empty() || bank_.partial()) {
    bank_ = SignatureBank();
    ScreenOptions coarse;
    coarse.effective_sample_size = out_.effective_sample_size;
    coarse.coarse = true;
    Screen(model_, now, ResidualPeaks(), coarse, bank_);
  }
  out_.hidden = VisibleSizes(model_, now, out_.effective_sample_size, bank_);
}

void Explainer::Progress(double fraction, const std::string& text) const {
  if (options_.stop && options_.stop->load()) throw Interrupted();
  if (!options_.progress) return;
  const long runs = full_.runs + model_.runs;
  options_.progress(fraction,
                    options_.tell_runs ? fmt::format("{} [{} simulations]", text, runs) : text);
}

FitOptions Explainer::Options(const Eigen::MatrixXd* jacobian) const {
  FitOptions o;
  o.effective_sample_size = out_.effective_sample_size;
  o.base_jacobian = jacobian;
  return o;
}

FitResult Explainer::FitNow(const Hypothesis& start, const Eigen::MatrixXd* jacobian) const {
  return Fit(model_, start, Options(jacobian));
}

/// The point itself, with its sensitivities.
FitResult Explainer::At(const Hypothesis& h) const {
  FitOptions o = Options(nullptr);
  o.iterations = 0;
  return Fit(model_, h, o);
}

double Explainer::ScoreOf(const FitResult& fit) const {
  return Score(model_, fit, out_.effective_sample_size);
}

double Explainer::Gain(const FitResult& before, const FitResult& after) const {
  return ScoreOf(before) - ScoreOf(after);
}

/// The same point seen with all rows.
FitResult Explainer::AllRows(const FitResult& fit) const {
  FitOptions o = Options(nullptr);
  o.iterations = 0;
  o.sensitivities = false;
  return Fit(full_, fit.hypothesis, o);
}

void Explainer::NoteShifts(const FitResult& base) {
  constexpr double kToldFrom = 1;  // sd
  out_.parameter_shifts = ParameterShifts(base.hypothesis, kToldFrom);
}

/// Pairs that these records leave open, and the record that would decide.
void Explainer::FindConfusable() {
  if (out_.ranking.size() < 2) return;
  const RankedEffect& best = out_.ranking[0];
  for (std::size_t k = 1; k < out_.ranking.size() && out_.confusable.size() < 2; ++k) {
    const RankedEffect& other = out_.ranking[k];
    if (other.effect.name == best.effect.name || other.probability < 0.02) continue;
    Progress(0.97, "what would tell " + best.effect.name + " from " + other.effect.name);
    out_.confusable.push_back(
        {best.effect.name, other.effect.name,
         SeparatingRecord(model_, best.fit.hypothesis, other.fit.hypothesis)});
  }
}

}  // namespace ambrig
