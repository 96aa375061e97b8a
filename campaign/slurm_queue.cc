#include "campaign/slurm_queue.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdio>
#include <sstream>

#include "core/base/errors.h"

namespace ambrig {

namespace {

struct Answer {
  int exit = 0;
  std::string text;  // both streams
};

Answer Ask(const std::string& command) {
  Answer out;
  FILE* pipe = popen((command + " 2>&1 < /dev/null").c_str(), "r");
  if (!pipe) throw InputError("cannot start a shell for Slurm's commands");
  char buffer[4096];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
    out.text.append(buffer, n);
  const int status = pclose(pipe);
  out.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  return out;
}

bool Unreachable(const std::string& text) {
  for (const char* said :
       {"Unable to contact slurm controller", "Connection refused", "Connection timed out",
        "Socket timed out", "Zero Bytes were transmitted or received",
        "Unexpected message received", "Communication connection failure"})
    if (text.find(said) != std::string::npos) return true;
  return false;
}

std::string FirstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

std::string QuotedForShell(const std::string& text) {
  std::string out = "'";
  for (const char ch : text) out += ch == '\'' ? std::string("'\\''") : std::string(1, ch);
  return out + "'";
}

std::string ArrayText(const std::vector<std::size_t>& tasks) {
  std::string out;
  for (std::size_t k = 0; k < tasks.size();) {
    std::size_t last = k;
    while (last + 1 < tasks.size() && tasks[last + 1] == tasks[last] + 1) ++last;
    out += fmt::format("{}{}", out.empty() ? "" : ",", tasks[k]);
    if (last > k) out += fmt::format("-{}", tasks[last]);
    k = last + 1;
  }
  return out;
}

std::string SubmitArray(const SlurmArray& a) {
  const Answer r = Ask(fmt::format(
      "sbatch --parsable --job-name=ambrig --open-mode=append --ntasks=1 "
      "--cpus-per-task={} --array={} --output={} {} {}",
      a.cpus, ArrayText(a.tasks), QuotedForShell(a.log), a.options, QuotedForShell(a.script)));
  if (r.exit != 0) {
    if (Unreachable(r.text)) return "";
    throw InputError(
        fmt::format("--engine slurm: sbatch: {}", r.text.empty() ? "failed" : FirstLine(r.text)));
  }
  // "12" or "12;cluster", perhaps after lines that warn.
  const std::size_t line = r.text.find_last_of('\n', r.text.size() - 2);
  const std::string last = r.text.substr(line == std::string::npos ? 0 : line + 1);
  return last.substr(0, last.find_first_of(";\n"));
}

SlurmTasks AskTasks(const std::vector<std::string>& jobs) {
  SlurmTasks out;
  out.reachable = true;
  for (const std::string& job : jobs) {
    const Answer r =
        Ask("squeue --noheader --array --format='%K %F_%K %r' --jobs=" + QuotedForShell(job));
    // over and forgotten
    if (r.exit != 0 && r.text.find("Invalid job id") != std::string::npos) continue;
    if (r.exit != 0) {
      out.reachable = false;  // whatever it is, nothing is known of the tasks
      return out;
    }
    std::istringstream lines(r.text);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::size_t task = 0;
      std::string number, reason;
      if (!(words >> task >> number) || !std::getline(words, reason)) continue;
      out.alive.emplace(task, number);
      if (reason.find("launch failed requeued held") != std::string::npos)
        Ask("scontrol release " + QuotedForShell(number));
    }
  }
  return out;
}

void CancelJobs(const std::vector<std::string>& jobs) {
  for (const std::string& job : jobs) Ask("scancel " + QuotedForShell(job));
}

}  // namespace ambrig
