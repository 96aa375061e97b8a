/// ambrig redistribute: current distribution after coil failures.
#include <fmt/format.h>

#include <algorithm>

#include "app/commands/commands.h"
#include "app/commands/progress.h"
#include "app/pages/html.h"
#include "faulttolerance/redistribution/redistribution_json.h"
#include "faulttolerance/redistribution/redistribution_setup.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

struct RedistributeOptions {
  CommonOptions common;
  std::string rig, bearing = "A", failed;
};

std::vector<std::vector<int>> FailedSets(const std::string& text) {
  if (text.empty() || text == "all") return AllFailureSets();
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
      if (used != word.size() || coil < 1 || coil > kPoles)
        throw InputError(
            fmt::format("--failed = {}: unknown coil \"{}\", allowed: 1 to {}, e.g. 1,2 or 1;1,2",
                        text, word, kPoles));
      if (std::find(set.begin(), set.end(), coil) != set.end())
        throw InputError(fmt::format("--failed = {}: coil {} is named twice", text, coil));
      set.push_back(coil);
    }
    if (set.empty())
      throw InputError(
          fmt::format("--failed = {}: a set without a coil, allowed: 1 to {}, e.g. 1,2 or 1;1,2",
                      text, kPoles));
    std::sort(set.begin(), set.end());
    sets.push_back(set);
  }
  if (sets.empty())
    throw InputError(fmt::format("--failed = {}: no coil, allowed: 1 to {}", text, kPoles));
  return sets;
}

std::string SetText(const nlohmann::json& failed) {
  std::string text;
  for (const auto& j : failed) text += (text.empty() ? "{" : ",") + std::to_string(j.get<int>());
  return text + "}";
}

void WriteReport(const RedistributeOptions& o, const nlohmann::json& json) {
  HtmlReport report("Current distribution after coil failures",
                    fmt::format("rig {}, bearing {}", o.rig, o.bearing));
  report.Heading("Failure sets");
  report.Text(
      "Exact: the force is k c0 v for every command. Linearised: no bias force and full gain at "
      "the operating "
      "point only. Capacities are relative to the healthy bearing.");
  std::vector<std::vector<Cell>> rows;
  for (const auto& s : json["sets"]) {
    const std::string cls = s["class"];
    rows.push_back({Cell(SetText(s["failed"])),
                    Cell(cls, cls == "exact"        ? "ok"
                              : cls == "linearised" ? "warn"
                                                    : "fail"),
                    Cell(fmt::format("{:.2e}", s["residual"].get<double>())),
                    Cell(fmt::format("{:.3f}", s["rho"].get<double>())),
                    Cell(s["unipolar"].get<bool>() ? "yes" : "no"),
                    Cell(fmt::format("{:.3f}", s["capacity"]["flux"].get<double>())),
                    Cell(fmt::format("{:.3f}", s["capacity"]["current"].get<double>()))});
  }
  report.Table(
      {"failed", "class", "residual", "rho", "unipolar", "capacity, flux", "capacity, current"},
      rows);
  report.Write(o.common.html);
}

int Redistribute(const RedistributeOptions& o) {
  const RigParameters rig = ReadRig(o.rig);
  const BearingParameters* b = rig.Find(o.bearing);
  if (!b || b->kind != BearingKind::kRadial) {
    std::string known;
    for (const auto& k : rig.bearings)
      if (k.kind == BearingKind::kRadial) known += (known.empty() ? "" : ", ") + k.name;
    throw InputError(fmt::format("--bearing = {}, allowed: {}", o.bearing, known));
  }
  const auto sets = FailedSets(o.failed);
  DistributionOptions best;
  best.policy = DistributionPolicy::kCapacity;
  const RedistributionTable table(RedistributionProblemOf(NominalRig(rig), *b),
                                  RedistributionCacheDirectory(), best);
  {
    Progress progress("redistribute");
    for (std::size_t k = 0; k < sets.size(); ++k) {
      if (interrupted) throw Interrupted();
      table.Lookup(sets[k]);
      progress.Update(static_cast<double>(k + 1) / static_cast<double>(sets.size()),
                      fmt::format("set {} of {}", k + 1, sets.size()));
    }
  }
  const nlohmann::json json = RedistributionJson(o.bearing, table, sets);
  fmt::print("{:<20} {:<11} {:>9} {:>7} {:>9} {:>9} {:>9}\n", "failed", "class", "residual", "rho",
             "unipolar", "cap.flux", "cap.cur.");
  for (const auto& s : json["sets"])
    fmt::print("{:<20} {:<11} {:>9.1e} {:>7.3f} {:>9} {:>9.3f} {:>9.3f}\n", SetText(s["failed"]),
               s["class"].get<std::string>(), s["residual"].get<double>(), s["rho"].get<double>(),
               s["unipolar"].get<bool>() ? "yes" : "no", s["capacity"]["flux"].get<double>(),
               s["capacity"]["current"].get<double>());
  if (sets.size() == 1) {
    fmt::print("W (rows: coils; i = W [c0, vx, vy]'), k = {:.6g} N/A2, c0 = {} A\n",
               json["k"].get<double>(), json["c0"].get<double>());
    for (const auto& row : json["sets"][0]["W"])
      fmt::print("  {:>10.6f} {:>10.6f} {:>10.6f}\n", row[0].get<double>(), row[1].get<double>(),
                 row[2].get<double>());
  }
  o.common.WriteJson(json);
  if (!o.common.html.empty()) WriteReport(o, json);
  return 0;
}

}  // namespace

void AddRedistribute(CLI::App& app, Work& work) {
  auto options = std::make_shared<RedistributeOptions>();
  CLI::App* command =
      app.add_subcommand("redistribute", "compute the current distribution after coil failures");
  command->add_option("rig", options->rig, "rig file (TOML)")->required();
  command->add_option("--bearing", options->bearing, "radial bearing")->capture_default_str();
  command->add_option("--failed", options->failed,
                      "failed coils, e.g. 1,2 ; several sets 1;1,2 (default: all 255 sets)");
  options->common.AddTo(*command);
  command->footer(
      "Examples:\n"
      "  ambrig redistribute examples/reference/rig.toml --bearing A --failed 1,2\n"
      "  ambrig redistribute examples/reference/rig.toml --failed '3;3,4'");
  command->callback([options, &work] { work = [options] { return Redistribute(*options); }; });
}

}  // namespace ambrig
