#include "discovery/search/worst_records.h"

#include <algorithm>

namespace ambrig {

namespace {

constexpr std::size_t kLookedAt = 2;  // worst records at most
constexpr double kMuchOfWorst = 0.4;  // of the worst record's error: the next one is looked at too
constexpr double kShown = 0.9;        // of the squared error above the noise
constexpr double kPlain = 1.3;        // ratio above which a part of the records tells

double Excess(const RecordError& e) { return std::max(0.0, e.square - e.rows); }

/// Largest error above the noise first.
std::vector<RecordError> ErrorsOf(const CaseModel& model, const FitResult& now) {
  std::vector<RecordError> errors = RecordErrors(model, now.residual);
  std::stable_sort(errors.begin(), errors.end(),
                   [](const auto& a, const auto& b) { return Excess(a) > Excess(b); });
  return errors;
}

}  // namespace

bool ResponsesShowError(const CaseModel& model, const FitResult& now) {
  return std::ranges::any_of(model.targets(), [&](const Target& t) {
    return model.data().records[t.record].kind == RecordKind::kFrf && ShowsMotion(model, t) &&
           TargetRatio(model, now.residual, t) > kPlain;
  });
}

RecordSubset WorstRecords(const CaseModel& model, const FitResult& now) {
  const std::vector<CaseRecord>& records = model.data().records;
  RecordSubset look{std::vector<char>(records.size(), 0), now.predicted};
  std::size_t taken = 0;
  double worst = 0;
  for (const RecordError& e : ErrorsOf(model, now)) {
    const CaseRecord& record = records[e.record];
    if (record.validate || record.scenario.start == StartState::kClamped) continue;
    if (taken == kLookedAt || Excess(e) <= kMuchOfWorst * worst) break;
    worst = std::max(worst, Excess(e));
    look.records[e.record] = 1;
    ++taken;
  }
  if (taken == 0) look.records.assign(records.size(), 1);
  return look;
}

RecordSubset RecordsShowing(const CaseModel& model, const FitResult& now) {
  const std::vector<CaseRecord>& records = model.data().records;
  RecordSubset look{std::vector<char>(records.size(), 0), now.predicted};
  if (!HoldsAdopted(model, now) && now.ratio_fit < kPlain) {
    look.records.assign(records.size(), 1);
    return look;
  }
  const std::vector<RecordError> errors = ErrorsOf(model, now);
  for (const bool validate : {false, true}) {
    double total = 0, taken = 0;
    for (const RecordError& e : errors)
      if (records[e.record].validate == validate) total += Excess(e);
    bool any = false;
    for (const RecordError& e : errors) {
      if (records[e.record].validate != validate) continue;
      if (any && taken >= kShown * total) break;
      look.records[e.record] = 1;
      taken += Excess(e);
      any = true;
    }
  }
  return look;
}

}  // namespace ambrig
