/// ambrig rig: a rig file resolved, as a table and as JSON for drawings.
#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/json/rig_json.h"
#include "app/pages/html.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

struct RigCommand {
  CommonOptions common;
  std::string file;
};

void PrintRig(const RigParameters& rig) {
  fmt::print("{}: {} rotor, controller {}\n", rig.name.empty() ? rig.file : rig.name,
             rig.rotor_kind, rig.controller.kind);
  fmt::print("{:<10} {:<12} {:>6} {:>10}  {}\n", "bearing", "kind", "coils", "z [mm]", "axes");
  for (const BearingParameters& b : rig.bearings)
    fmt::print("{:<10} {:<12} {:>6} {:>10.3f}  {}\n", b.name, b.kind->name, b.coils(), 1e3 * b.z,
               fmt::join(b.Axes(), " "));
  for (const Tolerance& t : rig.tolerances) {
    const double* value = ParameterAt(rig, t.path);
    if (!value) continue;
    double lo = 0, hi = 0;
    std::string unit;
    ParameterRange(rig, t.path, &lo, &hi, &unit);
    fmt::print("{:<36} {:>12.6g} sd {:.2g}{} {}\n", t.path, *value, t.sd,
               std::isnan(t.true_value) ? "" : fmt::format(", fitted {:.6g}", t.true_value),
               unit == "-" ? "" : unit);
  }
  for (const EffectInstance& e : rig.effects) fmt::print("effect {} at {}\n", e.name, e.target);
}

int RunRig(const RigCommand& o) {
  o.common.CheckOutputs({o.file});
  const RigParameters rig = ReadRig(o.file);
  PrintRig(rig);
  const nlohmann::ordered_json json = RigJson(rig);
  o.common.WriteJson(json);
  if (o.common.html.empty()) return 0;
  std::vector<std::vector<Cell>> rows;
  for (const auto& [path, v] : json["values"].items())
    rows.push_back({Cell(path), Cell(v["value"].dump()), Cell(v["unit"].get<std::string>()),
                    Cell(v.contains("sd") ? v["sd"].dump() : ""),
                    Cell(v.contains("fitted") ? v["fitted"].dump() : "")});
  HtmlReport report(rig.name.empty() ? o.file : rig.name, "ambrig rig");
  report.Table({"path", "value", "unit", "sd", "fitted"}, rows);
  report.Write(o.common.html);
  return 0;
}

}  // namespace

void AddRig(CLI::App& app, Work& work) {
  auto options = std::make_shared<RigCommand>();
  CLI::App* command = app.add_subcommand(
      "rig", "show a rig file resolved: every value, tolerance, coil and effect");
  command->add_option("rig", options->file, "rig file (TOML)")->required();
  options->common.AddTo(*command);
  command->footer(
      "Examples:\n  ambrig rig examples/reference/rig.toml\n"
      "  ambrig rig examples/reference/rig.toml --json resolved.json --html rig.html\n"
      "The JSON holds defaults and like = filled in, and angle, turns and gap of every\n"
      "coil. What differs between two rig files: ambrig diff A.toml B.toml");
  command->callback([options, &work] { work = [options] { return RunRig(*options); }; });
}

}  // namespace ambrig
