#include "campaign/campaign_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "campaign/campaign_faults.h"
#include "campaign/campaign_values.h"
#include "core/base/counted.h"
#include "core/base/fingerprint.h"
#include "core/base/read_file.h"
#include "core/base/toml_checked.h"
#include "core/math/normal_distribution.h"
#include "fdd/learning/commissioning_file.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

// of the enumeration and the rows: raise it when row k means another run
constexpr int kFileFormat = 2;
// Plants a worker: with fewer the last ones would keep some workers idle.
constexpr std::size_t kPlantsOfWorker = 8;

/// Positions other than 0: a row must not state one that its run was never told.
void CheckPositions(const TomlTable& t, const Campaign& c) {
  if (c.rig.controller.kind != "pid")
    t.Fail("positions", fmt::format("other than 0 with kind = \"{}\" in {}, allowed: with a PID, "
                                    "whose reference response is known",
                                    c.rig.controller.kind, c.rig.file));
  for (const FailureSet& set : c.sets) {
    const BearingParameters& b = *c.rig.Find(set.bearing);
    if (!HoldsPositions(b))
      t.Fail("positions", fmt::format("other than 0 at bearing {} of {}, allowed: at bearings of "
                                      "kind radial with an auxiliary bearing",
                                      b.name, c.rig.file));
  }
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
  if (std::ranges::any_of(c.positions, [](double p) { return p != 0; })) CheckPositions(*t, c);
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
    root.Fail("spread",
              "is given beside [plants], allowed: plants.scale, as each plant has a draw");
  c.without = t->Bool("without", false);
  CommissioningPlan& plan = c.commissioning;  // ranges as those of `ambrig commission`
  plan.duration = In(*t, "commissioning_duration", plan.duration, 0.1, 10, "s");
  plan.speed = In(*t, "commissioning_speed", plan.speed, 0, 1e5, "rad/s");
  plan.circle = In(*t, "commissioning_circle", plan.circle, 0, 0.9, "(share of the clearance)");
  plan.chirp = In(*t, "commissioning_chirp", plan.chirp, 0, 1, "(share of f_max)");
  plan.pulse = In(*t, "commissioning_pulse", plan.pulse, 0, 1, "(share of f_max)");
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

bool HoldsPositions(const BearingParameters& b) { return b.auxiliary && b.kind->eight_poles; }

std::size_t Campaign::runs() const {
  return scenarios.size() * cases.size() * phases.size() * std::max<std::size_t>(speeds.size(), 1) *
         loads.size() * positions.size() * draws.size() * seeds.size() *
         std::max<std::size_t>(plants.size(), 1);
}

std::size_t Campaign::RunsTogether(std::size_t workers) const {
  // A plant that runs with and without having been commissioned is listed twice in a row.
  const bool twice = plants.size() > 1 && plants[0].commissioned != plants[1].commissioned;
  const std::size_t machines = plants.size() / (twice ? 2 : 1);
  return machines < kPlantsOfWorker * workers ? 1 : runs() / machines;
}

Campaign ReadCampaign(const std::string& file) {
  const TomlTable root = TomlTable::FromFile(file);
  Campaign c;
  c.file = file;
  c.name = root.String("name", std::filesystem::path(file).stem().string());
  c.rig = ReadRig(ExistingFile(root, "rig"));
  std::string texts = ReadFile(file) + ReadFile(c.rig.file);
  const std::string learnt = c.rig.detection.commissioning.empty() ? CommissioningFileOf(c.rig.file)
                                                                   : c.rig.detection.commissioning;
  if (std::filesystem::is_regular_file(learnt)) texts += ReadFile(learnt);
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
  c.fingerprint =
      fmt::format("{:016x}", Fingerprint(texts, Fingerprint(std::to_string(kFileFormat))));
  return c;
}

}  // namespace ambrig
