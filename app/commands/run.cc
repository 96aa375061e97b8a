/// ambrig run: simulate scenarios; timeline, record, JSON, report.
#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "analysis/dropped_modes.h"
#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/commands/run_size.h"
#include "app/json/provenance.h"
#include "app/json/run_json.h"
#include "app/pages/run_report_data.h"
#include "app/text/format.h"
#include "app/text/screen.h"
#include "campaign/run_plan.h"
#include "core/base/atomic_file.h"
#include "core/base/inputs_read.h"
#include "core/base/read_file.h"
#include "core/math/no_solution.h"
#include "core/record/csv.h"
#include "core/record/hdf5.h"
#include "rig/rig_file.h"
#include "simulation/simulate.h"

namespace ambrig {

namespace {

struct RunOptions {
  CommonOptions common;
  std::vector<std::string> scenarios;
  std::string out = "out", fidelity = "switching";
  std::string campaign;
  long long row = -1;
  double rate = 0;
  bool no_traces = false;
  bool csv = false, quiet = false, no_html = false, long_runs = false, keep_going = false;

  bool WritesReport() const { return !no_html || !common.html.empty(); }
};

void PrintTimeline(const Scenario& scenario, const RunResult& result,
                   const std::map<std::string, double>& stations, bool contacts_possible,
                   const std::vector<ExpectResult>& expect) {
  fmt::print("{}\n", Coloured(scenario.name, "bold"));
  std::size_t shown = 0, contacts = 0;
  for (const RunEvent& e : result.events) {
    const bool contact = e.kind == "touchdown" || e.kind == "lift_off";
    if (contact && ++contacts > 12) continue;  // a bouncing rotor would fill the screen
    fmt::print("  {:>11.4f} ms  {:<14} {:<10} {}\n", e.t * 1e3, e.kind, e.target, EventText(e));
    ++shown;
  }
  if (contacts > 12) fmt::print("  ... and {} more contacts\n", contacts - 12);
  if (shown == 0) fmt::print("  no events\n");
  const RunMetrics& m = result.metrics;
  const auto orbits = [](const std::map<std::string, double>& peaks) {
    for (const auto& [name, orbit] : peaks)
      fmt::print("  {:<22} {:8.2f} um\n", "peak orbit " + name, orbit * 1e6);
  };
  orbits(m.max_orbit);
  orbits(stations);
  if (!m.max_orbit.empty())
    fmt::print("  {:<22} {:>8} um\n", "clearance left",
               contacts_possible ? fmt::format("{:.2f}", m.min_clearance_left * 1e6) : "-");
  fmt::print("  {:<22} {:8.3f} A\n  {:<22} {:8.2f} W\n", "peak coil current", m.peak_current,
             "copper loss, mean", m.copper_loss);
  fmt::print("  {:<22} {}\n", "false alarms", FalseAlarmText(m.false_alarms, m.coil_periods));
  fmt::print("  {:<22} {:8.1f} x real time\n", "computed at", m.real_time_factor);
  for (const std::string& note : result.notes) fmt::print("{}\n", Wrapped("  note: " + note, 8));
  for (const ExpectResult& e : expect)
    fmt::print("  expect {:<18} wanted {:<14} got {:<14} {}\n", e.key, e.wanted, e.got,
               e.met ? Coloured("met", "green") : Coloured("NOT MET", "red"));
  fmt::print("  {:<22} {}\n", "verdict",
             result.drop        ? Coloured("rotor dropped", "red")
             : result.touchdown ? Coloured("touched down, did not drop", "yellow")
                                : Coloured("rotor stayed up", "green"));
}

/// What is simulated and where it came from.
struct RunInput {
  RigParameters rig;
  Scenario scenario;
  std::string stem, text;           // name of the output files; the input as a person wrote it
  std::vector<std::string> inputs;  // files that were read
  std::shared_ptr<RunPlan> plan;    // of a campaign: holds the files that `rig` names
};

RunInput FromScenario(const std::string& file) {
  if (std::filesystem::is_directory(file))
    throw InputError(
        fmt::format("{}: a folder, allowed: scenario files (ambrig check {} runs those of a folder "
                    "that have [expect]; the folder of the seed paper: ambrig paper {})",
                    file, file, file));
  ForgetInputs();
  RunInput in;
  in.rig = ReadRig(RigOfScenario(file));
  in.scenario = ReadScenario(file, in.rig);
  in.stem = std::filesystem::path(file).stem().string();
  in.text = ReadFile(file);
  in.inputs = InputsRead();
  return in;
}

RunInput FromCampaign(const std::string& file, long long row) {
  ForgetInputs();
  const auto plan = std::make_shared<RunPlan>(ReadCampaign(file));
  const std::size_t runs = plan->campaign().runs();
  if (row < 0 || static_cast<std::size_t>(row) >= runs)
    throw InputError(fmt::format("--row = {}, allowed: 0 to {}", row, runs - 1));
  PlannedRun p = plan->Make(static_cast<std::size_t>(row));
  RunInput in;
  in.plan = plan;
  in.rig = std::move(p.rig);
  in.scenario = std::move(p.scenario);
  in.scenario.name = fmt::format("{}, row {}", plan->campaign().name, row);
  in.scenario.file = file;
  in.stem = fmt::format("{}_row_{}", std::filesystem::path(file).stem().string(), row);
  in.text = fmt::format("# row {} of\n{}", row, ReadFile(file));
  in.inputs = InputsRead();
  return in;
}

/// Memory, rate and output files, before any work.
void CheckBefore(const RunInput& in, const RunOptions& options) {
  if (options.rate > 0) CheckRecordRate(in.rig, options.rate, "--rate");
  if (options.rate > 0 && options.rate * in.scenario.duration < 1)
    throw InputError(
        fmt::format("--rate = {} Hz, allowed: at least {:g} Hz, one row in the "
                    "duration of {} s",
                    options.rate, 1 / in.scenario.duration, in.scenario.duration));
  CheckRunSize(in.rig, in.scenario, options.rate, options.long_runs,
               FidelityByName(options.fidelity));
  const std::string stem = (std::filesystem::path(options.out) / in.stem).string();
  std::vector<std::string> files{stem + ".h5", stem + ".json"};
  if (!options.no_html) files.push_back(stem + ".html");
  if (options.csv) files.push_back(stem + ".csv");
  options.common.CheckOutputs({in.scenario.file, in.rig.file}, files);
}

int RunOne(const RunInput& in, const RunOptions& options, nlohmann::ordered_json& all) {
  const RigParameters& rig = in.rig;
  const Scenario& scenario = in.scenario;
  Progress progress(scenario.name);
  SimulateOptions simulate;
  simulate.fidelity = FidelityByName(options.fidelity);
  simulate.record_rate = options.rate;
  simulate.for_report = options.WritesReport();
  simulate.stop = &interrupted;
  simulate.progress = [&](double f) { progress.Update(f); };
  RunResult result = Simulate(rig, scenario, simulate);
  progress.Clear();
  const auto expect = CheckExpectations(scenario, result);
  const std::filesystem::path stem = std::filesystem::path(options.out) / in.stem;
  result.record.attributes["made_by"] = "ambrig run";
  result.record.attributes["scenario"] = in.text;
  result.record.attributes["rig"] = ReadFile(rig.file);
  result.record.attributes["fidelity"] = options.fidelity;
  WriteHdf5(result.record, stem.string() + ".h5");
  if (options.csv) WriteCsv(result.record, stem.string() + ".csv");
  auto json = RunJson(scenario, result, expect);
  const std::string doubtful = DoubtfulModelNote(rig, result);
  if (!doubtful.empty()) json["notes"].push_back(doubtful);
  const auto dropped = FindDroppedModes(rig);
  if (dropped) json["bending_modes"] = DroppedModesJson(*dropped);
  json["provenance"] = Provenance(in.inputs);
  WriteFileAtomically(stem.string() + ".json", MarkedJson(json));
  if (options.WritesReport()) {
    const RunReportData data = MakeRunReportData(rig, scenario, result, expect, options.fidelity);
    if (!options.no_html) WriteRunReport(data, stem.string() + ".html");
    if (!options.common.html.empty()) WriteRunReport(data, options.common.html);
  }
  if (!options.quiet) {
    PrintTimeline(scenario, result, StationOrbits(rig, result), HasAuxiliary(rig), expect);
    if (!doubtful.empty()) fmt::print("{}\n", Wrapped("  note: " + doubtful, 8));
    if (dropped)
      fmt::print("{}\n", Wrapped("  bending modes          " + DroppedModesText(*dropped), 25));
    fmt::print("  {:<22} {}.h5 .json{}{}\n", "written", stem.string(), options.csv ? " .csv" : "",
               options.no_html ? "" : " .html (report)");
  }
  all.push_back(json);
  return AllMet(expect) ? 0 : 1;
}

/// --keep-going: a scenario that is refused or cannot be solved is told and left out.
int RunEach(const RunOptions& options, nlohmann::ordered_json& all) {
  int code = 0;
  const auto leave_out = [&](const std::string& file, const std::exception& e) {
    const std::string what = e.what();
    const std::string line = what.starts_with(file) ? what : file + ": " + what;
    fmt::print(stderr, "ambrig: {}\n", PrintableLine(line));
    std::fflush(stderr);
    all.push_back({{"scenario", file}, {"error", what}});
    code = 2;
  };
  for (const std::string& file : options.scenarios) {
    try {
      const RunInput in = FromScenario(file);
      CheckBefore(in, options);
      code = std::max(code, RunOne(in, options, all));
    } catch (const InputError& e) {
      leave_out(file, e);
    } catch (const NoSolution& e) {
      leave_out(file, e);
    }
  }
  return code;
}

/// Each scenario writes files of its own name. @throws InputError
void RefuseEqualNames(const std::vector<std::string>& scenarios) {
  std::set<std::string> stems;
  for (const std::string& file : scenarios)
    if (!stems.insert(std::filesystem::path(file).stem().string()).second)
      throw InputError(
          fmt::format("{}: another scenario of that file name would be overwritten", file));
}

int RunScenarios(RunOptions options) {
  if (options.no_traces && !options.common.html.empty())
    throw InputError("--html: the report shows the traces, allowed: without --no-traces");
  options.no_html = options.no_html || options.no_traces;
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  if (options.campaign.empty() == options.scenarios.empty())
    throw InputError("run: allowed: scenario files, or --from-campaign FILE --row K");
  RefuseEqualNames(options.scenarios);
  if (options.scenarios.size() > 1 && !options.common.html.empty())
    throw InputError(
        "--html: one report for several scenarios, allowed: one scenario (the folder "
        "--out holds a report of each)");
  if (!options.campaign.empty() && options.row < 0)
    throw InputError("--row is missing or negative, allowed with --from-campaign: a run, from 0");
  int code = 0;
  if (options.keep_going) {
    PrepareFolder(options.out);
    code = RunEach(options, all);
  } else {
    std::vector<RunInput> inputs;
    if (!options.campaign.empty()) inputs.push_back(FromCampaign(options.campaign, options.row));
    for (const std::string& file : options.scenarios) inputs.push_back(FromScenario(file));
    for (const RunInput& in : inputs) CheckBefore(in, options);
    PrepareFolder(options.out);
    for (const RunInput& in : inputs) code = std::max(code, RunOne(in, options, all));
  }
  options.common.WriteJson(all.size() == 1 && !options.keep_going ? all[0] : all);
  return code;
}

}  // namespace

void AddRun(CLI::App& app, Work& work) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command =
      app.add_subcommand("run", "simulate scenarios; write record, figures and report");
  command->add_option("scenario", options->scenarios, "scenario files (TOML)");
  CLI::Option* campaign = command
                              ->add_option("--from-campaign", options->campaign,
                                           "campaign file of which one row is repeated")
                              ->type_name("FILE");
  command->add_option("--row", options->row, "run of that campaign, from 0")->needs(campaign);
  command->add_option("-o,--out", options->out, "folder of NAME.h5, NAME.json, NAME.html")
      ->capture_default_str();
  command
      ->add_option("--rate", options->rate,
                   "rows of the record per second [Hz] (default: the scenario's)")
      ->check(NumberIn(1e-3, 1e9, "Hz"));
  command->add_flag("--long", options->long_runs, "start also when the estimate exceeds an hour");
  command->add_option("--fidelity", options->fidelity, "switching | reference | averaged")
      ->capture_default_str();
  command
      ->add_flag("--keep-going", options->keep_going,
                 "report a scenario that is refused and run the others")
      ->excludes(campaign);
  command->add_flag("--csv", options->csv, "also write the record as NAME.csv");
  command->add_flag("--no-report", options->no_html, "no NAME.html");
  command->add_flag("--no-traces", options->no_traces,
                    "record no traces of fluxes and slopes either, which only the report shows");
  command->add_flag("--quiet", options->quiet, "print nothing");
  options->common.AddTo(*command);
  command->footer(
      "Examples:\n  ambrig run scenarios/library/coil_a3_opens_1500rpm.toml --out out --csv\n"
      "  ambrig run scenarios/library/load_step.toml --rate 25000 --no-report\n"
      "Exit code 1 when an [expect] of a scenario is not met, 2 when one was refused.");
  command->callback([options, &work] { work = [options] { return RunScenarios(*options); }; });
}

}  // namespace ambrig
