/// ambrig effects: the catalogue of physical effects.
#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/pages/html.h"
#include "app/text/screen.h"
#include "effects/catalogue.h"
#include "rig/parameters/bearing_kind.h"

namespace ambrig {

namespace {

const char* EffectTargetText(TargetKind kind) {
  switch (kind) {
    case TargetKind::kRig:
      return "rig";
    case TargetKind::kBearing:
      return "bearing";
    case TargetKind::kPlane:
      return "plane";
    case TargetKind::kPlaneOrZ:
      return "plane or z";
    case TargetKind::kPlaneOrRig:
      return "plane or rig";
    case TargetKind::kCoil:
      return "coil";
    case TargetKind::kCoilOrBearing:
      return "coil or bearing";
    case TargetKind::kAxis:
      return "axis";
    case TargetKind::kAny:
      return "plane, coil, axis or rig";
  }
  return "";
}

/// "radial, thrust, opposed": the bearings that an effect of coils or magnets can act on; empty:
/// not a matter of them.
std::string ActsOnText(const EffectDescription& d) {
  std::string names;
  bool all = true;
  for (const BearingKind* k : BearingKinds()) {
    const bool can = (d.acts_on & k->acts_on) != 0;
    all = all && can;
    if (can) names += (names.empty() ? "" : ", ") + std::string(k->name);
  }
  if ((d.acts_on & kOnPoleByPole) != 0 && !all) names += ", stator with a coil on each pole";
  return all ? "" : names;
}

nlohmann::ordered_json DescriptionJson(const EffectDescription& d) {
  nlohmann::ordered_json parameters = nlohmann::ordered_json::array();
  const auto number = [](double v) {
    return std::isfinite(v) ? nlohmann::ordered_json(v)
                            : nlohmann::ordered_json(v > 0 ? "inf" : "-inf");
  };
  for (const EffectParameter& p : d.parameters)
    parameters.push_back({{"name", p.name},
                          {"unit", p.unit},
                          {"null", number(p.null_value)},
                          {"min", number(p.lo)},
                          {"max", number(p.hi)},
                          {"typical", {number(p.typical_lo), number(p.typical_hi)}},
                          {"doc", p.doc}});
  return {{"name", d.id},
          {"title", d.title},
          {"target", EffectTargetText(d.target)},
          {"acts_on", ActsOnText(d)},
          {"physics", d.physics},
          {"parameters", parameters},
          {"shows_in", d.shows_in},
          {"confused_with", d.confused_with}};
}

void PrintOne(const EffectDescription& d) {
  const auto line = [](const char* name, const std::string& text) {
    fmt::print("{}\n", Wrapped(fmt::format("  {:<14} {}", name, text), 17));
  };
  fmt::print("{} - {}\n", Coloured(d.id, "bold"), d.title);
  line("target", EffectTargetText(d.target));
  if (const std::string kinds = ActsOnText(d); !kinds.empty()) line("acts on", kinds);
  line("physics", d.physics);
  line("shows in", d.shows_in);
  line("confused with", d.confused_with);
  fmt::print("  parameters\n");
  for (const EffectParameter& p : d.parameters) {
    fmt::print("{}\n", Wrapped(fmt::format("    {} [{}]: {}", p.name, p.unit, p.doc), 6));
    fmt::print("      off at {}, possible {} to {}, usual {} to {}\n", p.null_value, p.lo, p.hi,
               p.typical_lo, p.typical_hi);
  }
}

}  // namespace

void AddEffects(CLI::App& app, Work& work) {
  struct Options {
    CommonOptions common;
    std::string name;
    bool markdown = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("effects", "list the catalogue of physical effects, or describe one");
  command->add_option("name", options->name, "one effect in detail");
  command->add_flag("--markdown", options->markdown, "print docs/effects.md");
  options->common.AddTo(*command);
  command->footer("Examples:\n  ambrig effects\n  ambrig effects eddy-currents");
  command->callback([options, &work] {
    work = [options] {
      options->common.CheckOutputs({});
      nlohmann::ordered_json all = nlohmann::ordered_json::array();
      if (!options->name.empty()) EffectNamed(options->name);
      HtmlReport report("The catalogue of effects", "ambrig effects");
      std::vector<std::vector<Cell>> rows;
      if (options->markdown)
        fmt::print(
            "# Catalogue of effects\n\nMade by `ambrig effects --markdown`; a test keeps it so. "
            "Usual sizes of what switches an effect on count from its null.\n");
      for (const EffectDescription& d : Catalogue()) {
        if (!options->name.empty() && d.id != options->name) continue;
        all.push_back(DescriptionJson(d));
        rows.push_back({Cell(d.id), Cell(EffectTargetText(d.target)), Cell(d.physics),
                        Cell(d.shows_in), Cell(d.confused_with)});
        if (options->markdown) {
          const std::string kinds = ActsOnText(d);
          fmt::print(
              "\n## {}\n\n{}. Target: {}{}. {}\n\nShows in: {}. Confused with: {}.\n\n| parameter "
              "| "
              "unit | null | possible | usual | meaning |\n|---|---|---|---|---|---|\n",
              d.id, d.title, EffectTargetText(d.target), kinds.empty() ? "" : " of kind " + kinds,
              d.physics, d.shows_in, d.confused_with);
          for (const EffectParameter& p : d.parameters)
            fmt::print("| `{}` | {} | {} | {} to {} | {} to {} | {} |\n", p.name, p.unit,
                       p.null_value, p.lo, p.hi, p.typical_lo, p.typical_hi, p.doc);
        } else if (!options->name.empty()) {
          PrintOne(d);
        } else {
          fmt::print("{}\n", Wrapped(fmt::format("{:<22} {:<15} {}", d.id,
                                                 EffectTargetText(d.target), d.title),
                                     39));
        }
      }
      options->common.WriteJson(all);
      if (!options->common.html.empty()) {
        report.Heading("Effects");
        report.Table({"effect", "target", "physics", "shows in", "confused with"}, rows);
        report.Write(options->common.html);
      }
      return 0;
    };
  });
}

}  // namespace ambrig
