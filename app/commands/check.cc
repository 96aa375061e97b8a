/// ambrig check: every scenario with [expect] under a path, in parallel; JUnit and exit code.
#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <mutex>
#include <pugixml.hpp>
#include <sstream>

#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/json/run_json.h"
#include "app/pages/html.h"
#include "core/base/atomic_file.h"
#include "core/base/counted.h"
#include "rig/rig_file.h"
#include "simulation/simulate.h"

namespace ambrig {

namespace {

struct CheckOptions {
  CommonOptions common;
  std::vector<std::string> paths;
  std::string junit;
  int jobs = 0;
};

struct CheckRow {
  std::string file, name, error;
  std::vector<ExpectResult> expect;
  nlohmann::ordered_json json;
  double seconds = 0;
  bool met() const { return error.empty() && AllMet(expect); }
};

CheckRow CheckOne(const std::string& file) {
  CheckRow row;
  row.file = file;
  const auto begin = std::chrono::steady_clock::now();
  try {
    const RigParameters rig = ReadRig(RigOfScenario(file));
    const Scenario scenario = ReadScenario(file, rig);
    row.name = scenario.name;
    if (!scenario.expect.any()) throw InputError(fmt::format("{}: has no [expect]", file));
    SimulateOptions options;
    options.stop = &interrupted;
    const RunResult result = Simulate(rig, scenario, options);
    row.expect = CheckExpectations(scenario, result);
    row.json = RunJson(scenario, result, row.expect);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& e) {
    row.error = e.what();
  }
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return row;
}

std::string Complaint(const CheckRow& row) {
  if (!row.error.empty()) return row.error;
  std::string text;
  for (const ExpectResult& e : row.expect)
    if (!e.met)
      text +=
          fmt::format("{}{}: wanted {}, got {}", text.empty() ? "" : "; ", e.key, e.wanted, e.got);
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
        Complaint(row).c_str();
  }
  std::ostringstream out;
  document.save(out, "  ");
  WriteFileAtomically(path, out.str());
}

void WriteReport(const std::string& path, const std::vector<CheckRow>& rows) {
  HtmlReport report("ambrig check", Counted(rows.size(), "scenario"));
  std::vector<std::vector<Cell>> cells;
  for (const CheckRow& r : rows)
    cells.push_back({Cell(r.name), Cell(r.file),
                     Cell(r.met() ? "met" : "not met", r.met() ? "ok" : "fail"), Cell(Complaint(r)),
                     Cell(fmt::format("{:.2f}", r.seconds))});
  report.Heading("Scenarios");
  report.Table({"scenario", "file", "verdict", "what is not met", "seconds"}, cells);
  report.Write(path);
}

int Check(const CheckOptions& options) {
  const std::vector<std::string> files = FindScenarios(options.paths);
  options.common.CheckOutputs(files, {options.junit});
  std::vector<CheckRow> rows(files.size());
  std::atomic<std::size_t> done{0};
  {
    Progress progress("check");
    const std::size_t jobs = options.jobs > 0 ? static_cast<std::size_t>(options.jobs)
                                              : std::thread::hardware_concurrency();
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, jobs);
    tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t k) {
      rows[k] = CheckOne(files[k]);
      progress.Update(static_cast<double>(++done) / static_cast<double>(files.size()), files[k]);
    });
  }
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  std::size_t failed = 0;
  for (const CheckRow& row : rows) {
    failed += row.met() ? 0 : 1;
    fmt::print("{}  {:<55} {:6.2f} s  {}\n",
               row.met() ? Coloured("met    ", "green") : Coloured("NOT MET", "red"),
               row.name.empty() ? row.file : row.name, row.seconds, Complaint(row));
    json.push_back(row.json.is_null()
                       ? nlohmann::ordered_json{{"file", row.file}, {"error", row.error}}
                       : row.json);
  }
  fmt::print("{}, {} met, {} not met\n", Counted(rows.size(), "scenario"), rows.size() - failed,
             failed);
  if (!options.junit.empty()) WriteJunit(options.junit, rows);
  if (!options.common.html.empty()) WriteReport(options.common.html, rows);
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
  command->add_option("--jobs", options->jobs, "scenarios at the same time (default: all cores)")
      ->check(CLI::Range(1, 1024));
  options->common.AddTo(*command);
  command->footer("Example:\n  ambrig check scenarios/library --jobs 2 --junit check.xml");
  command->callback([options, &work] { work = [options] { return Check(*options); }; });
}

}  // namespace ambrig
