#include "discovery/search/screen.h"

#include <algorithm>
#include <cmath>

#include "core/base/coil_name.h"
#include "discovery/model/in_parallel.h"
#include "discovery/search/free_response.h"
#include "discovery/search/resonance_estimate.h"
#include "discovery/search/resonance_starts.h"
#include "discovery/search/start_search.h"
#include "discovery/search/worst_records.h"
#include "rig/rig_assembly.h"

namespace ambrig {

namespace {

constexpr double kInvisible = 1e-3;  // rms of a usual size's signature, over the floor

constexpr double kStandsOut = 1.3;  // ratio of one channel

/// Effects that no record of the case could show.
bool CannotShow(const EffectDescription& d, const CaseModel& model) {
  if (d.users_own) return true;
  const Case& c = model.data();
  bool moving = false, free_speed = false, contact = model.touches(), levitated = false;
  for (const CaseRecord& r : c.records) {
    moving = moving || r.scenario.speed.LargestSpeed(r.scenario.duration) > 0;
    free_speed = free_speed || r.scenario.speed_free_from < r.scenario.duration;
    contact = contact || r.scenario.start == StartState::kResting || !r.scenario.faults.empty();
    levitated = levitated || r.scenario.start != StartState::kClamped;
  }
  const bool chopper = c.rig.amplifier.modulation == Modulation::kChopper;
  const EffectNeeds& needs = d.needs;
  return (needs.rotation && !moving) || (needs.levitation && !levitated) ||
         (needs.contact && !contact) || (needs.free_speed && !free_speed) ||
         (needs.freewheeling && !chopper);
}

bool SeeksFrequency(const EffectDescription& d) {
  return std::any_of(d.parameters.begin(), d.parameters.end(),
                     [](const EffectParameter& p) { return p.name == "frequency"; });
}

/// Whether a coarse screen tries it.
bool IsCoarse(const EffectDescription& d, const std::string& target) {
  return !NamesCoil(target) && !SeeksFrequency(d);
}

/// The coil of a bearing that has no other: the bearing as a target says the same.
bool OnlyCoil(const RigParameters& rig, const EffectDescription& d, const std::string& target) {
  const BearingParameters* b = rig.Find(target.substr(0, target.find('.')));
  return b && b->coils() == 1 && d.target == TargetKind::kCoilOrBearing;
}

/// The probes of a narrow effect that explain something of what `base` leaves; all where that
/// cannot be tried. None where the records of a free rotor show no resonance that this effect could
/// be.
std::vector<ProbeGroup> Scanned(const CaseModel& model, const FitResult& base,
                                const std::vector<ProbeGroup>& probes, const SeenResonances& seen,
                                double effective_sample_size) {
  if (base.hypothesis.Holds(probes[0].probes[0])) return {};
  try {
    const EffectInstance null =
        MakeInstance(EffectNamed(probes[0].probes[0].name), probes[0].probes[0].target);
    const std::vector<EffectInstance> starts =
        ResonanceStarts(base.hypothesis.rig, null, seen.estimates);
    if (seen.looked && starts.empty() && IsResonance(EffectNamed(null.name)) &&
        !ResponsesShowError(model, base))
      return {};
    return ScanStarts(StartSearch(model, base, effective_sample_size), probes, starts);
  } catch (const InputError&) {
    return probes;
  }
}

/// What is screened together: the dearer kinds only where the cheaper ones leave something open.
enum class ScreenedKind { kOrdinary, kResonances, kCoils };

/// Whether single coils were screened.
bool HoldsCoils(const SignatureBank& bank) {
  return std::any_of(
      bank.entries().begin(), bank.entries().end(),
      [](const SignatureBank::Entry& e) { return NamesCoil(e.group.probes[0].target); });
}

/// Probes of one kind that the bank does not hold yet.
std::vector<ProbeGroup> GroupsToRun(const CaseModel& model, const FitResult& base,
                                    const ResidualPeaks& peaks, ScreenedKind kind,
                                    const ScreenOptions& options, const SignatureBank& bank,
                                    bool again) {
  std::vector<ProbeGroup> groups;
  const bool coils = kind == ScreenedKind::kCoils;
  const EffectTargets targets = TargetsOfEffects(model.data().rig);
  SeenResonances seen;
  if (kind == ScreenedKind::kResonances) seen = LookForResonances(model, base.hypothesis);
  for (const EffectDescription& d : Catalogue()) {
    if (!options.effect.empty() && d.id != options.effect) continue;
    if (IsResonance(d) != (kind == ScreenedKind::kResonances)) continue;
    const bool skipped = SeeksFrequency(d) ? !options.frequencies : again && !coils;
    if (options.effect.empty() && (CannotShow(d, model) || skipped)) continue;
    for (const std::string& target : TargetsOf(d, targets)) {
      if (!options.target.empty() && target != options.target) continue;
      if (options.coarse && !IsCoarse(d, target)) continue;
      if (options.effect.empty() && d.tone && peaks.ShowsNoTone(target)) continue;
      const bool coil = NamesCoil(target);
      if (coil != coils ||
          (coil && options.target.empty() && OnlyCoil(model.data().rig, d, target)))
        continue;
      std::vector<ProbeGroup> probes = ProbesOf(d, target, model, peaks);
      if (IsResonance(d) || d.needs.contact)
        probes = Scanned(model, base, probes, seen, options.effective_sample_size);
      for (ProbeGroup& g : probes)
        if (!base.hypothesis.Holds(g.probes[0]) && !bank.Holds(g.probes[0]))
          groups.push_back(std::move(g));
    }
  }
  return groups;
}

/// Share of the squared error above the noise that stands in the rotor's motion (and in records
/// that are not over time).
double MotionPart(const CaseModel& model, const FitResult& base) {
  double all = 0, motion = 0;
  for (const Target& t : model.targets()) {
    double excess = 0;
    for (std::size_t k = t.first; k < t.first + t.count; ++k)
      if (model.ok()[k]) excess += base.residual[k] * base.residual[k] - 1;
    all += excess;
    if (ShowsMotion(model, t) || !OverTime(model.data().records[t.record])) motion += excess;
  }
  return all > 0 ? motion / all : 1;
}

/// Whether the best candidate leaves so much of the rotor's motion that a resonance may be behind
/// it. Beside effects that were adopted a resonance has to explain most of all that is left: what
/// it makes of the currents through the loop is some ten times what it makes of the motion, so a
/// thirtieth has to be motion.
bool MotionIsOpen(const CaseModel& model, const FitResult& base, SignatureBank& bank,
                  const std::vector<Candidate>& ranked, double effective_sample_size) {
  constexpr double kExplained = 0.9;  // of the squared error above the noise; a linear step errs
  constexpr double kLeastMotion = 1.0 / 30;  // of the same, beside other effects
  if (HoldsAdopted(model, base) && MotionPart(model, base) < kLeastMotion) return false;
  if (ranked.empty()) return true;
  const LinearJudge judge(model, base, bank, effective_sample_size);
  double most = 0;
  for (const SignatureBank::Entry& entry : bank.entries())
    if (IsSameName(entry.group.probes[0], ranked[0].effect))
      most = std::max(most, judge.MotionShare(entry));
  return most < kExplained;
}

/// An effect that changes nothing here (it cannot act on this bearing, or nothing excites it).
bool ChangesNothing(const LinearJudge& judge, const SignatureBank::Entry& entry) {
  double most = 0;
  for (Eigen::Index k = 0; k < entry.count(); ++k)
    most = std::max(most, judge.SignatureSize(entry, k));
  return most < kInvisible;
}

/// Best start of every (effect, target) that the fit does not hold yet, with the next best beside
/// it.
std::vector<Candidate> Rank(const CaseModel& model, const FitResult& base,
                            const ScreenOptions& options, SignatureBank& bank) {
  const LinearJudge judge(model, base, bank, options.effective_sample_size);
  std::vector<Candidate> all, out;
  for (std::size_t k = 0; k < bank.entries().size(); ++k) {
    const SignatureBank::Entry& entry = bank.entries()[k];
    const EffectInstance& probe = entry.group.probes[0];
    if (base.hypothesis.Holds(probe)) continue;
    if (options.coarse && !IsCoarse(EffectNamed(probe.name), probe.target)) continue;
    if (ChangesNothing(judge, entry)) continue;
    Candidate c = judge.Single(entry);
    c.entry = k;
    if (std::isfinite(c.score)) all.push_back(std::move(c));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score < b.score; });
  for (Candidate& c : all) {
    auto same = std::find_if(out.begin(), out.end(),
                             [&](const Candidate& o) { return IsSameName(o.effect, c.effect); });
    if (same == out.end()) {
      out.push_back(std::move(c));
      continue;
    }
    if (same->other_starts.size() >= (c.narrow ? kResonanceStarts : kOtherStarts)) continue;
    same->other_starts.push_back(c.effect);
    same->other_starts.insert(same->other_starts.end(), c.other_starts.begin(),
                              c.other_starts.end());
  }
  return out;
}

}  // namespace

std::vector<Candidate> Screen(const CaseModel& model, const FitResult& base,
                              const ResidualPeaks& peaks, const ScreenOptions& options,
                              SignatureBank& bank) {
  const bool again = !bank.entries().empty();
  if (!options.coarse || again) bank.LookAt(model, RecordsShowing(model, base));
  const auto part = [&](double from, double to) {
    return [&options, from, to](double f, const std::string& text) {
      if (options.progress) options.progress(from + (to - from) * f, text);
    };
  };
  std::vector<Candidate> out;
  const auto screen = [&](ScreenedKind kind, double from, double to) {
    if (kind == ScreenedKind::kResonances) part(from, to)(0, "resonances");
    bank.Simulate(model, base, GroupsToRun(model, base, peaks, kind, options, bank, again),
                  part(from, to));
    out = Rank(model, base, options, bank);
  };
  screen(ScreenedKind::kOrdinary, 0, 0.4);
  const bool asked = !options.effect.empty();
  if (asked || (options.resonances && options.frequencies && !options.coarse &&
                MotionIsOpen(model, base, bank, out, options.effective_sample_size)))
    screen(ScreenedKind::kResonances, 0.4, 0.7);
  if (options.coarse || HoldsCoils(bank)) return out;
  // Beside what was found, or after an earlier look, only what stands out in a channel is worth so
  // many.
  if ((again || HoldsAdopted(model, base)) &&
      WorstRatio(model, base.residual, Which::kFit) < kStandsOut)
    return out;
  // Single coils are many; they are tried where nothing else explains nearly all.
  const auto open = [](double before, double after) {
    return after * after - 1 > std::max(0.01, 0.03 * (before * before - 1));
  };
  if (!options.effect.empty() || out.empty() || open(base.ratio_fit, out[0].ratio_fit) ||
      open(base.ratio_validate, out[0].ratio_validate)) {
    screen(ScreenedKind::kCoils, 0.7, 1);
  }
  return out;
}

std::vector<CandidatePair> ScreenPairs(const CaseModel& model, const FitResult& base,
                                       double effective_sample_size, SignatureBank& bank,
                                       std::size_t count) {
  const LinearJudge judge(model, base, bank, effective_sample_size);
  const auto& entries = bank.entries();
  // with a later entry, one per (effect, target)
  std::vector<std::vector<CandidatePair>> best_of(entries.size());
  InParallel(entries.size(), [&](std::size_t i) {
    const EffectInstance& a = entries[i].group.probes[0];
    if (base.hypothesis.Holds(a) || ChangesNothing(judge, entries[i])) return;
    std::vector<CandidatePair>& best = best_of[i];
    for (std::size_t j = i + 1; j < entries.size(); ++j) {
      const EffectInstance& b = entries[j].group.probes[0];
      if (IsSameName(a, b) || base.hypothesis.Holds(b) || ChangesNothing(judge, entries[j]))
        continue;
      CandidatePair p = judge.Pair(entries[i], entries[j]);
      if (std::isfinite(p.score)) best.push_back(std::move(p));
    }
    const std::size_t keep = std::min(best.size(), 4 * count);
    std::partial_sort(best.begin(), best.begin() + static_cast<std::ptrdiff_t>(keep), best.end(),
                      [](const auto& x, const auto& y) { return x.score < y.score; });
    best.resize(keep);
  });
  std::vector<CandidatePair> all, out;
  for (auto& some : best_of) all.insert(all.end(), some.begin(), some.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& x, const auto& y) { return x.score < y.score; });
  for (CandidatePair& p : all) {
    if (out.size() >= count) break;
    if (std::none_of(out.begin(), out.end(), [&](const CandidatePair& o) {
          return IsSameName(o.first, p.first) && IsSameName(o.second, p.second);
        }))
      out.push_back(std::move(p));
  }
  return out;
}

}  // namespace ambrig
