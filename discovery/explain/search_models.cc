#include "discovery/explain/search_models.h"

#include <algorithm>

#include "core/base/errors.h"
#include "discovery/data_gate/lonely_rows.h"
#include "discovery/data_gate/start_current.h"
#include "discovery/decision/prepared_models.h"
#include "discovery/model/floor.h"
#include "discovery/search/candidate_fit.h"
#include "discovery/search/likelihood.h"

namespace ambrig {

SearchModels::SearchModels(const Case& c, const std::atomic<bool>* stop, RunStore* store)
    : full_(c), thinned_(c, ThinningTo(c, kSearchRows)) {
  full_.stop = thinned_.stop = stop;
  full_.store = thinned_.store = store;
}

std::vector<std::string> SearchModels::LimitToHeld(const Hypothesis& nominal) {
  std::vector<std::string> lost = full_.LimitToHeld(nominal);
  RequireCountedRows(full_);
  thinned_.LimitAs(full_);
  return lost;
}

SearchModels::FoundNoise SearchModels::FindNoise(const Hypothesis& nominal) {
  FoundNoise found;
  thinned_.LeaveOut(FindFloor(full_, nominal).unpredictable);
  for (const Target& t : full_.targets()) found.stated_floors.push_back(t.floor);
  full_.noise_model = thinned_.noise_model = EstimateNoise(full_, nominal);
  NoiseFloor floor = FindFloor(full_, nominal);
  thinned_.LeaveOut(floor.unpredictable);
  effective_sample_size_ = floor.effective_sample_size;
  found.clean = std::move(floor.clean);
  return found;
}

std::vector<std::string> SearchModels::PassOverUnstatedStarts(const std::vector<double>& clean) {
  const std::vector<UnstatedStart> starts = UnstatedStartsOf(full_, clean);
  LeaveOut(SpansOf(full_, starts));
  return StartRemarks(data(), starts);
}

std::vector<DataFault> SearchModels::InspectData(const Hypothesis& nominal,
                                                 const FoundNoise& found) {
  return InspectDataBelow(full_, found.clean, nominal, found.stated_floors);
}

std::vector<std::string> SearchModels::PassOverLonely(const std::vector<double>& clean) {
  const std::vector<LonelyRow> lonely = LonelyRowsOf(full_, clean);
  LeaveOut(SpansOf(lonely));
  return LonelyRemarks(data(), lonely);
}

void SearchModels::UseFloors(const Hypothesis& nominal) {
  PassFloorsOn(full_, thinned_);
  branches_ = UseBranchesInBoth(full_, thinned_, nominal);
}

std::vector<std::string> SearchModels::Remarks() const {
  std::vector<std::string> lines = NoiseRemarks(noise());
  const std::vector<std::string> of_branches = BranchRemarks(thinned_, branches_);
  lines.insert(lines.end(), of_branches.begin(), of_branches.end());
  return lines;
}

void SearchModels::UseNuisances(const std::vector<NuisanceKind>& of_records,
                                const std::vector<NuisanceKind>& of_coils, double coil_doubt) {
  UseNuisancesInBoth(full_, thinned_, of_records, of_coils, effective_sample_size_, coil_doubt);
}

void SearchModels::SetNuisances(const UsedNuisances& used) {
  full_.nuisances = used.full;
  thinned_.nuisances = used.thinned;
}

void SearchModels::LeaveOut(const std::vector<SampleSpan>& spans) {
  full_.LeaveOut(spans);
  thinned_.LeaveOut(spans);
}

FitResult SearchModels::FitWithoutRows(const std::vector<SampleSpan>& spans,
                                       const Hypothesis& start) {
  const std::vector<char> counted = thinned_.sound();
  thinned_.LeaveOut(spans);
  FitResult without = FitFrom(start);
  thinned_.SetSound(counted);
  return without;
}

bool SearchModels::CountWhatHolds(const Hypothesis& h) {
  if (!full_.limited()) return false;
  full_.LimitToHeld(h);
  thinned_.LimitAs(full_);
  ForgetSignatures();
  return true;
}

bool SearchModels::RaiseFloors(const Hypothesis& h) {
  const std::vector<Target> before = full_.targets();
  try {
    const NoiseFloor floor = FindFloor(full_, h);
    thinned_.LeaveOut(floor.unpredictable);
    effective_sample_size_ = floor.effective_sample_size;
  } catch (const InputError&) {
    return false;
  }
  for (std::size_t t = 0; t < before.size(); ++t)
    thinned_.targets()[t].floor = full_.targets()[t].floor =
        std::max(before[t].floor, full_.targets()[t].floor);
  return true;
}

void SearchModels::SetFloors(const Floors& before) {
  std::vector<double> floors;
  for (const Target& t : before.targets) floors.push_back(t.floor);
  SetFloors(floors);
  effective_sample_size_ = before.effective_sample_size;
}

void SearchModels::SetFloors(const std::vector<double>& floors) {
  for (std::size_t t = 0; t < floors.size(); ++t)
    thinned_.targets()[t].floor = full_.targets()[t].floor = floors[t];
}

void SearchModels::RescaleSignatures(const Floors& before) {
  if (thinned_.nuisances.in_all()) {
    ForgetSignatures();  // their rows were weighed with the old floors
    return;
  }
  signatures_.Rescale(thinned_, before.targets);
  if (thinned_.nuisances.any()) signatures_.TakeOffNuisances(thinned_);
}

FitOptions SearchModels::Options() const {
  FitOptions o;
  o.effective_sample_size = effective_sample_size_;
  return o;
}

FitResult SearchModels::FitFrom(const Hypothesis& start, const Eigen::MatrixXd* jacobian) const {
  FitOptions o = Options();
  o.base_jacobian = jacobian;
  return Fit(thinned_, start, o);
}

FitResult SearchModels::At(const Hypothesis& h) const {
  FitOptions o = Options();
  o.iterations = 0;
  return Fit(thinned_, h, o);
}

FitResult SearchModels::AtAllRows(const FitResult& fit) const {
  FitOptions o = Options();
  o.iterations = 0;
  o.sensitivities = false;
  return Fit(full_, fit.hypothesis, o);
}

FitResult SearchModels::FittedToTheEnd(const FitResult& before, const FitResult& found) const {
  constexpr double kMuch = 2, kGains = 20;  // ratio, of the score
  constexpr int kTimes = 3;
  FitResult whole = found;
  if (found.jacobian.size() == 0)
    whole = FitOn(thinned_, before, found.hypothesis, effective_sample_size_);
  if (!whole.Stands()) return found;
  // an effect that changes the loop changes what all the others do: their sensitivities are taken
  // anew while that gains
  for (int time = 0; time < kTimes && whole.ratio_fit > kMuch; ++time) {
    FitResult more = FitFrom(whole.hypothesis);
    if (!more.Stands() || !more.converged) break;
    const double gain = Gain(whole, more);
    if (gain > 0) whole = std::move(more);
    if (gain < kGains) break;
  }
  return whole;
}

double SearchModels::ScoreOf(const FitResult& fit) const {
  return Score(thinned_, fit, effective_sample_size_);
}

double SearchModels::Gain(const FitResult& before, const FitResult& after) const {
  return ScoreOf(before) - ScoreOf(after);
}

RoundSetting SearchModels::Round(int candidates,
                                 std::function<void(double, const std::string&)> progress) {
  return {full_, thinned_, signatures_, effective_sample_size_, candidates, std::move(progress)};
}

}  // namespace ambrig
