#include "workbench/job_commands.h"

namespace ambrig::workbench {

namespace {

using enum ArgumentKind;

/// Work on a case.
std::vector<JobCommand> CaseCommands() {
  return {{"compare",
           "compare",
           false,
           {{"case", "", kFile, true}},
           {"--series", "JOB/series.h5", "--html", "JOB/report.html"}},
          {"explain",
           "explain",
           true,
           {{"case", "", kFile, true}, {"candidates", "--candidates", kNumber}},
           {"--resume", "WORK", "--html", "JOB/report.html"}},
          {"adopt",
           "adopt",
           false,
           {{"case", "", kFile, true},
            {"effect", "", kName, true},
            {"target", "--target", kName},
            {"rig", "--output", kNewFile, true},
            {"new_case", "--case", kNewFile, true}},
           {"--html", "JOB/report.html"}},
          {"refine",
           "refine",
           true,
           {{"case", "", kFile, true},
            {"effect", "", kName, true},
            {"rig", "--output", kNewFile, true},
            {"new_case", "--case", kNewFile}},
           {"--html", "JOB/report.html"}},
          {"plan",
           "plan",
           true,
           {{"case", "", kFile, true},
            {"scenario", "--output", kNewFile, true},
            {"draws", "--draws", kNumber}},
           {"--html", "JOB/report.html"}},
          {"watch",
           "watch",
           true,
           {{"case", "", kFile, true}, {"folder", "", kFolder, true}},
           {"--html", "JOB/report.html"}}};
}

/// Runs, campaigns, rigs and files of instruments.
std::vector<JobCommand> RunCommands() {
  return {
      {"run", "run", false, {{"scenario", "", kFile, true}}, {"--out", "JOB/run", "--quiet"}},
      {"play",
       "run",
       false,
       {{"scenario", "", kScenario, true}},
       {"--out", "JOB/run", "--quiet", "--no-traces"}},
      {"row",
       "run",
       false,
       {{"campaign", "--from-campaign", kFile, true}, {"row", "--row", kNumber, true}},
       {"--out", "JOB/run", "--quiet", "--html", "JOB/report.html"}},
      {"campaign",
       "campaign",
       true,
       {{"campaign", "", kFile, true}, {"jobs", "--jobs", kNumber}},
       {"--out", "WORK", "--html", "JOB/report.html"}},
      {"rig", "rig", false, {{"rig", "", kFile, true}}, {}},
      {"diff", "diff", false, {{"a", "", kFile, true}, {"b", "", kFile, true}}, {}, false},
      {"difference",
       "diff",
       false,
       {{"a", "", kRun, true}, {"b", "", kRun, true}},
       {"--html", "JOB/report.html"},
       false},
      {"channels", "channels", false, {{"file", "", kFile, true}}, {}},
      {"tour", "tour", false, {{"folder", "--out", kNewFolder, true}}, {}, false, false},
      {"hide",
       "hide",
       false,
       {{"effect", "", kName, true},
        {"rig", "--rig", kFile, true},
        {"seed", "--seed", kNumber, true},
        {"folder", "--out", kNewFolder, true}},
       {},
       false,
       false},
      {"questions", "new", false, {}, {"--list"}, false},
      {"new",
       "new",
       false,
       {{"template", "--template", kName, true},
        {"numbers", "--answers", kNumbers, true},
        {"record", "--record", kFile},
        {"columns", "--column", kColumns},
        {"folder", "--out", kNewFolder, true}},
       {"--only-files"},
       false},
  };
}

}  // namespace

std::span<const JobCommand> JobCommands() {
  static const std::vector<JobCommand> table = [] {
    std::vector<JobCommand> all = CaseCommands();
    for (const JobCommand& c : RunCommands()) all.push_back(c);
    return all;
  }();
  return table;
}

}  // namespace ambrig::workbench
