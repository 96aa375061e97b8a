/// ambrig check: every scenario with [expect] under a path, in parallel; JUnit and exit code.
#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <optional>
#include <pugixml.hpp>
#include <sstream>

#include "app/commands/baseline.h"
#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/json/run_json.h"
#include "app/pages/difference_report.h"
#include "app/pages/html.h"
#include "app/text/screen.h"
#include "core/base/atomic_file.h"
#include "core/base/counted.h"
#include "core/base/read_file.h"
#include "core/base/version.h"
#include "core/record/hdf5.h"
#include "rig/rig_file.h"
#include "simulation/simulate.h"

namespace ambrig {

namespace {

struct CheckOptions {
  CommonOptions common;
  std::vector<std::string> paths;
  std::string junit;
  int jobs = 0;
  BaselineOptions baseline;
};

struct CheckRow {
  std::string file, name, error;
  std::vector<ExpectResult> expect;
  nlohmann::ordered_json json;
  double seconds = 0;
  std::optional<RunDifference> difference;  // from the baseline
  RunFiles before, now;                     // for the page: kept where they differ
  bool met() const {
    return error.empty() && AllMet(expect) && (!difference || difference->agrees());
  }
};

/// The run beside its baseline; with --accept it becomes the baseline.
void CheckBaseline(const BaselineOptions& o, const RigParameters& rig, RunResult& result,
                   CheckRow& row) {
  RunFiles now{row.file, std::move(result.record), nlohmann::json(row.json.at("events"))};
  const std::string file = BaselineFile(o, row.file);
  if (o.accept) {
    WriteHdf5(BaselineRecord(o, now,
                             {{"scenario", ReadFile(row.file)},
                              {"rig", ReadFile(rig.file)},
                              {"program", std::string(ProgramVersion())}}),
              file);
    return;
  }
  RunFiles before = ReadBaseline(file);
  row.difference = CompareToBaseline(before, now, BaselineTolerances(o));
  row.json["baseline"] = DifferenceJson(*row.difference);
  if (row.difference->agrees()) return;
  row.before = std::move(before);
  row.now = std::move(now);
}

CheckRow CheckOne(const std::string& file, const BaselineOptions& baseline) {
  CheckRow row;
  row.file = file;
  const auto begin = std::chrono::steady_clock::now();
  try {
    const RigParameters rig = ReadRig(RigOfScenario(file));
    const Scenario scenario = ReadScenario(file, rig);
    row.name = scenario.name;
    if (!scenario.expect.any() && baseline.folder.empty())
      throw InputError(fmt::format(
          "{}: {}, allowed: an expectation there, or --baseline DIR", file,
          HasExpectations(file) ? "nothing stands in its [expect]" : "has no [expect]"));
    SimulateOptions options;
    options.stop = &interrupted;
    RunResult result = Simulate(rig, scenario, options);
    row.expect = CheckExpectations(scenario, result);
    row.json = RunJson(scenario, result, row.expect);
    if (!baseline.folder.empty()) CheckBaseline(baseline, rig, result, row);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& e) {
    row.error = e.what();
  }
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return row;
}

std::string RowComplaint(const CheckRow& row) {
  if (!row.error.empty()) return row.error;
  std::string text;
  for (const ExpectResult& e : row.expect)
    if (!e.met)
      text +=
          fmt::format("{}{}: wanted {}, got {}", text.empty() ? "" : "; ", e.key, e.wanted, e.got);
  if (row.difference && !row.difference->agrees())
    for (const std::string& line : DifferenceLines(*row.difference, 3))
      text += (text.empty() ? "" : "; ") + line;
  return text;
}

void WriteJunit(const std::string& path, const std::vector<CheckRow>& rows) {
  pugi::xml_document document;
  pugi::xml_node suite = document.append_child("testsuite");
  suite.append_attribute("name") = "ambrig check";
  suite.append_attribute("tests") = rows.size();
  suite.append_attribute("failures") = std::count_if(
      rows.begin(), rows.end(), [](const CheckRow& r) { return !r.met() && r.error.empty(); });
  suite.append_attribute("errors") =
      std::count_if(rows.begin(), rows.end(), [](const CheckRow& r) { return !r.error.empty(); });
  for (const CheckRow& row : rows) {
    pugi::xml_node test = suite.append_child("testcase");
    test.append_attribute("name") = row.name.empty() ? row.file.c_str() : row.name.c_str();
    test.append_attribute("classname") = row.file.c_str();
    test.append_attribute("time") = row.seconds;
    if (row.met()) continue;
    test.append_child(row.error.empty() ? "failure" : "error").append_attribute("message") =
        RowComplaint(row).c_str();
  }
  std::ostringstream out;
  document.save(out, "  ");
  WriteFileAtomically(path, out.str());
}

void WriteCheckReport(const std::string& path, const std::vector<CheckRow>& rows) {
  HtmlReport report("ambrig check", Counted(rows.size(), "scenario"));
  std::vector<std::vector<Cell>> cells;
  for (const CheckRow& r : rows)
    cells.push_back({Cell(r.name), Cell(r.file),
                     Cell(r.met() ? "met" : "not met", r.met() ? "ok" : "fail"),
                     Cell(RowComplaint(r)), Cell(fmt::format("{:.2f}", r.seconds))});
  report.Heading("Scenarios");
  const auto met = std::ranges::count_if(rows, &CheckRow::met);
  const auto failed = static_cast<std::ptrdiff_t>(rows.size()) - met;
  report.Verdict(failed > 0 ? Verdict::kFail : Verdict::kOk,
                 fmt::format("{} met, {} not met.", met, failed));
  report.Table({"scenario", "file", "verdict", "what is not met", "time [s]"}, cells);
  report.Write(path);
}

/// What differs from the baselines, with both curves; false when nothing does.
bool WriteBaselineReport(const std::string& path, const std::vector<CheckRow>& rows) {
  std::vector<DifferencePage> pages;
  for (const CheckRow& r : rows)
    if (r.difference && !r.difference->agrees())
      pages.push_back({r.name, &r.before, &r.now, &*r.difference});
  if (!pages.empty()) WriteDifferenceReport(pages, path);
  return !pages.empty();
}

/// One scenario on the screen: what is not met stands below it, so that a line fits 80 columns.
void PrintCheckRow(const CheckRow& row) {
  const std::string name = row.name.empty() ? row.file : row.name;
  fmt::print("{}  {:<58} {:7.2f} s\n",
             row.met() ? Coloured("met    ", "green") : Coloured("NOT MET", "red"),
             Shortened(name, 58), row.seconds);
  if (!row.met()) fmt::print("{}\n", Wrapped("    " + RowComplaint(row), 4));
}

std::string DifferencePageOf(const BaselineOptions& o) {
  return (std::filesystem::path(o.folder) / "difference.html").string();
}

/// What is written beside the baselines, and with --accept they themselves.
void CheckBaselineOutputs(const CheckOptions& options, const std::vector<std::string>& files) {
  const BaselineOptions& o = options.baseline;
  if (o.accept && o.folder.empty())
    throw InputError("--accept: allowed together with --baseline DIR");
  if (o.folder.empty()) return;
  if (o.accept) PrepareFolder(o.folder);
  if (!o.accept) RequireTolerancesFit(o);
  std::vector<std::string> outputs{DifferencePageOf(o)};
  if (o.accept)
    for (const std::string& file : files) outputs.push_back(BaselineFile(o, file));
  RefuseOverwriting(outputs, options.common.force);
}

int Check(const CheckOptions& options) {
  const std::vector<std::string> files = FindScenarios(options.paths);
  options.common.CheckOutputs(files, {options.junit});
  CheckBaselineOutputs(options, files);
  std::vector<CheckRow> rows(files.size());
  std::atomic<std::size_t> done{0};
  {
    Progress progress("check");
    const std::size_t jobs = options.jobs > 0 ? static_cast<std::size_t>(options.jobs)
                                              : std::thread::hardware_concurrency();
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, jobs);
    tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t k) {
      rows[k] = CheckOne(files[k], options.baseline);
      progress.Update(static_cast<double>(++done) / static_cast<double>(files.size()),
                      std::filesystem::path(files[k]).filename().string());
    });
  }
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  std::size_t failed = 0;
  for (const CheckRow& row : rows) {
    failed += row.met() ? 0 : 1;
    PrintCheckRow(row);
    json.push_back(row.json.is_null()
                       ? nlohmann::ordered_json{{"file", row.file}, {"error", row.error}}
                       : row.json);
  }
  fmt::print("{}, {} met, {} not met\n", Counted(rows.size(), "scenario"), rows.size() - failed,
             failed);
  if (!options.junit.empty()) WriteJunit(options.junit, rows);
  if (!options.common.html.empty()) WriteCheckReport(options.common.html, rows);
  if (!options.baseline.folder.empty()) {
    const std::string page = DifferencePageOf(options.baseline);
    const bool curves = WriteBaselineReport(page, rows);
    std::error_code error;
    if (!curves && !options.baseline.accept)
      std::filesystem::remove(page, error);  // of an earlier check
    if (options.baseline.accept)
      fmt::print("baselines stored in {}\n", options.baseline.folder);
    else if (curves)
      fmt::print("curves of what differs: {}\n", page);
  }
  options.common.WriteJson(json);
  return failed > 0 ? 1 : 0;
}

}  // namespace

void AddCheck(CLI::App& app, Work& work) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command =
      app.add_subcommand("check", "run all scenarios with [expect] under PATH as regression tests");
  command->add_option("path", options->paths, "scenario files or folders")->required();
  command->add_option("--junit", options->junit, "write a JUnit XML file")
      ->type_name("FILE")
      ->check(OutputFile());
  command
      ->add_option("--baseline", options->baseline.folder,
                   "compare each run with the record stored here (NAME.baseline.h5)")
      ->type_name("DIR");
  command->add_flag("--accept", options->baseline.accept, "store these runs as the baselines");
  command->add_option("--channels", options->baseline.channels,
                      "channels that --accept stores, e.g. A.x 'A.i*' (default: readings, "
                      "currents, speed, bus)");
  command->add_option("--rows", options->baseline.rows, "rows that --accept stores at most")
      ->check(CLI::Range(2, 1000000))
      ->capture_default_str();
  command->add_option("-j,--jobs", options->jobs, "scenarios at the same time (default: all cores)")
      ->check(CLI::Range(1, 1024));
  options->common.AddTo(*command);
  command->footer(
      "Examples:\n"
      "  ambrig check scenarios/library/lift_off.toml --junit check.xml\n"
      "  ambrig check examples/reference --baseline stored --accept\n"
      "  ambrig check examples/reference --baseline stored\n"
      "The second stores what is right today, the third finds what has changed.\n"
      "Tolerances: DIR/tolerances.toml (ambrig diff --help). Exit code 1 when\n"
      "something is not met. Of a folder the scenarios with a table [expect] are run.");
  command->callback([options, &work] { work = [options] { return Check(*options); }; });
}

}  // namespace ambrig
