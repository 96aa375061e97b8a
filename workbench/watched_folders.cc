#include "workbench/watched_folders.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/errors.h"
#include "core/base/fingerprint.h"
#include "core/base/json_file.h"

namespace ambrig::workbench {
namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostWatched = 20000;
constexpr std::size_t kMostEvents = 20;  // of one look; more are one event without a name
constexpr double kSettled = 6;           // [s], a little more than `ambrig watch` waits
constexpr auto kPause = std::chrono::seconds(2);
constexpr int kShare = 20;  // a look takes at most this part of the time

bool Below(const std::string& name, const std::string& folder) {
  return name.size() > folder.size() && name.starts_with(folder) && name[folder.size()] == '/';
}

}  // namespace

WatchedFolders::WatchedFolders(const ServedFolder& folder, Jobs& jobs, EventLog& events)
    : folder_(folder), jobs_(jobs), events_(events) {
  try {
    for (const auto& w : ReadJson(folder_.path() + "/.ambrig/watched.json"))
      watched_.push_back({w.at("case"), w.at("folder"), ""});
  } catch (const std::exception&) {
    watched_.clear();  // none yet
  }
  thread_ = std::thread([this] { Look(); });
}

WatchedFolders::~WatchedFolders() {
  {
    const std::scoped_lock lock(mutex_);
    closing_ = true;
    closed_.notify_all();
  }
  thread_.join();
}

Json WatchedFolders::All() const {
  const std::scoped_lock lock(mutex_);
  Json all = Json::array();
  for (const Watched& w : watched_) all.push_back({{"case", w.case_file}, {"folder", w.folder}});
  return all;
}

void WatchedFolders::Store() const {
  Json all = Json::array();
  for (const Watched& w : watched_) all.push_back({{"case", w.case_file}, {"folder", w.folder}});
  WriteFileAtomically(folder_.path() + "/.ambrig/watched.json", all.dump(2) + "\n");
}

void WatchedFolders::Set(const std::string& case_file, const std::string& folder, bool on) {
  if (on && !folder_.Has(case_file)) throw InputError(case_file + ": is not there");
  if (on && !folder_.HasFolder(folder))
    throw InputError(folder +
                     ": is no folder of the served one, allowed: the folder of the logger");
  const std::scoped_lock lock(mutex_);
  std::erase_if(watched_, [&](const Watched& w) {
    return w.case_file == case_file && (w.folder == folder || on);
  });
  if (on) watched_.push_back({case_file, folder, ""});
  Store();
}

void WatchedFolders::Look() {
  for (;;) {
    const auto begin = Clock::now();
    const std::vector<ServedFile> files = folder_.List(kMostWatched);
    TellChanges(files);
    StartWatches(files);
    const auto pause = std::max<Clock::duration>(kPause, kShare * (Clock::now() - begin));
    std::unique_lock lock(mutex_);
    if (closed_.wait_for(lock, pause, [&] { return closing_; })) return;
  }
}

void WatchedFolders::TellChanges(const std::vector<ServedFile>& files) {
  std::map<std::string, std::pair<std::uint64_t, double>> now;
  std::vector<std::string> changed;
  for (const ServedFile& f : files) {
    now[f.name] = {f.size, f.changed};
    const auto before = known_.find(f.name);
    if (before == known_.end() || before->second != now[f.name]) changed.push_back(f.name);
  }
  for (const auto& [name, about] : known_)
    if (!now.contains(name)) changed.push_back(name);
  known_ = std::move(now);
  if (std::exchange(first_, false)) return;
  if (changed.size() > kMostEvents) changed = {""};
  for (const std::string& name : changed) events_.Add({{"event", "file"}, {"file", name}});
}

void WatchedFolders::StartWatches(const std::vector<ServedFile>& files) {
  const double now =
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  const std::scoped_lock lock(mutex_);
  for (Watched& w : watched_) {
    std::string finished;
    for (const ServedFile& f : files)
      if (Below(f.name, w.folder) && now - f.changed >= kSettled)
        finished += fmt::format("{}|{}|{}\n", f.name, f.size, f.changed);
    finished = HashText(finished);
    if (finished == w.seen || jobs_.Active("watch", w.case_file)) continue;
    w.seen = finished;
    try {
      jobs_.Start({{"command", "watch"}, {"case", w.case_file}, {"folder", w.folder}});
    } catch (const std::exception& e) {
      events_.Add({{"event", "warning"}, {"text", std::string("watch: ") + e.what()}});
    }
  }
}

}  // namespace ambrig::workbench
