#include "discovery/explain/record_of_other_machine.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "discovery/decision/conclusion.h"
#include "discovery/decision/parameter_shifts.h"
#include "discovery/explain/search_models.h"

namespace ambrig {

namespace {

constexpr double kAtNoise = 1.1;         // error over the noise
constexpr double kShowsElsewhere = 1.5;  // of a channel of another record
constexpr double kStandsOutAlone = 3;    // of a channel of this one
constexpr double kBeyondTolerance = 4;   // sd of a rig parameter
constexpr double kLooser = 10;           // sd of a machine that is another one, over the file's
constexpr double kCertainty = 0.9;       // probability

/// The record that all places of the remainder are in.
std::optional<std::size_t> OnlyRecordInError(const Case& c, const Explanation& e) {
  const std::vector<RemainderPlace>& where = e.remainder.where;
  if (where.empty() || where[0].ratio < kStandsOutAlone) return {};
  for (const RemainderPlace& p : where)
    if (p.record != where[0].record && p.ratio > kShowsElsewhere) return {};
  for (std::size_t r = 0; r < c.records.size(); ++r)
    if (c.records[r].data_file == where[0].record) return r;
  return {};
}

/// The rig parameters fitted to all records of the case, beside those of the rig file.
struct ParameterFit {
  double before = 0, after = 0;  // error over the noise of the worst record
  Hypothesis found;
};

std::optional<ParameterFit> FitParameters(const Case& c) {
  try {
    SearchModels models(c, nullptr, nullptr);
    const Hypothesis nominal = Hypothesis::Base(c.rig);
    models.LimitToHeld(nominal);
    models.FindNoise(nominal);
    models.UseFloors(nominal);
    const FitResult filed = models.At(nominal), fit = models.FitFrom(nominal, &filed.jacobian);
    if (!fit.Stands()) return {};
    return ParameterFit{RatiosOf(models.thinned(), filed).worst_record,
                        RatiosOf(models.thinned(), fit).worst_record, fit.hypothesis};
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace

std::optional<DataFault> RecordOfOtherMachine(const Case& c, const Explanation& e) {
  if (e.verdict != ExplanationVerdict::kUnknown || c.records.size() < 3) return {};
  const auto record = OnlyRecordInError(c, e);
  if (!record) return {};
  Case alone = c, others = c;
  others.records.erase(others.records.begin() + static_cast<std::ptrdiff_t>(*record));
  if (std::ranges::all_of(others.records, [](const CaseRecord& r) { return r.validate; }))
    return {};
  alone.records = {c.records[*record]};
  alone.records[0].validate = false;
  for (Tolerance& t : alone.rig.tolerances) t.sd *= kLooser;
  const auto of_record = FitParameters(alone);
  if (!of_record || of_record->before < kShowsElsewhere || of_record->after > kAtNoise) return {};
  const std::vector<std::string> shifts =
      ParameterShifts(of_record->found, kBeyondTolerance, kLooser);
  if (shifts.empty()) return {};
  const auto of_others = FitParameters(others);
  if (!of_others || of_others->after > kAtNoise) return {};
  DataFault f;
  f.record = c.records[*record].data_file;
  f.fault = "scenario";
  f.with = kOtherMachine;
  f.detail = fmt::format("the other records agree with the rig file, this one alone with {}",
                         fmt::join(shifts, ", "));
  f.probability = kCertainty;
  return f;
}

void BelieveFault(const DataFault& fault, Explanation& e) {
  e.data = {fault};
  BelieveData(e);
  e.adopted.clear();
  e.ranking.clear();
  e.second_round.clear();
  e.unexplained = {};
  e.confusable.clear();
}

}  // namespace ambrig
