/// ambrig analyze: rotor dynamics and control margins of a rig.
#include <fmt/format.h>

#include <filesystem>

#include "app/commands/analyze_shaft.h"
#include "app/commands/analyze_text.h"
#include "app/commands/commands.h"
#include "app/commands/leave_when_stopped.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/json/analysis_json.h"
#include "app/pages/analysis_report.h"
#include "core/base/atomic_file.h"
#include "core/math/constants.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

struct AnalyzeCommand {
  CommonOptions common;
  ShaftCommand shaft;
  std::string rig, speed = "6000", out;
  std::vector<std::string> responses;
  double fastest = 0, sine = 0;  // [rpm], [N]
  int measured = 0;
};

double RpmOption(const std::string& option, const std::string& given) {
  const std::string text = SpeedIn(given, "rpm");
  std::size_t used = 0;
  double value = -1;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = std::string::npos;
  }
  if (used != text.size() || !(value >= 0 && value <= 1e7))
    throw InputError(
        fmt::format("--{} = {}, allowed: rpm from 0 to 1e7, e.g. 6000 or 3000:9000", option, text));
  return value;
}

AnalysisOptions OptionsOf(const AnalyzeCommand& c) {
  AnalysisOptions o;
  const std::size_t colon = c.speed.find(':');
  o.lowest = RpmOption("speed", c.speed.substr(0, colon)) * kRpm;
  o.highest =
      colon == std::string::npos ? o.lowest : RpmOption("speed", c.speed.substr(colon + 1)) * kRpm;
  if (o.highest < o.lowest)
    throw InputError(fmt::format("--speed = {}, allowed: the lower speed first", c.speed));
  o.fastest = c.fastest > 0 ? c.fastest * kRpm : o.highest > 0 ? 1.5 * o.highest : 9000 * kRpm;
  if (o.fastest < o.highest)
    throw InputError(
        fmt::format("--max-speed = {}, allowed: at least the highest operating speed, {:g} rpm",
                    c.fastest, o.highest / kRpm));
  for (const std::string& pair : c.responses) {
    const std::size_t comma = pair.find(':');
    if (comma == std::string::npos)
      throw InputError(
          fmt::format("--response = {}, allowed: INPUT:OUTPUT, e.g. A.x.force:B.x", pair));
    o.responses.emplace_back(pair.substr(0, comma), pair.substr(comma + 1));
  }
  o.measured = c.measured;
  o.sine = c.sine;
  o.stop = &interrupted;
  return o;
}

/// Most rigs are called rig.toml: their folder tells them apart.
std::string OutputBase(const AnalyzeCommand& c) {
  const std::filesystem::path rig = std::filesystem::absolute(c.rig).lexically_normal();
  std::string name = rig.stem().string();
  if (name == "rig") name = rig.parent_path().filename().string() + ".rig";
  return (std::filesystem::path(c.out) / (name + ".analysis")).string();
}

int RunShaft(const AnalyzeCommand& c, const AnalysisOptions& o) {
  if (!c.responses.empty() || c.measured > 0 || c.sine > 0)
    throw InputError(fmt::format("--{}: {} is a shaft without magnetic bearings, allowed: a rig",
                                 !c.responses.empty() ? "response"
                                 : c.measured > 0     ? "measure"
                                                      : "sine",
                                 c.rig));
  return AnalyseShaftFile({c.rig, c.out, o.lowest, o.highest, o.fastest}, c.shaft, c.common);
}

int RunAnalyze(const AnalyzeCommand& c) {
  AnalysisOptions options = OptionsOf(c);
  if (IsShaftFile(c.rig)) return RunShaft(c, options);
  if (const std::string given = c.shaft.Given(); !given.empty())
    throw InputError(
        fmt::format("--{}: {} is a rig, allowed: a shaft without magnetic bearings", given, c.rig));
  const RigParameters rig = ReadRig(c.rig);
  const std::string base = OutputBase(c);
  std::vector<std::string> files;
  if (!c.out.empty()) files = {base + ".json", base + ".html"};
  c.common.CheckOutputs({c.rig}, files);
  if (!c.out.empty()) PrepareFolder(c.out);
  RigAnalysis analysis;
  {
    const LeaveWhenStopped leave;
    Progress progress("analyze");
    options.progress = [&](double f, const std::string& text) { progress.Update(f, text); };
    analysis = Analyse(rig, options);
  }
  analysis.options.progress = nullptr;
  PrintAnalysis(analysis);
  const nlohmann::ordered_json json = AnalysisJson(analysis);
  c.common.WriteJson(json);
  if (!c.common.html.empty()) WriteAnalysisReport(analysis, c.rig, c.common.html);
  if (c.out.empty()) return analysis.stable() ? 0 : 1;
  WriteFileAtomically(base + ".json", MarkedJson(json));
  WriteAnalysisReport(analysis, c.rig, base + ".html");
  fmt::print("written: {0}.json, {0}.html\n", base);
  return analysis.stable() ? 0 : 1;
}

}  // namespace

void AddAnalyze(CLI::App& app, Work& work) {
  auto c = std::make_shared<AnalyzeCommand>();
  CLI::App* command = app.add_subcommand(
      "analyze", "rotor dynamics and control margins: modes, Campbell, sensitivity, unbalance");
  command->add_option("rig", c->rig, "rig file, or a shaft on supports: [rotor] or ROSS's file")
      ->required();
  command
      ->add_option("--speed", c->speed,
                   "operating speed, or lowest:highest [rpm], or with a unit: 50Hz, 314rad/s")
      ->capture_default_str();
  command
      ->add_option("--max-speed", c->fastest,
                   "end of the Campbell diagram [rpm] (default: 1.5 operating speeds)")
      ->check(NumberIn(1, 1e7, "rpm"));
  command->add_option("--response", c->responses,
                      "frequency response INPUT:OUTPUT, e.g. A.x.force:B.x; may be repeated");
  command
      ->add_option("--measure", c->measured,
                   "inject sines of this many frequencies per axis into the switching rig")
      ->check(CLI::Range(1, 200));
  command
      ->add_option("--sine", c->sine,
                   "amplitude of those sines [N] (default: a hundredth of the capacity)")
      ->check(NumberIn(1e-9, 1e6, "N"));
  c->shaft.AddTo(*command);
  command->add_option(
      "-o,--out", c->out,
      "folder for NAME.analysis.json and .html (NAME: the rig file's; FOLDER.rig for a file called "
      "rig.toml)");
  c->common.AddTo(*command);
  command->footer(
      "Examples:\n"
      "  ambrig analyze examples/reference/rig.toml --speed 3000:9000 -o out\n"
      "  ambrig analyze examples/reference/rig.toml --measure 3 --html rig.html\n"
      "  ambrig analyze examples/reference/rig.toml --response A.x.load:A.x\n"
      "  ambrig analyze examples/shaft/shaft.toml --speed 4000 --unbalance disk2:50@90\n"
      "Inputs: AXIS.force, .reference, .sensor, .load; outputs: AXIS, AXIS.command,\n"
      ".shaft, .magnet, or a coil A.i1; of a named plane of a beam rotor: disk.x.load,\n"
      "disk.x.\n"
      "Exit code 1 when the closed loop, or the shaft, is unstable.");
  command->callback([c, &work] { work = [c] { return RunAnalyze(*c); }; });
}

}  // namespace ambrig
