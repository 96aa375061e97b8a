#pragma once
/// A campaign's shards on a Slurm cluster whose nodes see the same files: one array task a shard,
/// each with a journal of its own under FOLDER/shards/. Rows are gathered into the campaign's
/// journal while tasks run. Tasks that ended without all their rows (killed, node lost) are
/// submitted again and go on in their journal; a silent controller is waited for. Killed itself,
/// the same command finds its tasks again.
#include <functional>

#include "campaign/journal.h"
#include "campaign/run_rows.h"

namespace ambrig {

struct SlurmOptions {
  std::string program;      // ambrig, absolute path
  int tasks = 0;            // 0: so many that each takes minutes
  int cpus = 1;             // of a task
  std::string sbatch;       // further options: "--partition=long"
  double poll = 2;          // [s] between looks at the queue
  double task_minutes = 3;  // wanted length of a task
};

inline constexpr int kMostTasks = 1000;  // Slurm's default MaxArraySize is 1001

/// `finished(gathered)`: after new rows, how many of the campaign's are there.
/// @throws InputError when Slurm refuses, or a shard makes no progress in several attempts;
/// Interrupted when stopped (tasks are cancelled).
void RunOnSlurm(const RunPlan& plan, const std::string& folder, CampaignJournal& journal,
                const SlurmOptions& options, const std::atomic<bool>* stop,
                const std::function<void(std::size_t)>& finished);

}  // namespace ambrig
