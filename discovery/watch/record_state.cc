#include "discovery/watch/record_state.h"

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"
#include "core/math/normal_distribution.h"
#include "discovery/decision/compare.h"
#include "discovery/decision/evidence.h"
#include "discovery/search/fit.h"

namespace ambrig {

namespace {

constexpr double kFalseAlarms = 0.01;    // share of unchanged records that leave a band
constexpr double kNoiseChange = 1.5;     // as between a stated noise and the records' own
constexpr double kLeastErrorRise = 1.1;  // smaller rises of the error are not told
// A rig may change by more than its drawing was uncertain about: heat, wear, a repair.
constexpr double kChange = 3;           // of the tolerance, sd of a change that is expected
constexpr double kGreatestChange = 24;  // of the tolerance, the largest change that is looked for

const StateParameter* FindParameter(const RecordState& s, const std::string& path) {
  const auto found =
      std::ranges::find_if(s.parameters, [&](const StateParameter& p) { return p.path == path; });
  return found == s.parameters.end() ? nullptr : &*found;
}

/// The fit expects the reference's values.
void ExpectReference(const RecordState& reference, Hypothesis& h) {
  for (std::size_t k = 0; k < h.free.size(); ++k) {
    FreeParameter& f = h.free[k];
    const StateParameter* was = FindParameter(reference, f.path);
    if (!was) continue;
    h.Set(k, was->value);
    f.start = f.value;
    if (f.effect >= 0) continue;
    const double tolerance = f.sd;
    std::string unit;
    ParameterRange(h.rig, f.path, &f.lo, &f.hi, &unit);
    f.lo = std::max(f.lo, f.value - kGreatestChange * tolerance);
    f.hi = std::min(f.hi, f.value + kGreatestChange * tolerance);
    f.sd = f.step = kChange * tolerance;
  }
}

std::string UnitOf(const Hypothesis& h, const FreeParameter& f) {
  if (f.effect >= 0)
    return std::string(h.rig.effects[static_cast<std::size_t>(f.effect)].table[f.row].unit);
  double lo = 0, hi = 0;
  std::string unit;
  ParameterRange(h.rig, f.path, &lo, &hi, &unit);
  return unit;
}

}  // namespace

RecordState StateOf(const Case& c, const RecordState* reference, const std::atomic<bool>* stop) {
  Require(c.records.size() == 1, "a case of one record");
  CaseModel model(c);
  model.stop = stop;
  Hypothesis h = Hypothesis::Base(c.rig);
  if (reference) ExpectReference(*reference, h);
  const Comparison compared = Compare(model, h, false);
  RecordState s;
  s.faults = compared.data;
  s.ratio = s.ratio_fitted = compared.ratio;
  s.effective_sample_size = compared.effective_sample_size;
  for (const auto& [channel, noise] : compared.noise.channels) s.noise[channel] = noise.used;
  for (const ChannelError& e : compared.records[0].channels) s.floors[e.channel] = e.ratio;
  if (!s.faults.empty()) return s;
  FitOptions options;
  options.effective_sample_size = s.effective_sample_size;
  const FitResult fit = Fit(model, h, options);
  s.ratio_fitted = fit.ratio_fit;
  s.explained = ClosureOf(model, compared.residual, fit.residual).explained;
  for (std::size_t k = 0; k < fit.hypothesis.free.size(); ++k) {
    const FreeParameter& f = fit.hypothesis.free[k];
    s.parameters.push_back({f.path, UnitOf(fit.hypothesis, f), f.value, fit.sd[k]});
  }
  return s;
}

double BandWidth(std::size_t count) {
  return -NormalQuantile(0.5 * kFalseAlarms / static_cast<double>(std::max<std::size_t>(1, count)));
}

LeftBand ParameterBand(const StateParameter& now, const StateParameter& was, std::size_t count) {
  LeftBand b{"parameter", now.path, now.unit, now.value, was.value};
  const double sd = std::hypot(now.sd, was.sd);
  b.sds = sd > 0 ? (now.value - was.value) / sd : 0;
  b.least = was.value - BandWidth(count) * sd;
  b.greatest = was.value + BandWidth(count) * sd;
  return b;
}

std::vector<LeftBand> FindLeftBands(const RecordState& now, const RecordState& reference) {
  std::vector<LeftBand> out;
  for (const StateParameter& p : now.parameters) {
    const StateParameter* was = FindParameter(reference, p.path);
    if (!was) continue;
    const LeftBand b = ParameterBand(p, *was, now.parameters.size());
    if (p.value < b.least || p.value > b.greatest) out.push_back(b);
  }
  std::ranges::stable_sort(
      out, [](const LeftBand& a, const LeftBand& b) { return std::abs(a.sds) > std::abs(b.sds); });
  // The sd of a rms of n numbers is 1/sqrt(2 n) of it, of the quotient of two sqrt(2) times that.
  const double n = std::min(now.effective_sample_size, reference.effective_sample_size);
  const double rise = std::max(kLeastErrorRise, 1 + BandWidth(1) / std::sqrt(std::max(1.0, n)));
  if (now.ratio_fitted > rise * reference.ratio_fitted)
    out.push_back({"error", "", "-", now.ratio_fitted, reference.ratio_fitted, 0, 0,
                   rise * reference.ratio_fitted});
  for (const auto& [channel, ratio] : reference.floors) {
    const double none = std::nan("");
    if (!now.floors.contains(channel))
      out.push_back({"channel", channel, "", none, none, none, none, none});
  }
  for (const auto& [channel, noise] : now.noise) {
    const auto was = reference.noise.find(channel);
    if (was == reference.noise.end() || !(was->second > 0) || !(noise > 0)) continue;
    if (noise < was->second * kNoiseChange && noise > was->second / kNoiseChange) continue;
    out.push_back({"noise", channel, "", noise, was->second, 0, was->second / kNoiseChange,
                   was->second * kNoiseChange});
  }
  return out;
}

}  // namespace ambrig
