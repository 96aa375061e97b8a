#include "workbench/jobs.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "core/base/atomic_file.h"
#include "core/base/errors.h"
#include "core/base/json_file.h"
#include "workbench/child_process.h"

namespace ambrig::workbench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kHeavyAtOnce = 1, kLightAtOnce = 2, kHeavyNice = 10;
constexpr auto kPatience = std::chrono::seconds(10);  // between SIGINT and SIGKILL

std::string Now() { return fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr))); }

}  // namespace

Jobs::Jobs(const ServedFolder& folder, std::string program, EventLog& events)
    : folder_(folder), program_(std::move(program)), events_(events) {
  std::error_code error;
  fs::create_directories(fs::path(folder_.path()) / ".ambrig" / "jobs", error);
  if (!error) fs::permissions(fs::path(folder_.path()) / ".ambrig", fs::perms::owner_all, error);
  if (error) throw InputError(fmt::format("{}/.ambrig: {}", folder_.path(), error.message()));
  ReadEarlier();
  ForgetOldRunsLocked();
  for (int k = 0; k < kHeavyAtOnce + kLightAtOnce; ++k) workers_.emplace_back([this] { Work(); });
}

Jobs::~Jobs() {
  {
    const std::scoped_lock lock(mutex_);
    closing_ = true;
    for (auto& [id, job] : jobs_)
      if (job.pid > 0) ::kill(job.pid, SIGINT);
    changed_.notify_all();
  }
  for (std::thread& t : workers_) t.join();
  for (std::thread& t : killers_) t.join();
}

std::string Jobs::FolderOf(int id) const {
  return fmt::format("{}/.ambrig/jobs/{}", folder_.path(), id);
}

void Jobs::ReadEarlier() {
  std::error_code error;
  for (const auto& entry :
       fs::directory_iterator(fs::path(folder_.path()) / ".ambrig" / "jobs", error)) {
    try {
      const nlohmann::json j = ReadJson((entry.path() / "job.json").string());
      Job job;
      job.id = j.at("id");
      job.order.command = j.at("command");
      job.order.subject = j.at("subject");
      job.order.arguments = j.at("argv").get<std::vector<std::string>>();
      job.order.new_files = j.at("new_files").get<std::vector<std::string>>();
      job.state = j.at("state");
      job.error = j.at("error");
      job.started = j.at("started");
      job.code = j.at("code");
      job.seconds = j.at("seconds");
      if (job.state == "queued" || job.state == "running") job.state = "interrupted";
      jobs_[job.id] = job;
    } catch (const std::exception&) {
      continue;  // a folder that a crash left without its state: its number is not used again
    }
  }
}

void Jobs::ForgetOldRunsLocked() {
  int kept = 0;
  for (auto it = jobs_.end(); it != jobs_.begin();) {
    const Job& job = (--it)->second;
    const bool active = job.state == "queued" || job.state == "running";
    if (job.order.command != "play" || active || ++kept <= kRunsKept) continue;
    std::error_code error;  // what cannot be removed is forgotten all the same
    fs::remove_all(FolderOf(it->first), error);
    it = jobs_.erase(it);
  }
}

Json Jobs::JsonOf(const Job& job) const {
  return {{"id", job.id},
          {"command", job.order.command},
          {"subject", job.order.subject},
          {"argv", job.order.arguments},
          {"new_files", job.order.new_files},
          {"state", job.state},
          {"error", job.error},
          {"started", job.started},
          {"code", job.code},
          {"seconds", job.seconds}};
}

void Jobs::Store(const Job& job) const {
  try {
    WriteFileAtomically(FolderOf(job.id) + "/job.json", JsonOf(job).dump(2) + "\n");
  } catch (const InputError& e) {
    events_.Add({{"event", "warning"}, {"job", job.id}, {"text", e.what()}});
  }
}

Json Jobs::Start(const nlohmann::json& request) {
  const std::scoped_lock lock(mutex_);
  int id = jobs_.empty() ? 1 : jobs_.rbegin()->first + 1;
  while (fs::exists(FolderOf(id))) ++id;
  const std::string own = fmt::format(".ambrig/jobs/{}", id);
  Job job;
  job.id = id;
  job.order = CheckJob(request, folder_, own);
  // The same work that waits or runs already is shared.
  for (const auto& [other_id, other] : jobs_)
    if ((other.state == "queued" || other.state == "running") && !other.stop &&
        other.order.key == job.order.key && job.order.new_files.empty())
      return JsonOf(other);
  fs::create_directories(FolderOf(id));
  for (const auto& [name, text] : job.order.texts)
    WriteFileAtomically(FolderOf(id) + "/" + name, text);
  if (job.order.json)
    job.order.arguments.insert(job.order.arguments.end(), {"--json", own + "/result.json"});
  if (job.order.events) job.order.arguments.insert(job.order.arguments.end(), {"--events", "3"});
  job.started = Now();
  Store(job);
  jobs_[id] = job;
  events_.Add({{"event", "job"}, {"job", JsonOf(job)}});
  changed_.notify_all();
  return JsonOf(job);
}

Job* Jobs::NextLocked() {
  for (auto& [id, job] : jobs_) {
    if (job.state != "queued") continue;
    if (job.order.heavy ? heavy_running_ < kHeavyAtOnce : light_running_ < kLightAtOnce)
      return &job;
  }
  return nullptr;
}

void Jobs::Work() {
  for (;;) {
    int id = 0;
    {
      std::unique_lock lock(mutex_);
      Job* next = nullptr;
      changed_.wait(lock, [&] { return closing_ || (next = NextLocked()) != nullptr; });
      if (closing_) return;
      next->state = "running";
      ++(next->order.heavy ? heavy_running_ : light_running_);
      id = next->id;
      Store(*next);
      events_.Add({{"event", "job"}, {"job", JsonOf(*next)}});
    }
    RunJob(id);
  }
}

void Jobs::RunJob(int id) {
  JobOrder order;
  {
    const std::scoped_lock lock(mutex_);
    order = jobs_[id].order;
  }
  const auto begin = std::chrono::steady_clock::now();
  int code = 3;
  try {
    code = RunChild(
               program_, order.arguments, folder_.path(), FolderOf(id) + "/log.txt",
               order.heavy ? kHeavyNice : 0,
               [&](int pid) {
                 const std::scoped_lock lock(mutex_);
                 jobs_[id].pid = pid;
                 if (jobs_[id].stop || closing_) ::kill(pid, SIGINT);
               },
               [&](const std::string& line) { TakeLine(id, line); })
               .code;
  } catch (const InputError& e) {
    const std::scoped_lock lock(mutex_);
    jobs_[id].error = e.what();
  }
  Finish(id, code, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
}

void Jobs::TakeLine(int id, const std::string& line) {
  Json event = Json::parse(line, nullptr, false);
  if (!event.is_object()) return;
  std::ofstream(FolderOf(id) + "/events.jsonl", std::ios::app) << line << '\n';
  if (event.value("event", "") == "done") {
    const std::scoped_lock lock(mutex_);
    jobs_[id].error = event.value("error", "");
    return;  // told with the job's end
  }
  event["job"] = id;
  events_.Add(std::move(event));
}

void Jobs::Finish(int id, int code, double seconds) {
  const std::scoped_lock lock(mutex_);
  Job& job = jobs_[id];
  job.pid = 0;
  job.code = code;
  job.seconds = seconds;
  // 1: an expectation or a comparison that fails is an answer.
  job.state = code == 0 || code == 1 ? "done"
              : job.stop             ? "stopped"
              : closing_             ? "interrupted"
                                     : "failed";
  if (job.state == "failed" && job.error.empty()) job.error = LastWords(id);
  --(job.order.heavy ? heavy_running_ : light_running_);
  Store(job);
  events_.Add({{"event", "job"}, {"job", JsonOf(job)}});
  ForgetOldRunsLocked();
  changed_.notify_all();
}

Json Jobs::State(int id) const {
  const std::scoped_lock lock(mutex_);
  const auto found = jobs_.find(id);
  return found == jobs_.end() ? Json() : JsonOf(found->second);
}

Json Jobs::All() const {
  const std::scoped_lock lock(mutex_);
  Json all = Json::array();
  for (const auto& [id, job] : jobs_) all.push_back(JsonOf(job));
  return all;
}

bool Jobs::Active(const std::string& command, const std::string& subject) const {
  const std::scoped_lock lock(mutex_);
  for (const auto& [id, job] : jobs_)
    if ((job.state == "queued" || job.state == "running") && job.order.command == command &&
        job.order.subject == subject)
      return true;
  return false;
}

/// The last line that a command without events wrote, which says what went wrong.
std::string Jobs::LastWords(int id) const {
  std::ifstream in(FolderOf(id) + "/log.txt");
  std::string line, last;
  while (std::getline(in, line))
    if (line.starts_with("ambrig: ")) last = line.substr(8);
  return last;
}

bool Jobs::Stop(int id) {
  int pid = 0;
  {
    const std::scoped_lock lock(mutex_);
    const auto found = jobs_.find(id);
    if (found == jobs_.end()) return false;
    Job& job = found->second;
    if (job.state == "queued") {
      job.state = "stopped";
      Store(job);
      events_.Add({{"event", "job"}, {"job", JsonOf(job)}});
      return true;
    }
    if (job.state != "running") return false;
    job.stop = true;
    pid = job.pid;
    if (pid > 0) ::kill(pid, SIGINT);
  }
  const std::scoped_lock lock(mutex_);
  killers_.emplace_back([this, id, pid] {
    std::unique_lock waiting(mutex_);
    const auto ended = [&] {
      const auto job = jobs_.find(id);
      return job == jobs_.end() || job->second.pid == 0;
    };
    if (!changed_.wait_for(waiting, kPatience, ended) && jobs_[id].pid == pid && pid > 0)
      ::kill(pid, SIGKILL);
  });
  return true;
}

int Jobs::Latest(const std::string& command, const std::string& subject) const {
  const std::scoped_lock lock(mutex_);
  for (auto it = jobs_.rbegin(); it != jobs_.rend(); ++it)
    if (it->second.state == "done" && it->second.order.command == command &&
        it->second.order.subject == subject)
      return it->first;
  return 0;
}

}  // namespace ambrig::workbench
