/// ambrig design: controllers compared, their numbers swept or optimised; the Pareto front, any
/// point of it again.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/json/run_json.h"
#include "app/pages/design_report.h"
#include "app/pages/run_report_data.h"
#include "app/text/screen.h"
#include "core/base/atomic_file.h"
#include "core/base/counted.h"
#include "core/base/json_file.h"
#include "core/base/read_file.h"
#include "core/base/toml_edit.h"
#include "core/record/hdf5.h"
#include "design/responses.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

struct DesignOptions {
  CommonOptions common;
  std::string file, out;
  int jobs = 0;
  long long point = -1;
  bool no_report = false;
};

nlohmann::ordered_json NumberJson(double v) {
  return std::isfinite(v) ? nlohmann::ordered_json(v) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json PointJson(const Study& study, const StudyResult& result, std::size_t k) {
  const StudyPoint& p = result.points[k];
  const DesignCandidate& c = study.candidates[p.candidate];
  nlohmann::ordered_json variables = nlohmann::ordered_json::object(),
                         figures = nlohmann::ordered_json::object();
  for (std::size_t j = 0; j < p.values.size(); ++j)
    for (const std::string& path : c.variables[j].paths) variables[path] = p.values[j];
  for (std::size_t j = 0; j < study.figures.size(); ++j)
    figures[study.figures[j].name] = NumberJson(p.result.figures[j]);
  nlohmann::ordered_json out{
      {"point", k},         {"candidate", c.name},        {"variables", variables},
      {"figures", figures}, {"meets_limits", p.feasible}, {"front", p.front}};
  if (!p.result.note.empty()) out["note"] = p.result.note;
  return out;
}

nlohmann::ordered_json StudyJson(const Study& study, const StudyResult& result,
                                 const std::vector<std::size_t>& shown) {
  nlohmann::ordered_json points = nlohmann::ordered_json::array(),
                         front = nlohmann::ordered_json::array(),
                         chosen = nlohmann::ordered_json::object();
  for (std::size_t k = 0; k < result.points.size(); ++k) {
    points.push_back(PointJson(study, result, k));
    if (result.points[k].front) front.push_back(k);
  }
  for (std::size_t c = 0; c < shown.size(); ++c) chosen[study.candidates[c].name] = shown[c];
  return {{"name", study.name},
          {"fingerprint", study.fingerprint},
          {"front", front},
          {"shown", chosen},
          {"points", points}};
}

void WriteTable(const Study& study, const StudyResult& result, const std::string& path) {
  std::string text = "point,candidate,variables";
  for (const FigureSpec& f : study.figures) text += fmt::format(",{} [{}]", f.name, f.info->unit);
  text += ",meets_limits,front,note\n";
  const auto cell = [](std::string s) {
    std::replace(s.begin(), s.end(), ',', ';');
    return s;
  };
  for (std::size_t k = 0; k < result.points.size(); ++k) {
    const StudyPoint& p = result.points[k];
    const DesignCandidate& c = study.candidates[p.candidate];
    std::string variables;
    for (std::size_t j = 0; j < p.values.size(); ++j)
      variables += fmt::format("{}{}={}", j == 0 ? "" : " ", c.variables[j].paths.front(),
                               NumberText(p.values[j]));
    text += fmt::format("{},{},{}", k, cell(c.name), variables);
    for (const double v : p.result.figures)
      text += "," + (std::isfinite(v) ? NumberText(v) : std::string());
    text += fmt::format(",{},{},{}\n", p.feasible ? 1 : 0, p.front ? 1 : 0, cell(p.result.note));
  }
  WriteFileAtomically(path, text);
}

void PrintStudy(const Study& study, const StudyResult& result,
                const std::vector<std::size_t>& shown) {
  std::size_t front = 0, feasible = 0;
  for (const StudyPoint& p : result.points) {
    front += p.front ? 1 : 0;
    feasible += p.feasible ? 1 : 0;
  }
  fmt::print("{}\n  points             {}, {} feasible, {} Pareto-optimal\n",
             Coloured(study.name, "bold"), result.points.size(), feasible, front);
  for (std::size_t c = 0; c < shown.size(); ++c) {
    const StudyPoint& p = result.points[shown[c]];
    fmt::print("  {:<18} point {:<5} {}\n", study.candidates[c].name, shown[c],
               p.front      ? Coloured("on the front", "green")
               : p.feasible ? "keeps all limits"
                            : Coloured("breaks a limit", "red"));
    if (!p.result.note.empty()) fmt::print("{}\n", Wrapped("    " + p.result.note, 4));
    for (std::size_t j = 0; j < study.figures.size(); ++j)
      fmt::print("    {:<36} {:>12}\n", study.figures[j].name,
                 ScreenSi(p.result.figures[j], study.figures[j].info->unit));
  }
}

/// Writes the point's rig and scenarios, runs them, and compares with what the study found. 0 when
/// it is the same.
int Repeat(const Study& study, const StudyResult& result, const DesignOptions& o) {
  if (o.point >= static_cast<long long>(result.points.size()))
    throw InputError(
        fmt::format("--point = {}, allowed: 0 to {}", o.point, result.points.size() - 1));
  const auto k = static_cast<std::size_t>(o.point);
  const StudyPoint& p = result.points[k];
  const DesignCandidate& c = study.candidates[p.candidate];
  const std::filesystem::path folder = std::filesystem::path(o.out) / fmt::format("point_{}", k);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw InputError(fmt::format("cannot write {}: {}", folder.string(), error.message()));
  const std::string rig_file = (folder / "rig.toml").string();
  std::vector<std::string> files{rig_file};
  for (const StudyScenario& s : study.scenarios)
    files.push_back((folder / std::filesystem::path(s.file).stem()).string() + ".toml");
  RefuseOverwriting(files, o.common.force);
  WriteMarkedText(
      rig_file, "design",
      fmt::format("# Point {} of {}: {}, made from {}\n", k, study.file, c.name, c.rig_file) +
          RigTextOfPoint(c, p.values));
  const RigParameters rig = ReadRig(rig_file);
  for (const StudyScenario& s : study.scenarios) {
    const std::string stem = std::filesystem::path(s.file).stem().string(),
                      file = (folder / (stem + ".toml")).string();
    WriteMarkedText(
        file, "design",
        WithAbsoluteFiles(EditedToml(s.text, s.file, {{"rig", std::string("rig.toml")}}), s.file));
    const Scenario scenario = ReadScenario(file, rig);
    SimulateOptions options;
    options.fidelity = study.fidelity;
    options.for_report = true;
    options.stop = &interrupted;
    RunResult run = Simulate(rig, scenario, options);
    run.record.attributes["scenario"] = ReadFile(file);
    run.record.attributes["rig"] = ReadFile(rig_file);
    run.record.attributes["made_by"] = "ambrig design";
    WriteHdf5(run.record, (folder / (stem + ".h5")).string());
    const auto expect = CheckExpectations(scenario, run);
    WriteFileAtomically((folder / (stem + ".json")).string(),
                        JsonText(RunJson(scenario, run, expect), 2) + "\n");
    if (!o.no_report)
      WriteRunReport(MakeRunReportData(rig, scenario, run, expect, "study"),
                     (folder / (stem + ".html")).string());
    fmt::print("  {:<28} {}\n", s.name,
               run.drop        ? Coloured("rotor dropped", "red")
               : run.touchdown ? Coloured("touched down", "yellow")
                               : Coloured("rotor stayed up", "green"));
  }
  const Evaluation again = Evaluate(study, p.candidate, p.values, &interrupted);
  const bool same = again.figures == p.result.figures;
  for (std::size_t j = 0; j < study.figures.size(); ++j)
    fmt::print("  {:<36} {:>14}\n", study.figures[j].name,
               ScreenSi(again.figures[j], study.figures[j].info->unit, 6));
  fmt::print("  {} the study's figures\n  written            {}\n",
             same ? "equal to" : Coloured("NOT equal to", "red"), folder.string());
  o.common.WriteJson(PointJson(study, result, k));
  return same ? 0 : 1;
}

int RunDesign(DesignOptions o) {
  const Study study = ReadStudy(o.file);
  if (o.out.empty())
    o.out = (std::filesystem::path("out") / std::filesystem::path(o.file).stem()).string();
  o.common.CheckOutputs({o.file});
  PrepareStudyFolder(o.out, {"table.csv", "study.json", "report.html"}, o.common.force);
  StudyResult result;
  {
    Progress progress("design");
    StudyOptions options;
    options.folder = o.out;
    options.jobs = o.jobs;
    options.stop = &interrupted;
    options.progress = [&](std::size_t done, std::size_t all) {
      progress.Update(std::min(1.0, static_cast<double>(done) /
                                        static_cast<double>(std::max<std::size_t>(all, 1))),
                      fmt::format("{} of {}", done, Counted(all, "point")));
    };
    try {
      result = RunStudy(study, options);
    } catch (const Interrupted&) {
      fmt::print(stderr,
                 "ambrig: stopped; results so far are kept in {}; re-run the command to resume\n",
                 o.out);
      return 130;
    }
  }
  if (o.point >= 0) return Repeat(study, result, o);
  std::vector<std::size_t> shown;
  for (std::size_t c = 0; c < study.candidates.size(); ++c)
    shown.push_back(RepresentativeOf(study, result, c));
  WriteTable(study, result, (std::filesystem::path(o.out) / "table.csv").string());
  const auto json = StudyJson(study, result, shown);
  WriteFileAtomically((std::filesystem::path(o.out) / "study.json").string(),
                      JsonText(json, 2) + "\n");
  o.common.WriteJson(json);
  PrintStudy(study, result, shown);
  if (!o.no_report || !o.common.html.empty()) {
    std::vector<PointResponses> responses;
    for (const std::size_t k : shown) {
      try {
        responses.push_back(ResponsesOf(study, result, k, &interrupted));
      } catch (const Interrupted&) {
        throw;
      } catch (const std::exception&) {
        responses.emplace_back();  // its note says why
        responses.back().point = k;
      }
    }
    const std::string html = (std::filesystem::path(o.out) / "report.html").string();
    if (!o.no_report) WriteDesignReport(study, result, responses, html);
    if (!o.common.html.empty()) WriteDesignReport(study, result, responses, o.common.html);
    if (!o.no_report) fmt::print("  report             {}\n", html);
  }
  fmt::print("  written            {}/table.csv, study.json\n", o.out);
  return std::any_of(result.points.begin(), result.points.end(),
                     [](const StudyPoint& p) { return p.feasible; })
             ? 0
             : 1;
}

}  // namespace

void AddDesign(CLI::App& app, Work& work) {
  auto options = std::make_shared<DesignOptions>();
  CLI::App* command = app.add_subcommand(
      "design", "compare controllers, sweep or optimise their parameters: Pareto front");
  command->add_option("study", options->file, "study file (TOML)")->required();
  command->add_option(
      "-o,--out", options->out,
      "folder of journal, table.csv, study.json, report.html (default: out/NAME of the file)");
  command->add_option("-j,--jobs", options->jobs, "runs at the same time (default: all cores)")
      ->check(CLI::Range(0, 1024));
  command
      ->add_option("--point", options->point,
                   "write the rig and scenarios of this point and repeat its runs")
      ->check(CLI::Range(0LL, 100000000LL));
  command->add_flag("--no-report", options->no_report, "no HTML");
  options->common.AddTo(*command);
  command->footer(
      "Examples:\n  ambrig design examples/design/small.toml\n"
      "  ambrig design examples/design/small.toml --point 1\n"
      "Re-run the command to resume an interrupted one. Exit code 1 when no point is\n"
      "feasible, or a repeated point differs.");
  command->callback([options, &work] { work = [options] { return RunDesign(*options); }; });
}

}  // namespace ambrig
