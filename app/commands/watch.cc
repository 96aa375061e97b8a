/// ambrig watch: every new record of a folder is examined; what leaves its band is told.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "app/commands/commands.h"
#include "app/commands/event_stream.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/commands/watch_folder.h"
#include "app/pages/watch_report.h"
#include "app/text/screen.h"

namespace ambrig {

namespace {

struct WatchCommand {
  CommonOptions common;
  WatchOptions watch;
  double every = 0;  // [s]
  bool no_explain = false;
};

/// A number of an entry; what is unknown or infinite stands as null in it.
std::string EntryNumber(const nlohmann::ordered_json& e, const char* key) {
  const auto at = e.find(key);
  return at != e.end() && at->is_number() ? fmt::format("{:.2f}", at->get<double>()) : "-";
}

void PrintEntry(const nlohmann::ordered_json& e) {
  const std::string name = e["data"], state = e["state"];
  if (state == "refused") {
    fmt::print("{}\n",
               Wrapped(Coloured("refused", "red") + ": " + e["error"].get<std::string>(), 4));
    return;
  }
  fmt::print("{}\n",
             Wrapped(fmt::format("{} (as {}): error {} times the noise, {} with its own "
                                 "parameters: {}",
                                 name, e["of"].get<std::string>(), EntryNumber(e, "ratio"),
                                 EntryNumber(e, "ratio_fitted"),
                                 state == "ok" ? Coloured("within its bands", "green")
                                               : Coloured(state == "data" ? "the data are wrong"
                                                                          : "left its band",
                                                          "red")),
                     4));
  if (e.contains("data_faults"))
    for (const auto& f : e["data_faults"])
      fmt::print("{}\n", Wrapped("  " + f["text"].get<std::string>(), 4));
  for (const auto& b : e["left"])
    fmt::print("{}\n", Wrapped("  " + b["text"].get<std::string>(), 4));
  if (e.contains("explanation"))
    fmt::print("{}\n", Wrapped("  " + e["explanation"]["text"].get<std::string>(), 4));
}

/// Whether this record needs somebody.
bool IsAlarm(const nlohmann::ordered_json& entry) { return entry["state"] != "ok"; }

int OnePass(const WatchCommand& o, FolderWatch& watch) {
  int code = 0;
  Progress progress("watch");
  const auto document = [&](const std::vector<std::string>& names) {
    nlohmann::ordered_json all = watch.Document();
    all["new"] = names;
    all["alarm"] = code != 0;
    return all;
  };
  std::vector<std::string> told;
  const std::vector<std::string> names =
      watch.Pass([&](double f, const std::string& text) { progress.Update(f, text); },
                 [&](const nlohmann::ordered_json& entry) {
                   progress.Clear();
                   PrintEntry(entry);
                   if (IsAlarm(entry)) code = 1;
                   told.push_back(entry["data"]);
                   if (Events().open()) Events().Partial(document(told));
                 });
  progress.Clear();
  const nlohmann::ordered_json all = document(names);
  if (!names.empty())
    for (const nlohmann::ordered_json& w : all["warnings"])
      fmt::print("{}\n", Wrapped(Coloured("warning", "yellow") + ": " + w.get<std::string>(), 4));
  o.common.WriteJson(all);
  if (!o.common.html.empty()) WriteWatchReport(all, o.common.html);
  if (o.every <= 0 && names.empty())
    fmt::print(
        "nothing new in {}{}\n", o.watch.folder,
        all["waiting"].empty() ? "" : ", files that are still written to are left for later");
  std::fflush(stdout);
  return code;
}

int WatchFolders(WatchCommand o) {
  if (o.watch.journal.empty())
    o.watch.journal = std::filesystem::path(o.watch.case_file).replace_extension(".watch").string();
  o.watch.explain = !o.no_explain;
  o.common.CheckOutputs({o.watch.case_file, o.watch.journal});
  RefuseOneFileTwice({o.watch.journal, o.common.json, o.common.html});
  FolderWatch watch(o.watch);
  int code = OnePass(o, watch);
  const auto every = std::chrono::duration<double>(o.every);
  while (o.every > 0 && !interrupted) {
    const auto begin = std::chrono::steady_clock::now();
    while (!interrupted && std::chrono::steady_clock::now() - begin < every)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    if (!interrupted) code = std::max(code, OnePass(o, watch));
  }
  return code;
}

}  // namespace

void AddWatch(CLI::App& app, Work& work) {
  auto o = std::make_shared<WatchCommand>();
  CLI::App* command = app.add_subcommand(
      "watch", "examine every new record of a folder and report what left its band");
  command->add_option("case", o->watch.case_file, "case file (TOML) of the rig as it is known")
      ->required();
  command->add_option("folder", o->watch.folder, "folder that a logger writes records to")
      ->required();
  command
      ->add_option("--journal", o->watch.journal,
                   "what was examined (default: the case's name with .watch)")
      ->type_name("FILE");
  command
      ->add_option("--settle", o->watch.settle,
                   "a file that changed less than this ago is left for the next time [s]")
      ->check(NumberIn(0, 86400, "s"))
      ->capture_default_str();
  command->add_option("--every", o->every, "go on until Ctrl-C and look again after this time [s]")
      ->check(NumberIn(0.1, 86400, "s"));
  command->add_option("--candidates", o->watch.candidates, "effects fitted in full per round")
      ->capture_default_str()
      ->check(CLI::Range(1, 60));
  command->add_flag("--no-explain", o->no_explain, "do not look for the effect behind a change");
  o->common.AddTo(*command);
  command->footer(
      "Examples:\n"
      "  ambrig watch practice/case.toml logger --json watch.json --html trend.html\n"
      "  ambrig watch practice/case.toml logger --no-explain --journal fast.watch\n"
      "For cron: exit code 1 when a new record left its band, has wrong data or was\n"
      "refused; with --every it goes on by itself. A file of the folder repeats the\n"
      "record of the case whose name its own begins with: hover-0412.csv repeats\n"
      "hover.csv; with a case of one record every file does. docs/guide/watch.md.");
  command->callback([o, &work] { work = [o] { return WatchFolders(*o); }; });
}

}  // namespace ambrig
