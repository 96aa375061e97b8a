#include "campaign/campaign_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/base/counted.h"
#include "core/base/fingerprint.h"
#include "core/base/read_file.h"
#include "core/base/toml_checked.h"
#include "faulttolerance/redistribution/redistribution_table.h"
#include "rig/rig_file.h"
#include "scenarios/faults/fault_file.h"

namespace ambrig {

namespace {

// of the enumeration and the rows: raise it when row k means another run
constexpr int kFormat = 2;
constexpr std::size_t kMostRuns = 10'000'000;

std::vector<double> List(const TomlTable& t, const char* key, const std::vector<double>& fallback,
                         double lo, double hi, const char* unit) {
  const std::vector<double> values =
      t.IsNumber(key) ? std::vector<double>{t.Number(key)} : t.Numbers(key, fallback);
  if (values.empty())
    t.Fail(key, fmt::format("= [], allowed: at least one number from {} to {} {}", lo, hi, unit));
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!(values[k] >= lo && values[k] <= hi))
      t.Fail(key, fmt::format("= {}, allowed: {} to {} {}", values[k], lo, hi, unit));
    for (std::size_t j = 0; j < k; ++j)
      if (values[j] == values[k])
        t.Fail(key, fmt::format("= {} is given twice, allowed: different values", values[k]));
  }
  return values;
}

double In(const TomlTable& t, const char* key, double fallback, double lo, double hi,
          const char* unit) {
  const double v = t.Number(key, fallback);
  if (!(v >= lo && v <= hi))
    t.Fail(key, fmt::format("= {}, allowed: {} to {} {}", v, lo, hi, unit));
  return v;
}

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

std::vector<std::string> Bearings(const TomlTable& t, const RigParameters& rig) {
  std::string known;
  std::vector<std::string> radial;
  for (const auto& b : rig.bearings)
    if (b.kind == BearingKind::kRadial) {
      known += (known.empty() ? "" : ", ") + b.name;
      radial.push_back(b.name);
    }
  if (!t.Has("bearings")) return {radial.empty() ? rig.bearings.front().name : radial.front()};
  const auto names = t.Strings("bearings");
  if (names.empty()) t.Fail("bearings", "= [], allowed: some of " + known);
  for (std::size_t k = 0; k < names.size(); ++k)
    if (std::count(radial.begin(), radial.end(), names[k]) == 0 ||
        std::count(names.begin(), names.end(), names[k]) > 1)
      t.Fail("bearings", fmt::format("= \"{}\", allowed: each once of {}", names[k], known));
  return names;
}

/// The kinds that a coil may have, by the scenario reader's rules.
CampaignFaultKind ReadKind(const TomlTable& t) {
  constexpr FaultTarget kCoil[] = {FaultTarget::kCoil};
  CampaignFaultKind k;
  k.kind = ReadFault(t, FaultKindNames(kCoil), &k.parameters).kind;
  k.label = k.kind;
  for (const auto& [key, value] : k.parameters) k.label += fmt::format(" {}={}", key, value);
  t.RejectUnknownKeys();
  return k;
}

void ReadFaults(const TomlTable& root, Campaign& c) {
  const auto t = root.Table("faults");
  if (!t) {
    c.sets = {{c.rig.bearings.front().name, {}}};
    c.kinds = {{"none", "none", {}}};
    c.cases = {{}};
    return;
  }
  const auto bearings = Bearings(*t, c.rig);
  for (const auto& b : bearings)
    for (const auto& coils : CoilSets(*t)) c.sets.push_back({b, coils});
  for (const TomlTable& k : t->Tables("kind")) c.kinds.push_back(ReadKind(k));
  const bool healthy =
      std::all_of(c.sets.begin(), c.sets.end(), [](const auto& s) { return s.coils.empty(); });
  if (healthy && !c.kinds.empty())
    t->Fail("kind", "is given, but sets = \"none\"; allowed: other sets");
  if (c.kinds.empty())
    c.kinds = {healthy ? CampaignFaultKind{"none", "none", {}}
                       : CampaignFaultKind{"open", "open", {}}};
  std::vector<std::string> onsets = t->Has("onset") && !t->IsString("onset")
                                        ? t->Strings("onset")
                                        : std::vector{t->String("onset", "simultaneous")};
  for (const auto& o : onsets)
    if (o != "simultaneous" && o != "sequential")
      t->Fail("onset",
              fmt::format("= \"{}\", allowed: simultaneous, sequential, or a list of both", o));
  std::sort(onsets.begin(), onsets.end(), std::greater<>());  // simultaneous first
  onsets.erase(std::unique(onsets.begin(), onsets.end()), onsets.end());
  if (onsets.empty()) t->Fail("onset", "= [], allowed: simultaneous, sequential");
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

void ReadOperation(const TomlTable& root, Campaign& c) {
  const auto t = root.Table("operation");
  if (!t) return;
  if (t->Has("speeds")) c.speeds = List(*t, "speeds", {}, -1e5, 1e5, "rad/s");
  c.load_unit = t->Choice("load_unit", "capacity", "capacity, N") == "N" ? LoadUnit::kNewton
                                                                         : LoadUnit::kCapacity;
  c.loads = List(*t, "loads", {0.0}, 0, c.load_unit == LoadUnit::kNewton ? 1e6 : 2,
                 c.load_unit == LoadUnit::kNewton ? "N" : "(share of the capacity)");
  c.load_angle = In(*t, "load_angle_deg", -90, -360, 360, "deg") * std::numbers::pi / 180;
  c.positions = List(*t, "positions", {0.0}, 0, 0.9, "(share of the clearance)");
  if (c.rig.controller.kind != "pid" &&
      std::any_of(c.positions.begin(), c.positions.end(), [](double p) { return p != 0; }))
    t->Fail("positions", fmt::format("other than 0 with kind = \"{}\" in {}, allowed: with a PID, "
                                     "whose reference response is known",
                                     c.rig.controller.kind, c.rig.file));
  c.position_angle = In(*t, "position_angle_deg", 0, -360, 360, "deg") * std::numbers::pi / 180;
  t->RejectUnknownKeys();
}

void ReadSpread(const TomlTable& root, Campaign& c) {
  c.draws = {{}};
  const auto t = root.Table("spread");
  if (!t) return;
  const std::string method = t->Choice("method", "latin-hypercube", "latin-hypercube, sobol");
  const long long draws = t->Integer("draws", 0);
  if (draws < 1 || draws > 1'000'000)
    t->Fail("draws", fmt::format("= {}, allowed: 1 to 1000000", draws));
  const long long seed = t->Integer("seed", 1);
  if (seed < 0) t->Fail("seed", fmt::format("= {}, allowed: 0 or more", seed));
  const double scale = In(*t, "scale", 1, 0, 10, "(times the sd)");
  int dimensions = 0;
  for (const Tolerance& k : c.rig.tolerances) dimensions += k.sd > 0 ? 1 : 0;
  if (dimensions == 0)
    t->Fail("", fmt::format("nothing to draw: no parameter of {} has an sd", c.rig.file));
  if (method == "sobol" && dimensions > kSobolDimensions)
    t->Fail("method", fmt::format("= \"sobol\" with {}, allowed: at most {}",
                                  Counted(dimensions, "parameter"), kSobolDimensions));
  const auto n = static_cast<int>(draws);
  c.draws = method == "sobol" ? Sobol(n, dimensions, static_cast<std::uint64_t>(seed))
                              : LatinHypercube(n, dimensions, static_cast<std::uint64_t>(seed));
  for (auto& point : c.draws)
    for (double& u : point) u = scale * NormalQuantile(u);
  t->RejectUnknownKeys();
}

void ReadPlantsOf(const TomlTable& root, Campaign& c) {
  const auto t = root.Table("plants");
  if (!t) return;
  if (root.Has("spread"))
    root.Fail("spread", "is given beside [plants], allowed: plants.scale, as each plant has a draw");
  c.without = t->Bool("without", false);
  c.plants = ReadPlants(*t, c.rig);
}

void ReadSeeds(const TomlTable& root, Campaign& c) {
  c.seeds.clear();
  if (root.IsArray("seeds")) {
    for (const double v : List(root, "seeds", {}, 0, 4294967295.0, "")) {
      if (v != std::floor(v)) root.Fail("seeds", fmt::format("= {}, allowed: integers", v));
      c.seeds.push_back(static_cast<std::uint64_t>(v));
    }
    return;
  }
  const long long n = root.Integer("seeds", 1);
  if (n < 1 || n > 1'000'000)
    root.Fail("seeds", fmt::format("= {}, allowed: 1 to 1000000 (how many), or a list", n));
  for (long long k = 1; k <= n; ++k) c.seeds.push_back(static_cast<std::uint64_t>(k));
}

/// The scenarios' common ground: files, or one plain levitated run described in place.
std::string ReadScenarios(const TomlTable& root, Campaign& c) {
  std::string texts;
  constexpr Range kLength{"s", 1e-6, 1e5, "length of time"};
  const double limit = Within(root, "drop_limit", 0.1, kLength);
  if (root.Has("scenarios")) {
    if (root.Has("duration")) root.Fail("duration", "is given, but the scenarios have their own");
    for (const auto& name : root.Strings("scenarios")) {
      const std::string file = Beside(c.file, name);
      if (!std::filesystem::is_regular_file(file))
        root.Fail("scenarios",
                  fmt::format("= \"{}\", allowed: scenario files ({}: no such file)", name, file));
      c.scenarios.push_back(ReadScenario(file, c.rig));
      if (!c.scenarios.back().faults.empty())
        root.Fail("scenarios", fmt::format("{} has faults, allowed: only those of [faults]", file));
      texts += ReadFile(file);
      for (const Excitation& e : c.scenarios.back().excitations)
        for (const double v : e.samples) texts += fmt::format("{} ", v);
    }
    if (c.scenarios.empty()) root.Fail("scenarios", "= [], allowed: at least one scenario file");
  } else {
    Scenario s;
    s.name = s.file = "levitated";
    s.duration = Within(root, "duration", kRequired, kLength);
    c.scenarios.push_back(s);
  }
  for (Scenario& s : c.scenarios) {
    s.drop_limit = limit;
    s.noise = root.Bool("noise", s.noise);
    s.record_rate = c.rig.controller.rate;
    s.rig_file = c.rig.file;
  }
  return texts;
}

}  // namespace

std::size_t Campaign::runs() const {
  return scenarios.size() * cases.size() * phases.size() * std::max<std::size_t>(speeds.size(), 1) *
         loads.size() * positions.size() * draws.size() * seeds.size() *
         std::max<std::size_t>(plants.size(), 1);
}

Campaign ReadCampaign(const std::string& file) {
  const TomlTable root = TomlTable::FromFile(file);
  Campaign c;
  c.file = file;
  c.name = root.String("name", std::filesystem::path(file).stem().string());
  c.rig = ReadRig(ExistingFile(root, "rig"));
  std::string texts = ReadFile(file) + ReadFile(c.rig.file);
  for (const BendingMode& m : c.rig.modes) texts += fmt::format("{} ", m.omega);  // of a beam file
  texts += ReadScenarios(root, c);
  ReadFaults(root, c);
  ReadOperation(root, c);
  ReadSpread(root, c);
  ReadPlantsOf(root, c);
  ReadSeeds(root, c);
  root.RejectUnknownKeys();
  double runs = 1;
  for (const std::size_t n :
       {c.cases.size(), c.phases.size(), c.loads.size(), c.positions.size(), c.draws.size(),
        c.seeds.size(), c.scenarios.size(), std::max<std::size_t>(c.speeds.size(), 1),
        std::max<std::size_t>(c.plants.size(), 1)})
    runs *= static_cast<double>(n);
  if (runs > static_cast<double>(kMostRuns))
    root.Fail("", fmt::format("describes {:.3g} runs, allowed: up to {}", runs, kMostRuns));
  c.fingerprint = fmt::format("{:016x}", Fingerprint(texts, Fingerprint(std::to_string(kFormat))));
  return c;
}

}  // namespace ambrig
