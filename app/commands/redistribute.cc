/// ambrig redistribute: current distribution after coil failures.
#include <fmt/format.h>

#include <algorithm>

#include "app/commands/commands.h"
#include "app/commands/progress.h"
#include "app/commands/redistribute_stator.h"
#include "app/pages/redistribute_report.h"
#include "faulttolerance/redistribution/redistribution_json.h"
#include "faulttolerance/redistribution/redistribution_setup.h"
#include "rig/nominal_control.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

struct RedistributeOptions {
  CommonOptions common;
  std::string rig, bearing = "A", failed;
};

std::vector<std::vector<int>> FailedSets(const std::string& text, int coils) {
  if (text.empty() || text == "all")
    return coils == kPoles ? AllFailureSets() : FailureSetsOf(coils);
  std::vector<std::vector<int>> sets;
  std::stringstream groups(text);
  for (std::string group; std::getline(groups, group, ';');) {
    std::vector<int> set;
    std::stringstream list(group);
    for (std::string word; std::getline(list, word, ',');) {
      std::size_t used = 0;
      int coil = 0;
      try {
        coil = std::stoi(word, &used);
      } catch (const std::exception&) {
        used = std::string::npos;
      }
      if (used != word.size() || coil < 1 || coil > coils)
        throw InputError(
            fmt::format("--failed = {}: unknown coil \"{}\", allowed: 1 to {}, e.g. 1,2 or 1;1,2",
                        text, word, coils));
      if (std::find(set.begin(), set.end(), coil) != set.end())
        throw InputError(fmt::format("--failed = {}: coil {} is named twice", text, coil));
      set.push_back(coil);
    }
    if (set.empty())
      throw InputError(fmt::format(
          "--failed = {}: a set without a coil, allowed: 1 to {}, e.g. 1,2 or 1;1,2", text, coils));
    std::sort(set.begin(), set.end());
    sets.push_back(set);
  }
  if (sets.empty())
    throw InputError(fmt::format("--failed = {}: no coil, allowed: 1 to {}", text, coils));
  return sets;
}

/// What runs do with each set, and what their map pulls.
FailureSetFigures FiguresOf(const RedistributionTable& table, const CurrentMap& healthy,
                            const std::vector<int>& failed, const RedistributionFigures& f) {
  FailureSetFigures out;
  out.failed = failed;
  RedistributionProblem left = table.problem();
  for (const int coil : failed) left.turns_left[coil - 1] = 0;
  CurrentMap map = healthy;
  const std::string cls = MapAfterFailure(table, left.turns_left, f.load, {}, &map);
  out.reach = ReachOfMap(left, map, f.load, f.most);
  out.map = map.allocation || cls == "none" ? cls : "W, " + cls;
  for (int k = 0; k < MapReach::kDirections; ++k)  // not above what the healthy bearing is used for
    out.reach.radius[k] = std::min(out.reach.radius[k], f.healthy.radius[k]);
  out.reach.worst = std::min(out.reach.worst, out.reach.radius[out.reach.worst_direction]);
  out.reach.margin = std::min(out.reach.margin, f.healthy.margin);
  return out;
}

nlohmann::json JsonOf(const MapReach& r, const Eigen::Vector2d& load) {
  return {{"carries", r.carries},
          {"margin", load.norm() > 0 ? nlohmann::json(r.margin) : nlohmann::json(nullptr)},
          {"worst", r.worst},
          {"worst_direction_deg", r.worst_direction * 360 / MapReach::kDirections},
          {"radius", r.radius}};
}

/// @throws InputError naming the bearings whose coils can take over for each other.
const BearingParameters& BearingOf(const RigParameters& rig, const RedistributeOptions& o) {
  const BearingParameters* b = rig.Find(o.bearing);
  const auto able = [](const BearingParameters& k) {
    return k.kind->eight_poles || k.kind->linearise;
  };
  if (b && able(*b)) return *b;
  std::string known;
  for (const auto& k : rig.bearings)
    if (able(k)) known += (known.empty() ? "" : ", ") + k.name;
  if (known.empty())
    throw InputError(
        fmt::format("{}: has no bearing whose coils could take over for each other, allowed: a rig "
                    "with a bearing of kind radial or stator",
                    o.rig));
  throw InputError(fmt::format("--bearing = {}, allowed: {}", o.bearing, known));
}

int Redistribute(const RedistributeOptions& o) {
  const RigParameters rig = ReadRig(o.rig);
  o.common.CheckOutputs({o.rig, rig.file});
  const BearingParameters* b = &BearingOf(rig, o);
  const auto sets = FailedSets(o.failed, b->coils());
  const NominalRig nominal(rig);
  if (b->kind->linearise)
    return RedistributeStator(nominal, static_cast<std::size_t>(b - rig.bearings.data()), sets,
                              o.common);
  const RedistributionTable table(RedistributionProblemOf(nominal, *b),
                                  RedistributionCacheDirectory());
  const auto index = static_cast<std::size_t>(b - rig.bearings.data());
  const CurrentMap healthy = MakeBearingControl(nominal, index).map;
  RedistributionFigures f;
  f.rig = o.rig;
  f.bearing = o.bearing;
  const auto share = WeightShares(rig)[index];
  f.load = {share[0], share[1]};
  f.most = PidOf(rig, *b).f_max;
  f.healthy = ReachOfMap(table.problem(), healthy, f.load, f.most);
  {
    Progress progress("redistribute");
    for (std::size_t k = 0; k < sets.size(); ++k) {
      if (interrupted) throw Interrupted();
      f.sets.push_back(FiguresOf(table, healthy, sets[k], f));
      progress.Update(static_cast<double>(k + 1) / static_cast<double>(sets.size()),
                      fmt::format("set {} of {}", k + 1, sets.size()));
    }
  }
  nlohmann::json json = RedistributionJson(o.bearing, table, sets);
  json["load"] = {f.load.x(), f.load.y()};
  json["healthy"] = JsonOf(f.healthy, f.load);
  for (std::size_t k = 0; k < sets.size(); ++k) {
    json["sets"][k]["map"] = f.sets[k].map;
    json["sets"][k]["force"] = JsonOf(f.sets[k].reach, f.load);
  }
  fmt::print("{}", RedistributionText(f));
  if (sets.size() == 1) {
    fmt::print("W (rows: coils; i = W [c0, vx, vy]'), k = {:.6g} N/A2, c0 = {} A\n",
               json["k"].get<double>(), json["c0"].get<double>());
    for (const auto& row : json["sets"][0]["W"])
      fmt::print("  {:>10.6f} {:>10.6f} {:>10.6f}\n", row[0].get<double>(), row[1].get<double>(),
                 row[2].get<double>());
  }
  o.common.WriteJson(json);
  if (!o.common.html.empty()) WriteRedistributionReport(rig, f, o.common.html);
  return 0;
}

}  // namespace

void AddRedistribute(CLI::App& app, Work& work) {
  auto options = std::make_shared<RedistributeOptions>();
  CLI::App* command =
      app.add_subcommand("redistribute", "compute the current distribution after coil failures");
  command->add_option("rig", options->rig, "rig file (TOML)")->required();
  command->add_option("--bearing", options->bearing, "radial bearing or stator")
      ->capture_default_str();
  command
      ->add_option("--failed", options->failed,
                   "failed coils, e.g. 1,2 ; several sets 1;1,2 (default: all sets)")
      ->check([](const std::string& text) {
        return text.empty() ? std::string("a set without a coil, allowed: e.g. 1,2 or 1;1,2") : "";
      });
  options->common.AddTo(*command);
  command->footer(
      "Examples:\n"
      "  ambrig redistribute examples/reference/rig.toml --bearing A --failed 1,2\n"
      "  ambrig redistribute examples/reference/rig.toml --failed '3;3,4'");
  command->callback([options, &work] { work = [options] { return Redistribute(*options); }; });
}

}  // namespace ambrig
