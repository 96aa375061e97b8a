#include "campaign/campaign_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "campaign/campaign_values.h"
#include "faulttolerance/redistribution/redistribution_table.h"
#include "rig/parameters/bearing_kind.h"
#include "scenarios/faults/fault_file.h"

namespace ambrig {

namespace {

std::vector<std::vector<int>> CoilSets(const TomlTable& t) {
  const std::vector<std::string> names{"none", "single", "double", "triple", "quadruple"};
  if (t.IsString("sets") || !t.Has("sets")) {
    const std::string which =
        t.Choice("sets", "none", "none, single, double, triple, quadruple, all");
    if (which == "none") return {{}};
    const auto size =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), which) - names.begin());
    std::vector<std::vector<int>> sets = AllFailureSets();
    if (which != "all") std::erase_if(sets, [&](const auto& s) { return s.size() != size; });
    return sets;
  }
  std::vector<std::vector<int>> sets;
  for (const auto& row : t.Rows("sets")) {
    std::vector<int> set;
    for (const double v : row) {
      if (v != std::floor(v) || v < 1 || v > kPoles ||
          std::count(set.begin(), set.end(), static_cast<int>(v)) > 0)
        t.Fail("sets", fmt::format("= [..{}..] in set {}, allowed: different coils from 1 to {}, "
                                   "or none, single, double, "
                                   "triple, quadruple, all",
                                   v, sets.size() + 1, kPoles));
      set.push_back(static_cast<int>(v));
    }
    std::sort(set.begin(), set.end());
    if (std::count(sets.begin(), sets.end(), set) > 0)
      t.Fail("sets", fmt::format("= set {} is given twice", sets.size() + 1));
    sets.push_back(set);
  }
  if (sets.empty()) t.Fail("sets", "= [], allowed: e.g. [[1], [1, 2]]");
  return sets;
}

/// Of these sets, those that the bearing has the coils for. A set that a file lists must be one of
/// them.
std::vector<std::vector<int>> SetsOf(const BearingParameters& b, const TomlTable& t) {
  std::vector<std::vector<int>> sets = CoilSets(t);
  const auto beyond = [&](const std::vector<int>& s) { return !s.empty() && s.back() > b.coils(); };
  if (t.Has("sets") && !t.IsString("sets"))
    for (const auto& set : sets)
      if (beyond(set))
        t.Fail("sets", fmt::format("= [..{}..] with bearing {}, allowed: its coils, 1 to {}",
                                   set.back(), b.name, b.coils()));
  std::erase_if(sets, beyond);
  return sets;
}

/// Those whose faults a campaign counts; the default is the first with eight poles.
std::vector<std::string> Bearings(const TomlTable& t, const RigParameters& rig) {
  std::string known;
  std::vector<std::string> all;
  for (const auto& b : rig.bearings)
    if (!b.kind->linearise) {
      known += (known.empty() ? "" : ", ") + b.name;
      all.push_back(b.name);
    }
  if (all.empty())
    t.Fail("bearings",
           fmt::format("of {} are stators of other kinds, whose faults campaigns do not "
                       "count, allowed: rigs with a bearing of kind radial, thrust or "
                       "opposed",
                       rig.file));
  if (!t.Has("bearings")) {
    const auto radial = std::ranges::find_if(
        rig.bearings, [](const BearingParameters& b) { return b.kind->eight_poles; });
    return {radial == rig.bearings.end() ? all.front() : radial->name};
  }
  const auto names = t.Strings("bearings");
  if (names.empty()) t.Fail("bearings", "= [], allowed: some of " + known);
  for (std::size_t k = 0; k < names.size(); ++k)
    if (std::count(all.begin(), all.end(), names[k]) == 0 ||
        std::count(names.begin(), names.end(), names[k]) > 1)
      t.Fail("bearings", fmt::format("= \"{}\", allowed: each once of {}", names[k], known));
  return names;
}

/// The kinds that a coil may have, by the scenario reader's rules.
CampaignFaultKind ReadKind(const TomlTable& t, const RigParameters& rig) {
  constexpr FaultTarget kCoil[] = {FaultTarget::kCoil};
  CampaignFaultKind k;
  k.kind = ReadFault(t, FaultKindNames(kCoil), rig, &k.parameters).kind;
  k.label = k.kind;
  for (const auto& [key, value] : k.parameters) k.label += fmt::format(" {}={}", key, value);
  t.RejectUnknownKeys();
  return k;
}

/// simultaneous before sequential, each once.
std::vector<std::string> Onsets(const TomlTable& t) {
  std::vector<std::string> onsets = t.Has("onset") && !t.IsString("onset")
                                        ? t.Strings("onset")
                                        : std::vector{t.String("onset", "simultaneous")};
  for (const auto& o : onsets)
    if (o != "simultaneous" && o != "sequential")
      t.Fail("onset",
             fmt::format("= \"{}\", allowed: simultaneous, sequential, or a list of both", o));
  std::sort(onsets.begin(), onsets.end(), std::greater<>());  // simultaneous first
  onsets.erase(std::unique(onsets.begin(), onsets.end()), onsets.end());
  if (onsets.empty()) t.Fail("onset", "= [], allowed: simultaneous, sequential");
  return onsets;
}

}  // namespace

void ReadFaults(const TomlTable& root, Campaign& c) {
  const auto t = root.Table("faults");
  if (!t) {
    c.sets = {{c.rig.bearings.front().name, {}}};
    c.kinds = {{"none", "none", {}}};
    c.cases = {{}};
    return;
  }
  const auto bearings = Bearings(*t, c.rig);
  if (t->Bool("healthy", false)) c.sets.push_back({bearings.front(), {}});
  for (const auto& b : bearings)
    for (const auto& coils : SetsOf(*c.rig.Find(b), *t)) c.sets.push_back({b, coils});
  for (const TomlTable& k : t->Tables("kind")) c.kinds.push_back(ReadKind(k, c.rig));
  const bool healthy =
      std::all_of(c.sets.begin(), c.sets.end(), [](const auto& s) { return s.coils.empty(); });
  if (healthy && !c.kinds.empty())
    t->Fail("kind", "is given, but sets = \"none\"; allowed: other sets");
  if (c.kinds.empty())
    c.kinds = {healthy ? CampaignFaultKind{"none", "none", {}}
                       : CampaignFaultKind{"open", "open", {}}};
  const std::vector<std::string> onsets = Onsets(*t);
  for (std::size_t s = 0; s < c.sets.size(); ++s) {
    if (c.sets[s].coils.empty() && !healthy) {
      // A healthy set among others: no kind applies.
      if (c.kinds.back().kind != "none") c.kinds.push_back({"none", "none", {}});
      c.cases.push_back({s, c.kinds.size() - 1, false});
      continue;
    }
    for (std::size_t k = 0; k < c.kinds.size(); ++k) {
      if (c.kinds[k].kind == "none" && !healthy) continue;
      for (std::size_t o = 0; o < onsets.size(); ++o)
        if (o == 0 || c.sets[s].coils.size() > 1)
          c.cases.push_back({s, k, onsets[o] == "sequential"});
    }
  }
  c.fault_time = In(*t, "time", 0.02, 0, 1e5, "s");
  c.spacing = In(*t, "spacing", 0.02, 1e-6, 1e5, "s");
  c.phases = List(*t, "phases", {0.0}, 0, 1, "(share of the control period)");
  t->RejectUnknownKeys();
  std::size_t most = 0;
  for (const FailureSet& s : c.sets) most = std::max(most, s.coils.size());
  const bool sequential = std::count(onsets.begin(), onsets.end(), "sequential") > 0;
  const double last = c.fault_time +
                      (sequential && most > 0 ? static_cast<double>(most - 1) * c.spacing : 0) +
                      1 / c.rig.controller.rate;
  for (const Scenario& s : c.scenarios)
    if (!healthy && last >= s.duration)
      t->Fail(
          "time",
          fmt::format("= {} s: the last fault comes at {} s, allowed: below the duration of {} s",
                      c.fault_time, last, s.duration));
}

}  // namespace ambrig
