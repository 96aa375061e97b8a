#pragma once
/// Which commands the page may start and what their arguments may be: nothing else reaches a
/// command line, and no shell is between.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "workbench/served_folder.h"

namespace ambrig::workbench {

/// A command line that was checked.
struct JobOrder {
  std::string command, subject;        // "explain", the file that it is about
  std::vector<std::string> arguments;  // after the program's name, without --json and the like
  std::vector<std::string> new_files;  // that it will write beside the user's own
  std::vector<std::pair<std::string, std::string>>
      texts;           // file of the job, its text: written first
  std::string key;     // equal for equal orders
  bool heavy = false;  // takes all cores for long: one at a time
  bool json = true;    // writes its answer (--json)
  bool events = true;  // tells its progress (--events)
};

/// Of {"command": "adopt", "case": "practice/case.toml", "effect": "cross-coupling", ...}.
/// `job_folder`: where the job's own outputs go, relative to the served folder.
/// @throws InputError for a command or argument that is not in the table, a file that is not there
/// or that names files outside the folder, a new file that exists
JobOrder CheckJob(const nlohmann::json& request, const ServedFolder& folder,
                  const std::string& job_folder);

}  // namespace ambrig::workbench
