#include "discovery/decision/evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/normal_distribution.h"
#include "discovery/decision/decide.h"
#include "effects/catalogue.h"

namespace ambrig {

namespace {

constexpr double kOfUsual = 0.5;      // of the smallest usual size
constexpr double kSeen = 3;           // sd from nothing
constexpr double kSeenInDoubt = 2;    // the same by sd that the doubt of another law has widened
constexpr double kSet = 0.95;         // probability of the set
constexpr double kAboveFloor = 1.15;  // a channel's ratio that is worth a word
constexpr std::size_t kPlaces = 8;
constexpr double kLeavesDetails = 0.9, kMayLeaveDetails = 0.75;  // of the error, explained
// Name probability: half at a share of 0.45; an explanation down to the floor is a name.
constexpr double kHalfShare = 0.45, kSlope = 12, kAtFloor = 1.15;

/// How far the sizes of an effect are from nothing.
struct SizeDistances {
  std::vector<double> told;  // [sd], of sizes whose sd the records tell
  // Whether there are others, which have no slope (whole periods of delay) or are too small to show
  // (a dead duty below every duty), and one of at least the smallest usual size.
  bool untold = false, untold_usual = false;
};

SizeDistances DistancesFromNothing(const EffectInstance& effect) {
  const EffectDescription* d = FindEffect(effect.name);
  SizeDistances out;
  for (std::size_t k = 0; k < effect.table.size(); ++k) {
    const EffectParameter& p = effect.table[k];
    if (!p.has_null || (d && !d->Switches(p))) continue;
    const double sd = k < effect.sd.size() ? effect.sd[k] : 0, value = effect.values[k];
    if (!std::isfinite(value)) continue;  // at a null of infinity
    // a null of infinity: 1/value is seen against its own sd
    const double distance =
        std::isfinite(p.null_value) ? std::abs(value - p.null_value) : std::abs(value);
    if (distance == 0) continue;
    if (sd > 0) {
      out.told.push_back(distance / sd);
    } else {
      out.untold = true;
      out.untold_usual = out.untold_usual || distance >= p.typical_lo;
    }
  }
  return out;
}

/// Whether one of the sizes is so many sd from nothing. Where none of a known sd is, one whose
/// slope the records do not tell counts if it is at least of the smallest usual size, or alone.
bool DifferBy(const SizeDistances& sizes, double sds) {
  if (std::ranges::any_of(sizes.told, [&](double distance) { return distance >= sds; }))
    return true;
  return sizes.untold_usual || (sizes.untold && sizes.told.empty());
}

/// The distance [sd] that the largest of `count` independent normal deviates exceeds as rarely as a
/// single one exceeds `sds` (Sidak's correction).
double OfLargest(double sds, std::size_t count) {
  const double within = 2 * NormalProbability(sds) - 1;
  return NormalQuantile(0.5 + 0.5 * std::pow(within, 1.0 / static_cast<double>(count)));
}

/// The effect with the sd that its sizes have while the shape of its law is held.
EffectInstance WithSdOfSizes(const FitResult& fit, std::size_t effect, bool under_doubt) {
  EffectInstance e = FittedEffect(fit, effect);
  for (std::size_t k = 0; k < fit.hypothesis.free.size() && k < fit.size_sd.size(); ++k) {
    const FreeParameter& p = fit.hypothesis.free[k];
    if (p.effect != static_cast<int>(effect)) continue;
    e.sd[p.row] = fit.size_sd[k];
    if (under_doubt && k < fit.doubt.size()) e.sd[p.row] *= fit.doubt[k];
  }
  return e;
}

}  // namespace

Closure ClosureOf(const CaseModel& model, const std::vector<double>& before,
                  const std::vector<double>& after) {
  Closure c;
  c.floors_before = Ratio(model, before, Which::kAll);
  c.floors_after = Ratio(model, after, Which::kAll);
  c.test_before = KnownRatio(model, before, Which::kValidate);
  c.test_after = KnownRatio(model, after, Which::kValidate);
  c.explained = ExplainedShare(c.floors_before, c.floors_after);
  return c;
}

Remainder RemainderOf(const CaseModel& model, const std::vector<double>& before,
                      const std::vector<double>& after, const Closure& closure, bool any_effect) {
  Remainder out;
  double least_share = 1;
  for (const Target& t : model.targets()) {
    const double ratio = TargetRatio(model, after, t), was = TargetRatio(model, before, t);
    if (ratio < kAboveFloor) continue;
    const CaseRecord& r = model.data().records[t.record];
    out.where.push_back({r.data_file, r.data.channels[t.channel].name, ratio});
    if (ratio > 2) least_share = std::min(least_share, ExplainedShare(std::max(was, ratio), ratio));
  }
  std::stable_sort(out.where.begin(), out.where.end(),
                   [](const auto& a, const auto& b) { return a.ratio > b.ratio; });
  if (out.where.size() > kPlaces) out.where.resize(kPlaces);
  if (closure.floors_after < 1.05 && (out.where.empty() || out.where[0].ratio < kChannelNoise)) {
    out.where.clear();
    out.text = "the noise floor is reached on all records: nothing is left to explain";
    return out;
  }
  const bool law = any_effect && closure.explained > kLeavesDetails && least_share > 1.0 / 3;
  out.kind = law ? RemainderKind::kLawVariation : RemainderKind::kOther;
  const std::string worst =
      out.where.empty()
          ? ""
          : fmt::format(", most at {} in {} ({:.1f} times the noise)", out.where[0].channel,
                        out.where[0].record, out.where[0].ratio);
  if (law) {
    out.text = fmt::format(
        "{:.2f} times the noise stays{}: as large as the details of this law usually leave",
        closure.floors_after, worst);
    return out;
  }
  const bool doubtful = any_effect && closure.explained > kMayLeaveDetails && least_share > 1.0 / 3;
  out.text =
      fmt::format("{:.2f} times the noise stays unexplained{}: {}", closure.floors_after, worst,
                  doubtful     ? "of another origin, or a detail of what was found"
                  : any_effect ? "of another origin than what was found"
                               : "of another origin than the rig's parameters");
  return out;
}

double NameProbability(double share, double floors_after) {
  const double at_floor = floors_after < kAtFloor ? 3 : 0;
  return 1 / (1 + std::exp(-(kSlope * (share - kHalfShare) + at_floor)));
}

std::vector<SetMember> CredibleSet(std::vector<RankedEffect>& ranking, double named) {
  std::vector<SetMember> all;
  for (RankedEffect& r : ranking) {
    r.probability *= named;
    all.push_back({r.effect.name, r.effect.target, r.probability});
  }
  all.push_back({"unknown", "", ranking.empty() ? 1 : 1 - named});
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.probability > b.probability; });
  std::vector<SetMember> set;
  double sum = 0;
  for (const SetMember& m : all) {
    if (sum >= kSet) break;
    set.push_back(m);
    sum += m.probability;
  }
  return set;
}

bool HasSize(const EffectInstance& effect) { return DifferBy(DistancesFromNothing(effect), kSeen); }

bool HasSize(const FitResult& fit, std::size_t effect) {
  return HasSize(WithSdOfSizes(fit, effect, false));
}

bool HasSizeUnderDoubt(const FitResult& fit, std::size_t effect) {
  const SizeDistances sizes = DistancesFromNothing(WithSdOfSizes(fit, effect, true));
  return DifferBy(sizes, OfLargest(kSeenInDoubt, std::max<std::size_t>(1, sizes.told.size())));
}

bool HasImpossibleSign(const EffectInstance& effect) {
  const EffectDescription* d = FindEffect(effect.name);
  return d && !d->positive.empty() && effect.Value(d->positive) < 0;
}

bool IsDetailOf(const std::vector<EffectInstance>& adopted, const EffectInstance& effect) {
  const EffectDescription* d = FindEffect(effect.name);
  if (!d || (d->target != TargetKind::kCoil && d->target != TargetKind::kAxis)) return false;
  if (std::none_of(adopted.begin(), adopted.end(),
                   [&](const EffectInstance& a) { return a.target == effect.target; }))
    return false;
  for (std::size_t k = 0; k < effect.table.size(); ++k) {
    const EffectParameter& p = effect.table[k];
    if (d->Switches(p) && std::abs(effect.values[k] - p.null_value) >= kOfUsual * p.typical_lo)
      return false;
  }
  return true;
}

}  // namespace ambrig
