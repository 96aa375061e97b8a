/// ambrig rotor convert: shafts from ROSS's rotor file to ours and back.
#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/report/html.h"
#include "core/base/errors.h"
#include "core/math/constants.h"
#include "rotor/ross_file.h"
#include "rotor/rotor_modes.h"
#include "rotor/shaft_file.h"

namespace ambrig {

namespace {

struct Convert {
  CommonOptions common;
  std::string in, out;
};

std::string Joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& w : words) text += (text.empty() ? "" : ", ") + w;
  return text;
}

int Run(const Convert& c) {
  bool ross = false;
  std::vector<std::string> ignored;
  const BeamFile file = ReadShaft(c.in, &ross, &ignored);
  if (ross && !c.out.ends_with(".toml"))
    throw InputError(fmt::format("{}: allowed: a .toml file (its [rotor] is ambrig's)", c.out));
  if (!ross && !c.out.ends_with(".toml") && !c.out.ends_with(".json"))
    throw InputError(fmt::format("{}: allowed: a .toml or .json file, as ROSS loads them", c.out));
  const BeamRotor beam = BuildBeam(file.definition);
  const RotorTotals totals = Totals(beam);
  std::vector<double> hertz;
  for (const double w : FreeModes(beam, 4).omega) hertz.push_back(w / (2 * kPi));
  if (ross)
    WriteBeam(file, c.out);
  else
    WriteRoss(file.definition, c.out);
  fmt::print("{}: {} -> {}\n", c.out, ross ? "ROSS" : "ambrig", ross ? "ambrig" : "ROSS");
  fmt::print("  mass {:.6g} kg, centre of mass z = {:.6g} m, free bending {:.2f} Hz\n", totals.mass, totals.z_com,
             fmt::join(hertz, " "));
  if (!ignored.empty()) fmt::print("  not carried over: {}\n", Joined(ignored));
  nlohmann::ordered_json j = {{"in", c.in},           {"out", c.out},
                              {"from", ross ? "ross" : "ambrig"}, {"mass", totals.mass},
                              {"z_com", totals.z_com}, {"free_bending_hz", hertz},
                              {"ignored", ignored}};
  c.common.WriteJson(j);
  if (!c.common.html.empty()) {
    HtmlReport report("Shaft " + c.in, "ambrig rotor convert");
    report.KeyValues({{"written", c.out},
                      {"mass", fmt::format("{:.6g} kg", totals.mass)},
                      {"centre of mass", fmt::format("{:.6g} m", totals.z_com)},
                      {"free bending", fmt::format("{:.2f} Hz", fmt::join(hertz, " "))},
                      {"not carried over", ignored.empty() ? "nothing" : Joined(ignored)}});
    report.Write(c.common.html);
  }
  return 0;
}

}  // namespace

void AddRotor(CLI::App& app, Work& work) {
  auto options = std::make_shared<Convert>();
  CLI::App* rotor = app.add_subcommand("rotor", "beam rotors: convert between ROSS's file and ambrig's");
  rotor->require_subcommand(1);
  CLI::App* convert = rotor->add_subcommand("convert", "a shaft from ROSS's rotor file to a [rotor], or back");
  convert->add_option("IN", options->in, "ROSS's file (.toml, .json), or a .toml with [rotor] kind = \"beam\"")
      ->required();
  convert->add_option("OUT", options->out, "the other kind")->required();
  options->common.AddTo(*convert);
  convert->footer(
      "Examples:\n  ambrig rotor convert rotor.json shaft.toml    then, in a rig: [rotor] kind = \"beam\", file = "
      "\"shaft.toml\"\n  ambrig rotor convert rig.toml rotor.json      for ross.Rotor.load");
  convert->callback([options, &work] { work = [options] { return Run(*options); }; });
}

}  // namespace ambrig
