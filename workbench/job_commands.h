#pragma once
/// The table of jobs: their arguments, and what the server adds.
#include <span>
#include <vector>

namespace ambrig::workbench {

enum class ArgumentKind {
  kFile,       // a file of the folder and all that it names
  kNewFile,    // a .toml file that is not there yet
  kFolder,     // a folder of the folder
  kNewFolder,  // one that is not there yet
  kName,       // of the catalogue, or of a target
  kNumber,     // 0 to 100000
  kRun,        // number of a job that ran a scenario: its record
  kNumbers,    // {"mass": 1.2}: a TOML file of the job
  kColumns,    // {"A.x": "pos_ax:um:-1"}: the option once for each
  kScenario,   // {"beside": "healthy.toml", "text": ...}: a scenario that only the job has
};

/// One argument: its key in the request, its option ("" for a positional one), what it may be.
struct JobArgument {
  const char *key, *option;
  ArgumentKind kind;
  bool required = false;
};

struct JobCommand {
  const char* name;     // of the job
  const char* command;  // of ambrig
  bool heavy;           // takes all cores for long
  std::vector<JobArgument> arguments;
  // JOB stands for the job's folder, WORK for one that equal orders share: what an interrupted one
  // left
  std::vector<const char*> added;
  bool events = true;  // the command has --events
  bool json = true;    // and --json
};

std::span<const JobCommand> JobCommands();

}  // namespace ambrig::workbench
