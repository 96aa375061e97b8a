#include "campaign/slurm_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <thread>

#include "campaign/slurm_queue.h"
#include "core/base/atomic_file.h"
#include "core/base/counted.h"
#include "core/base/read_file.h"

namespace ambrig {

namespace {

namespace fs = std::filesystem;
constexpr int kAttempts = 4;   // of a shard that brings no row
constexpr double kLinger = 5;  // [s] a task may need to end after its last row

struct ShardState {
  std::size_t missing = 0;  // rows
  std::uintmax_t size = 0;  // of its journal when last read
  double lingering = 0;     // [s] that its task is in the queue though all rows are there
  int gone = 0;             // looks in a row that found it neither alive nor complete
  int fruitless = 0;        // submissions since its last new row
};

std::string ReadIfThere(const fs::path& file) {
  return fs::exists(file) ? ReadFile(file.string()) : "";
}

class SlurmRun {
 public:
  SlurmRun(const RunPlan& plan, const std::string& folder, CampaignJournal& journal,
           const SlurmOptions& options)
      : campaign_(plan.campaign()),
        folder_(fs::absolute(folder) / "shards"),
        journal_(journal),
        options_(options) {
    fs::create_directories(folder_);
    ChooseShards(plan);
    std::istringstream jobs(ReadIfThere(folder_ / "jobs.txt"));
    for (std::string job; std::getline(jobs, job);) jobs_.push_back(job);
    for (const auto& [run, row] : journal_.rows()) --ShardOf(run).missing;
    WriteScript();
  }

  bool complete() const {
    return std::all_of(shards_.begin(), shards_.end(),
                       [](const ShardState& s) { return s.missing == 0; });
  }

  /// Takes over what the shards' journals hold by now. True when there was something new.
  bool Gather() {
    bool fresh = false;
    for (std::size_t k = 0; k < shards_.size(); ++k) {
      ShardState& s = shards_[k];
      const std::string folder = (folder_ / std::to_string(k + 1)).string();
      std::error_code error;
      const auto size = fs::file_size(fs::path(folder) / "journal.txt", error);
      if (error || size == s.size || s.missing == 0) continue;
      s.size = size;
      // just begun
      if (ReadFile(folder + "/journal.txt").find('\n') == std::string::npos) continue;
      const JournalContent part = ReadJournal(folder);
      if (part.header.fingerprint != campaign_.fingerprint)
        throw InputError(
            fmt::format("{}: is of another campaign, allowed: an empty folder", folder));
      for (const auto& [run, row] : part.rows) {
        if (journal_.rows().contains(run)) continue;
        journal_.Append(row);
        --ShardOf(run).missing;
        s.fruitless = 0;
        fresh = true;
      }
    }
    return fresh;
  }

  /// Submits again what is neither complete nor alive; twice seen, for files may come late.
  void Resubmit() {
    const SlurmTasks tasks = AskTasks(jobs_);
    if (!tasks.reachable) return;
    std::vector<std::size_t> again;
    for (std::size_t k = 0; k < shards_.size(); ++k) {
      ShardState& s = shards_[k];
      s.gone = s.missing == 0 || tasks.alive.contains(k + 1) ? 0 : s.gone + 1;
      // A restarted controller may hold a node for a task that ended while it was away.
      s.lingering = s.missing == 0 && tasks.alive.contains(k + 1) ? s.lingering + options_.poll : 0;
      if (s.lingering > kLinger) {
        const auto [first, last] = tasks.alive.equal_range(k + 1);
        for (auto it = first; it != last; ++it) CancelJobs({it->second});
        s.lingering = 0;
      }
      if (s.gone < (jobs_.empty() ? 1 : 2)) continue;
      if (s.fruitless >= kAttempts)
        throw InputError(fmt::format("--engine slurm: task {} ended {} without a row, see {}",
                                     k + 1, Counted(kAttempts, "time"),
                                     (folder_ / fmt::format("{}.log", k + 1)).string()));
      again.push_back(k + 1);
    }
    if (again.empty()) return;
    const std::string job =
        SubmitArray({(folder_ / "task.sh").string(), (folder_ / "%a.log").string(), again,
                     options_.cpus, options_.sbatch});
    if (job.empty()) return;  // the controller is away: the next look tries again
    for (const std::size_t task : again) {
      shards_[task - 1].gone = 0;
      ++shards_[task - 1].fruitless;
    }
    jobs_.push_back(job);
    std::string text;
    for (const std::string& j : jobs_) text += j + "\n";
    WriteFileAtomically((folder_ / "jobs.txt").string(), text);
  }

  void Cancel() const { CancelJobs(jobs_); }

 private:
  /// An earlier command's number of shards stays: their journals go on.
  void ChooseShards(const RunPlan& plan) {
    const std::size_t runs = campaign_.runs();
    std::size_t n = 0;
    std::istringstream(ReadIfThere(folder_ / "count.txt")) >> n;
    if (n == 0 || n > runs) {
      n = static_cast<std::size_t>(std::max(options_.tasks, 0));
      if (n == 0) {
        const auto begin = std::chrono::steady_clock::now();
        SimulateRow(plan, runs / 2, nullptr);  // how long one takes
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        n = static_cast<std::size_t>(std::ceil(static_cast<double>(runs) * seconds /
                                               (60 * options_.task_minutes * options_.cpus)));
      }
      n = std::clamp<std::size_t>(n, 1, std::min<std::size_t>(kMostTasks, runs));
      WriteFileAtomically((folder_ / "count.txt").string(), std::to_string(n) + "\n");
    }
    shards_.resize(n);
    together_ = campaign_.RunsTogether(n);
    for (std::size_t run = 0; run < runs; ++run) ++ShardOf(run).missing;
  }

  ShardState& ShardOf(std::size_t run) {
    return shards_[Shard{0, shards_.size(), together_}.Of(run)];
  }

  void WriteScript() const {
    WriteFileAtomically(
        (folder_ / "task.sh").string(),
        fmt::format(
            "#!/bin/sh\n# One shard of a campaign; written by ambrig campaign --engine slurm.\n"
            "exec {} campaign {} -o {}/\"$SLURM_ARRAY_TASK_ID\" --shard "
            "\"$SLURM_ARRAY_TASK_ID/{}\" --jobs {} --no-report\n",
            QuotedForShell(options_.program), QuotedForShell(fs::absolute(campaign_.file).string()),
            QuotedForShell(folder_.string()), shards_.size(), options_.cpus));
  }

  const Campaign& campaign_;
  fs::path folder_;
  CampaignJournal& journal_;
  SlurmOptions options_;
  std::vector<ShardState> shards_;
  std::size_t together_ = 1;  // runs of a block, see Shard
  std::vector<std::string> jobs_;
};

}  // namespace

void RunOnSlurm(const RunPlan& plan, const std::string& folder, CampaignJournal& journal,
                const SlurmOptions& options, const std::atomic<bool>* stop,
                const std::function<void(std::size_t)>& finished) {
  SlurmRun run(plan, folder, journal, options);
  while (true) {
    if (run.Gather()) finished(journal.rows().size());
    if (run.complete()) {
      run.Cancel();  // what a restarted controller would do once more
      return;
    }
    run.Resubmit();
    const auto until =
        std::chrono::steady_clock::now() + std::chrono::duration<double>(options.poll);
    while (std::chrono::steady_clock::now() < until) {
      if (stop && stop->load()) {
        run.Cancel();
        throw Interrupted();
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  }
}

}  // namespace ambrig
