/// ambrig rotor convert: shafts from ROSS's rotor file to ours and back.
#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/pages/html.h"
#include "app/text/screen.h"
#include "core/base/counted.h"
#include "core/base/errors.h"
#include "core/base/read_file.h"
#include "rotor/shaft/convert_shaft.h"

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

/// What is wrong with a shaft is told with the file that it came from.
ShaftConversion Converted(const Convert& c) {
  try {
    return ConvertShaft(c.in, c.out);
  } catch (const InputError& e) {
    const std::string what = e.what();
    throw InputError(what.starts_with(c.in) || what.starts_with(c.out) ? what : c.in + ": " + what);
  }
}

int Run(const Convert& c) {
  c.common.CheckOutputs({c.in}, {c.out});
  const ShaftConversion done = Converted(c);
  if (c.out.ends_with(".toml")) WriteMarkedText(c.out, "rotor convert", ReadFile(c.out));
  const std::string lost = done.not_carried.empty() ? "nothing" : Joined(done.not_carried);
  fmt::print("{}: {} -> {}\n", c.out, done.from_ross ? "ROSS" : "ambrig",
             done.from_ross ? "ambrig" : "ROSS");
  fmt::print("  mass {:.6g} kg, centre of mass z = {:.6g} m,\n  free bending {:.2f} Hz\n",
             done.mass, done.z_com, fmt::join(done.free_bending, " "));
  if (done.magnetic_bearings > 0 && !done.from_ross)
    fmt::print("  with {}\n", Counted(done.magnetic_bearings, "magnetic bearing"));
  if (done.magnetic_bearings > 0 && done.from_ross)
    fmt::print(
        "  a rig with {} of ROSS's; amplifiers, sampling, sensors\n  and auxiliary "
        "bearings are assumed, each marked in the file\n",
        Counted(done.magnetic_bearings, "magnetic bearing"));
  for (const std::string& l : done.not_carried)
    fmt::print("{}\n", Wrapped(Coloured("  warning: ", "yellow") + "not carried over: " + l, 4));
  c.common.WriteJson({{"in", c.in},
                      {"out", c.out},
                      {"from", done.from_ross ? "ross" : "ambrig"},
                      {"mass", done.mass},
                      {"z_com", done.z_com},
                      {"free_bending_hz", done.free_bending},
                      {"magnetic_bearings", done.magnetic_bearings},
                      {"not_carried", done.not_carried}});
  if (!c.common.html.empty()) {
    HtmlReport report("Shaft " + c.in, "ambrig rotor convert");
    report.KeyValues({{"written", c.out},
                      {"mass", fmt::format("{:.6g} kg", done.mass)},
                      {"centre of mass", fmt::format("{:.6g} m", done.z_com)},
                      {"free bending", fmt::format("{:.2f} Hz", fmt::join(done.free_bending, " "))},
                      {"not carried over", lost}});
    report.Write(c.common.html);
  }
  return 0;
}

}  // namespace

void AddRotor(CLI::App& app, Work& work) {
  auto options = std::make_shared<Convert>();
  CLI::App* rotor = app.add_subcommand(
      "rotor", "convert beam rotors between the file formats of ROSS and ambrig");
  rotor->require_subcommand(1);
  rotor->footer(
      "Examples:\n  ambrig rotor convert examples/tum_mbtr/rig.toml rotor.json\n"
      "  ambrig rotor convert rotor.json shaft.toml");
  CLI::App* convert =
      rotor->add_subcommand("convert", "a shaft from ROSS's rotor file to a [rotor], or back");
  convert
      ->add_option("IN", options->in,
                   "ROSS's file (.toml, .json), or a .toml with [rotor] kind = \"beam\"")
      ->required();
  convert->add_option("OUT", options->out, "the other kind")->required()->check(OutputFile());
  options->common.AddTo(*convert);
  convert->footer(
      "Examples:\n  ambrig rotor convert examples/tum_mbtr/rig.toml rotor.json\n"
      "  ambrig rotor convert rotor.json shaft.toml\n"
      "The first is for ross.Rotor.load; the second gives a shaft for a rig:\n"
      "[rotor] kind = \"beam\", file = \"shaft.toml\".");
  convert->callback([options, &work] { work = [options] { return Run(*options); }; });
}

}  // namespace ambrig
