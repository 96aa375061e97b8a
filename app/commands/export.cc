/// ambrig export: what a rig file describes, for other programs.
#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/commands/export_fmu.h"
#include "app/commands/outputs.h"
#include "control/external/host_image.h"
#include "control/position/c_code/c_code.h"
#include "core/base/atomic_file.h"
#include "rig/rig_file.h"
#include "simulation/sampled/controller_setup.h"

namespace ambrig {

namespace {

struct ExportOptions {
  CommonOptions common;
  std::string rig, controller_c, controller = "main";
  FmuExport fmu;
};

const ControllerParameters& ControllerNamed(const RigParameters& rig, const std::string& name) {
  if (name == "main") return rig.controller;
  std::string known = "main";
  for (const ControllerParameters& c : rig.other_controllers) {
    if (c.name == name) return c;
    known += ", " + c.name;
  }
  throw InputError(fmt::format("--controller = {}, allowed: {}", name, known));
}

std::string HeaderBeside(const std::string& controller) {
  return (std::filesystem::path(controller).parent_path() / "ambrig_controller.h").string();
}

nlohmann::ordered_json ExportController(const RigParameters& rig, const ExportOptions& o) {
  const std::filesystem::path file = o.controller_c;
  const std::string header = HeaderBeside(o.controller_c);
  RefuseOverwriting({file.string(), header}, o.common.force);
  RefuseInputAsOutput(file.string(), {o.rig, rig.file});
  const ControllerParameters& c = ControllerNamed(rig, o.controller);
  std::vector<std::string> axes;
  const auto controller = MakeCentralController(NominalRig(rig), c, &axes);
  if (axes.empty())
    throw InputError(
        fmt::format("{}: every bearing has a controller of its own, allowed: a rig with axes of "
                    "[controller]",
                    o.rig));
  const std::string text = ControllerInC(
      *controller, axes,
      fmt::format("made by ambrig export\nController \"{}\" (kind {}) of rig {}, for the axes "
                  "{},\nonce every {} s.\n\ncc -std=c99 -O2 -ffp-contract=off -shared -fPIC {} -o "
                  "controller.so -lm",
                  o.controller, c.kind, rig.name, fmt::join(axes, ", "), 1 / c.rate,
                  file.filename().string()));
  WriteFileAtomically(file.string(), text);
  WriteFileAtomically(header, "/* Copy made by ambrig export. */\n" + ControllerHeader());
  fmt::print("{}: controller {} ({}) as C99, {}\n{}\n", file.string(), o.controller, c.kind,
             axes.size() == 1 ? "1 axis" : fmt::format("{} axes", axes.size()), header);
  return {{"files", {file.string(), header}},
          {"controller", o.controller},
          {"kind", c.kind},
          {"axes", axes},
          {"period", 1 / c.rate}};
}

nlohmann::ordered_json ExportTheFmu(const ExportOptions& o) {
  RefuseOverwriting({o.fmu.file}, o.common.force);
  RefuseInputAsOutput(o.fmu.file, {o.rig, o.fmu.scenario});
  FmuExport wanted = o.fmu;
  wanted.rig = o.rig;
  const nlohmann::ordered_json made = ExportFmu(wanted);
  fmt::print("{}: FMI {} co-simulation, step {:.9g} s\n  {} parameters, {} inputs, {} outputs\n",
             o.fmu.file, o.fmu.fmi, made["step"].get<double>(), made["parameters"].get<int>(),
             made["inputs"].get<int>(), made["outputs"].get<int>());
  return made;
}

int Export(const ExportOptions& o) {
  const RigParameters rig = ReadRig(o.rig);
  o.common.CheckOutputs({o.rig, rig.file});
  const std::string header = o.controller_c.empty() ? "" : HeaderBeside(o.controller_c);
  RefuseOneFileTwice({o.controller_c, header, o.fmu.file, o.common.json, o.common.html});
  if (o.controller_c.empty() && o.fmu.file.empty())
    throw InputError("export: nothing to write, allowed: --fmu FILE or --controller-c FILE");
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  json["rig"] = o.rig;
  if (!o.controller_c.empty()) json["controller_c"] = ExportController(rig, o);
  if (!o.fmu.file.empty()) json["fmu"] = ExportTheFmu(o);
  o.common.WriteJson(json);
  return 0;
}

}  // namespace

void AddExport(CLI::App& app, Work& work) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* command = app.add_subcommand(
      "export", "write a rig as an FMU, or its controller as C99, for other programs");
  command->add_option("rig", options->rig, "rig file (TOML)")->required();
  command
      ->add_option("--controller-c", options->controller_c,
                   "write the controller as C99 to FILE, its header beside it")
      ->type_name("FILE")
      ->check(OutputFile());
  command
      ->add_option("--controller", options->controller,
                   "which: main, or a NAME of [controllers.NAME]")
      ->capture_default_str();
  CLI::Option* fmu = command
                         ->add_option("--fmu", options->fmu.file,
                                      "write the rig as a Functional Mock-up Unit (co-simulation)")
                         ->type_name("FILE")
                         ->check(OutputFile());
  command->add_option("--fmi", options->fmu.fmi, "version of the FMU: 2.0 | 3.0")
      ->capture_default_str()
      ->needs(fmu);
  command
      ->add_option("--scenario", options->fmu.scenario,
                   "scenario that the FMU starts from, below its inputs")
      ->type_name("FILE")
      ->needs(fmu);
  options->common.AddTo(*command);
  command->footer(
      "Examples:\n  ambrig export examples/reference/rig.toml --fmu rig.fmu\n"
      "  ambrig export examples/reference/rig.toml --fmu rig.fmu --fmi 3.0\n"
      "  ambrig export examples/reference/rig.toml --controller-c pid_rig.c\n"
      "  ambrig export examples/reference/rig.toml --controller-c pid.c --json pid.json");
  command->callback([options, &work] { work = [options] { return Export(*options); }; });
}

}  // namespace ambrig
