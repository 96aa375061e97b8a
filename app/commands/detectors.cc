/// ambrig detectors: detectors of coil faults on the same healthy and faulty runs.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>

#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/pages/detector_report.h"
#include "campaign/run_rows.h"
#include "core/base/atomic_file.h"
#include "core/base/counted.h"
#include "core/base/json_file.h"

namespace ambrig {

namespace {

struct DetectorsCommand {
  CommonOptions common;
  std::string file, out;
  int jobs = 0;
  bool no_report = false;
};

void WriteStudyTable(const DetectorStudyPlan& plan, const Rows& rows, const std::string& folder) {
  std::string text;
  for (const std::string& column : plan.Columns()) text += (text.empty() ? "" : ",") + column;
  text += '\n';
  for (const auto& [run, row] : rows) text += row.csv + '\n';
  WriteFileAtomically((std::filesystem::path(folder) / "table.csv").string(), text);
}

void RunAll(const DetectorStudyPlan& plan, int jobs, CampaignJournal& journal) {
  std::vector<std::size_t> pending;
  for (std::size_t run = 0; run < plan.study().runs(); ++run)
    if (!journal.rows().contains(run)) pending.push_back(run);
  if (pending.empty()) return;
  Progress progress("detectors");
  std::atomic<std::size_t> done{0};
  const auto begin = std::chrono::steady_clock::now();
  OnAllCores(pending, jobs, &interrupted, [&](std::size_t run) {
    journal.Append(plan.Simulate(run, &interrupted));
    const std::size_t n = ++done;
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    progress.Update(
        static_cast<double>(n) / static_cast<double>(pending.size()),
        fmt::format("{}/{} runs, {:.1f}/s", n, pending.size(), static_cast<double>(n) / seconds));
  });
}

int RunDetectors(DetectorsCommand o) {
  const DetectorStudyPlan plan(ReadDetectorStudy(o.file));
  if (o.out.empty())
    o.out = (std::filesystem::path("out") / std::filesystem::path(o.file).stem()).string();
  o.common.CheckOutputs({o.file});
  PrepareStudyFolder(o.out, {"table.csv", "curves.txt", "curves.json", "report.html"},
                     o.common.force);
  const auto check = [&](const Row& row, const std::string& where) {
    CheckDetectorStudyRow(row, plan.study().detectors.size(), where);
  };
  CampaignJournal journal(o.out, plan.Header(), check);
  if (!journal.rows().empty())
    fmt::print("{}: resumed, {} done before\n", o.out, Counted(journal.rows().size(), "run"));
  try {
    RunAll(plan, o.jobs, journal);
  } catch (const Interrupted&) {
    fmt::print(stderr, "ambrig: stopped; {} of {} kept in {}; re-run the command to resume\n",
               journal.rows().size(), Counted(plan.study().runs(), "run"), o.out);
    return 130;
  }
  const Rows& rows = journal.rows();
  WriteStudyTable(plan, rows, o.out);
  const auto curves = CurvesOf(plan.study(), rows);
  const std::string text = DetectorText(plan.study(), curves, rows);
  const auto json = DetectorJson(plan.study(), curves, rows);
  const auto in = [&](const char* name) { return (std::filesystem::path(o.out) / name).string(); };
  WriteFileAtomically(in("curves.txt"), text);
  WriteFileAtomically(in("curves.json"), JsonText(json, 1) + "\n");
  o.common.WriteJson(json);
  if (!o.no_report) WriteDetectorReport(plan.study(), curves, rows, in("report.html"));
  if (!o.common.html.empty()) WriteDetectorReport(plan.study(), curves, rows, o.common.html);
  fmt::print("{}", text);
  fmt::print("written: {}/table.csv, curves.txt, curves.json{}\n", o.out,
             o.no_report ? "" : ", report.html");
  return 0;
}

}  // namespace

void AddDetectors(CLI::App& app, Work& work) {
  auto options = std::make_shared<DetectorsCommand>();
  CLI::App* command = app.add_subcommand(
      "detectors",
      "compare detectors of coil faults: ROC curves, detection delay against false alarms");
  command->add_option("study", options->file, "study file (TOML)")->required();
  command->add_option(
      "-o,--out", options->out,
      "folder of journal.txt, table.csv, curves, report.html (default: out/NAME of the file)");
  command->add_option("-j,--jobs", options->jobs, "runs at the same time (default: all cores)")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--no-report", options->no_report, "no report.html");
  options->common.AddTo(*command);
  command->footer(
      "Examples:\n  ambrig detectors scenarios/studies/detectors_small.toml -o out/small\n"
      "  ambrig detectors scenarios/studies/detectors.toml -o out/detectors\nRe-run the "
      "command to resume an interrupted one.");
  command->callback([options, &work] { work = [options] { return RunDetectors(*options); }; });
}

}  // namespace ambrig
