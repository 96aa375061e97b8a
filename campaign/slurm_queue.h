#pragma once
/// The few words of Slurm that a campaign needs: submit an array of tasks, ask which are alive.
/// A controller that does not answer is told apart from a job that is over.
#include <map>
#include <string>
#include <vector>

namespace ambrig {

/// An array of tasks to submit: `script` finds its number in $SLURM_ARRAY_TASK_ID.
struct SlurmArray {
  std::string script, log;  // absolute paths; log with %a for the task
  std::vector<std::size_t> tasks;
  int cpus = 1;
  std::string options;  // further options for sbatch, as on its command line
};

/// Job number; empty when the controller cannot be reached now. @throws InputError for what sbatch
/// refuses.
std::string SubmitArray(const SlurmArray& array);

struct SlurmTasks {
  bool reachable = false;  // false: nothing is known
  // pending, running or ending tasks: number, id ("12_3")
  std::multimap<std::size_t, std::string> alive;
};
/// Tasks that Slurm holds because a node failed to start them are released: nobody else would.
SlurmTasks AskTasks(const std::vector<std::string>& jobs);

/// Jobs ("12") or tasks ("12_3").
void CancelJobs(const std::vector<std::string>& jobs);

/// The text as one word of a shell's command line.
std::string QuotedForShell(const std::string& text);

/// "1-4,7" for {1, 2, 3, 4, 7}.
std::string ArrayText(const std::vector<std::size_t>& tasks);

}  // namespace ambrig
