/// ambrig campaign: many runs, on all cores or a cluster; ambrig merge: their shards as one.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/commands/work_size.h"
#include "app/pages/campaign_report.h"
#include "app/text/format.h"
#include "app/text/screen.h"
#include "campaign/journal.h"
#include "campaign/merge.h"
#include "campaign/plant_table.h"
#include "campaign/run_rows.h"
#include "campaign/slurm_engine.h"
#include "core/base/counted.h"

namespace ambrig {

namespace {

struct CampaignOptions {
  CommonOptions common;
  std::string file, out, shard, engine = "local";
  std::string sbatch;
  int jobs = 0, tasks = 0;
  double poll = 2;
  bool no_report = false, long_runs = false;
};

nlohmann::ordered_json CampaignJson(const JournalHeader& header, const RowCounts& n) {
  return {{"name", header.name},
          {"fingerprint", header.fingerprint},
          {"runs", header.runs},
          {"done", n.rows},
          {"up", n.up},
          {"touchdown", n.touchdown},
          {"drop", n.drop},
          {"error", n.error},
          {"reasons", n.reasons},
          {"false_alarms", n.false_alarms},
          {"coil_periods", n.coil_periods},
          {"undetected", n.undetected},
          {"worst_detection_delay", n.worst_delay},
          {"largest_orbit", n.largest_orbit}};
}

/// Table, report, JSON, and a few lines on the screen.
void Conclude(const CommonOptions& common, bool no_report, const std::string& out,
              const JournalHeader& header, const Rows& rows) {
  WriteTable(out, rows);
  const RowCounts n = CountRows(rows);
  const std::string html = (std::filesystem::path(out) / "report.html").string();
  if (!no_report) WriteCampaignReport(header, rows, html);
  if (!common.html.empty()) WriteCampaignReport(header, rows, common.html);
  common.WriteJson(CampaignJson(header, n));
  fmt::print("{}\n  runs               {} of {}\n", Coloured(header.name, "bold"), n.rows,
             header.runs);
  fmt::print("  stayed up          {}\n  touched down       {}\n  dropped            {}\n", n.up,
             n.touchdown, n.drop);
  for (const auto& [reason, runs] : n.reasons) fmt::print("    {:<21} {}\n", reason, runs);
  if (n.error > 0)
    fmt::print("  {}\n",
               Coloured(fmt::format("not finished       {} (column note)", n.error), "red"));
  fmt::print("  false alarms       {}\n", FalseAlarmText(n.false_alarms, n.coil_periods));
  if (n.faults > 0)
    fmt::print("  faults             {}, not detected {}, longest delay {}\n", n.faults,
               n.undetected, n.worst_delay > 0 ? ScreenSi(n.worst_delay, "s") : "-");
  fmt::print("  largest orbit      {} (runs that stayed up)\n",
             n.up > 0 ? ScreenSi(n.largest_orbit, "m") : "-");
  const bool plants = WritePlantTables(out, rows);
  fmt::print("  written            {}/table.csv{}{}\n", out, plants ? ", plants.md, matrix.md" : "",
             no_report ? "" : " and report.html");
}

void RunHere(const RunPlan& plan, const CampaignOptions& o, const Shard& shard,
             CampaignJournal& journal) {
  const auto pending = PendingRuns(plan.campaign().runs(), shard, journal.rows());
  if (pending.empty()) return;
  Progress progress("campaign");
  std::atomic<std::size_t> done{0}, dropped{0};
  const auto begin = std::chrono::steady_clock::now();
  RunRows(plan, pending, o.jobs, &interrupted, [&](const Row& row) {
    journal.Append(row);
    if (row.At("verdict") == "drop") ++dropped;
    const std::size_t n = ++done;
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    progress.Update(static_cast<double>(n) / static_cast<double>(pending.size()),
                    fmt::format("{}/{} runs, {:.1f}/s, {} dropped", n, pending.size(),
                                static_cast<double>(n) / seconds, dropped.load()));
  });
}

void RunOnCluster(const RunPlan& plan, const CampaignOptions& o, CampaignJournal& journal) {
  SlurmOptions slurm;
  slurm.program = std::filesystem::read_symlink("/proc/self/exe").string();
  slurm.tasks = o.tasks;
  slurm.cpus = std::max(o.jobs, 1);
  slurm.sbatch = o.sbatch;
  slurm.poll = o.poll;
  Progress progress("campaign (slurm)");
  const std::size_t runs = plan.campaign().runs(), before = journal.rows().size();
  const auto begin = std::chrono::steady_clock::now();
  RunOnSlurm(plan, o.out, journal, slurm, &interrupted, [&](std::size_t done) {
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    progress.Update(static_cast<double>(done - before) / static_cast<double>(runs - before),
                    fmt::format("{}/{} runs, {:.1f}/s", done, runs,
                                static_cast<double>(done - before) / seconds));
  });
}

int RunCampaign(CampaignOptions o) {
  const RunPlan plan(ReadCampaign(o.file));
  Shard shard = o.shard.empty() ? Shard{} : ParseShard(o.shard);
  shard.together = plan.campaign().RunsTogether(shard.count);
  if (o.out.empty())
    o.out = (std::filesystem::path("out") / std::filesystem::path(o.file).stem()).string();
  if (o.engine == "slurm" && !o.shard.empty())
    throw InputError("--shard: allowed with --engine local only (slurm makes its own)");
  const JournalHeader header = HeaderOf(plan.campaign());
  o.common.CheckOutputs({o.file, plan.campaign().rig.file});
  PrepareStudyFolder(o.out, {"table.csv", "report.html"}, o.common.force);
  CampaignJournal journal(o.out, header);
  if (!journal.rows().empty())
    fmt::print("{}: resumed, {} done before{}\n", o.out, Counted(journal.rows().size(), "run"),
               journal.damaged() > 0
                   ? fmt::format(", {} done again", Counted(journal.damaged(), "damaged line"))
                   : "");
  if (o.engine == "local")
    CheckWorkSize(o.file,
                  CampaignSize(plan.campaign(),
                               PendingRuns(header.runs, shard, journal.rows()).size(), o.jobs),
                  o.long_runs);
  WriteTable(o.out, journal.rows());  // its header, for whoever follows the journal
  try {
    if (o.engine == "slurm")
      RunOnCluster(plan, o, journal);
    else
      RunHere(plan, o, shard, journal);
  } catch (const Interrupted&) {
    fmt::print(stderr, "ambrig: stopped; {} of {} kept in {}; re-run the command to resume\n",
               journal.rows().size(), Counted(header.runs, "run"), o.out);
    return 130;
  }
  Conclude(o.common, o.no_report, o.out, header, journal.rows());
  return 0;
}

struct MergeOptions {
  CommonOptions common;
  std::vector<std::string> folders;
  std::string out;
  bool partial = false, no_report = false;
};

int Merge(const MergeOptions& o) {
  JournalContent merged = MergeJournals(o.folders, o.partial);
  o.common.CheckOutputs({});
  PrepareStudyFolder(o.out, {"table.csv", "report.html"}, o.common.force);
  CampaignJournal journal(o.out, merged.header);
  for (auto& [run, row] : merged.rows)
    if (!journal.rows().contains(run)) journal.Append(std::move(row));
  Conclude(o.common, o.no_report, o.out, merged.header, journal.rows());
  return 0;
}

}  // namespace

void AddCampaign(CLI::App& app, Work& work) {
  auto options = std::make_shared<CampaignOptions>();
  CLI::App* command = app.add_subcommand(
      "campaign", "many runs: fault sets x speeds x loads x spread of parameters");
  command->add_option("campaign", options->file, "campaign file (TOML)")->required();
  command->add_option(
      "-o,--out", options->out,
      "folder of journal.txt, table.csv, report.html (default: out/NAME of the file)");
  command->add_option("-j,--jobs", options->jobs, "runs at the same time (default: all cores)")
      ->check(CLI::Range(1, 1024));
  command->add_option("--shard", options->shard,
                      "only part i of n of the runs, e.g. 2/4 (then: ambrig merge)");
  command
      ->add_option("--engine", options->engine,
                   "local: this machine; slurm: array tasks of a cluster that sees the same files")
      ->check(CLI::IsMember({"local", "slurm"}))
      ->capture_default_str();
  command
      ->add_option("--tasks", options->tasks,
                   "slurm: number of array tasks (default: chosen so that a task takes minutes)")
      ->check(CLI::Range(1, kMostTasks));
  command->add_option("--sbatch", options->sbatch,
                      "slurm: further options of sbatch, e.g. \"--partition=long --time=60\"");
  command->add_option("--poll", options->poll, "slurm: seconds between queries of the queue")
      ->check(NumberIn(0.1, 3600, "s"))
      ->capture_default_str();
  command->add_flag("--no-report", options->no_report, "no report.html");
  command->add_flag("--long", options->long_runs, "start also when the estimate exceeds a day");
  options->common.AddTo(*command);
  command->footer(
      "Examples:\n"
      "  ambrig campaign scenarios/campaigns/one_blow.toml -o out/contact\n"
      "  ambrig campaign scenarios/campaigns/one_blow.toml --shard 1/2 -o part1\n"
      "  ambrig run --from-campaign scenarios/campaigns/one_blow.toml --row 1\n"
      "Re-run the command to resume an interrupted one; the last example repeats one\n"
      "row of the table with its record and report. A small campaign file (each coil\n"
      "of the first bearing opens, at two speeds; all keys: docs/guide/campaign.md):\n"
      "    rig = \"rig.toml\"\n"
      "    duration = 0.1               # s\n"
      "    seeds = 2                    # runs of each, with noise of their own\n"
      "    faults = { sets = \"single\", time = 0.02 }\n"
      "    operation = { speeds = [0.0, 157.08] }   # rad/s");
  command->callback([options, &work] { work = [options] { return RunCampaign(*options); }; });
}

void AddMerge(CLI::App& app, Work& work) {
  auto options = std::make_shared<MergeOptions>();
  CLI::App* command =
      app.add_subcommand("merge", "combine shards of a campaign into one table and report");
  command->add_option("folder", options->folders, "folders of the shards")->required();
  command->add_option("-o,--out", options->out, "folder of the merged campaign")->required();
  command->add_flag("--partial", options->partial, "merge even when runs are missing");
  command->add_flag("--no-report", options->no_report, "no report.html");
  options->common.AddTo(*command);
  command->footer(
      "Examples (after both shards of a campaign, see ambrig campaign --help):\n"
      "  ambrig merge part1 part2 -o all\n"
      "  ambrig merge part1 -o half --partial");
  command->callback([options, &work] { work = [options] { return Merge(*options); }; });
}

}  // namespace ambrig
