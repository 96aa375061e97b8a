#include "app/commands/practice_plans.h"

#include <fmt/format.h>

#include <filesystem>

#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/text/screen.h"
#include "core/base/json_file.h"
#include "core/record/hdf5.h"
#include "discovery/plan/promise_trial.h"

namespace ambrig {

namespace {

using Json = nlohmann::ordered_json;

const char* const kPlans = "plans";  // the journals' name

Json TrialJson(const PromiseTrial& t) {
  return {{"name", t.name},         {"rig", t.rig},         {"law", t.law},
          {"right", t.right},       {"other", t.other},     {"record", t.record},
          {"before", t.before},     {"promise", t.promise}, {"after", t.after},
          {"left_out", t.left_out}, {"found", t.found()}};
}

PromiseTrial TrialOf(const Json& j) {
  PromiseTrial t;
  for (const auto& [key, text] : {std::pair{"name", &t.name},
                                  {"rig", &t.rig},
                                  {"law", &t.law},
                                  {"right", &t.right},
                                  {"other", &t.other},
                                  {"record", &t.record},
                                  {"left_out", &t.left_out}})
    *text = j.at(key).get<std::string>();
  t.before = j.at("before").get<double>();
  t.promise = j.at("promise").get<double>();
  t.after = j.at("after").get<double>();
  return t;
}

void PrintTrial(const PromiseTrial& t) {
  if (!t.left_out.empty()) {
    fmt::print("{}\n", Wrapped(fmt::format("{:<10} no pair: {}", t.name, t.left_out), 11));
  } else {
    fmt::print("{:<10} {}  promised {:.3f}, share {:.3f} -> {:.3f}\n", t.name,
               t.found() ? Coloured("found", "green") : Coloured("not found", "red"), t.promise,
               t.before, t.after);
    fmt::print("{}\n", Wrapped(fmt::format("    {} or {}: {}", t.right, t.other, t.record), 6));
  }
  std::fflush(stdout);
}

void ReportTrials(const std::vector<PromiseTrial>& trials, const CommonOptions& common) {
  Json bins = Json::array(), all = Json::array();
  fmt::print("\n{:<16} {:>10} {:>22}\n", "promised", "found", "share, 95 % interval");
  for (const PromiseBin& b : PromisesKept(trials)) {
    fmt::print("{:<16} {:>10} {:>22}\n",
               fmt::format("{:.0f} to {:.0f} %", 100 * b.from, 100 * b.to),
               fmt::format("{} of {}", b.found.right, b.found.of),
               b.found.of > 0
                   ? fmt::format("{:.3f} ({:.3f} to {:.3f})", b.found.value, b.found.lo, b.found.hi)
                   : "-");
    bins.push_back({{"from", b.from},
                    {"to", b.to},
                    {"found", b.found.right},
                    {"of", b.found.of},
                    {"lo", b.found.lo},
                    {"hi", b.found.hi}});
  }
  for (const PromiseTrial& t : trials) all.push_back(TrialJson(t));
  common.WriteJson({{"promises", bins}, {"trials", all}});
}

/// The planned record beside the case, and a case of both records.
void WriteNextRecord(const PracticeCase& made, std::size_t first, PlannedRecord planned,
                     const std::filesystem::path& folder) {
  const std::string stem = (folder / "next_record").string();
  WriteMarkedText(stem + ".toml", "practice", planned.scenario);
  planned.measured.attributes["made_by"] = "ambrig practice";
  WriteHdf5(planned.measured, stem + ".h5");
  const std::string head = made.case_text.substr(0, made.case_text.find("[[record]]"));
  WriteMarkedText(
      (folder / "case_with_next.toml").string(), "practice",
      fmt::format("{}[[record]]\nscenario = \"record-{}.toml\"\ndata = \"record-{}.h5\"\n\n"
                  "[[record]]  # planned\nscenario = \"next_record.toml\"\ndata = "
                  "\"next_record.h5\"\n",
                  head, first + 1, first + 1));
}

PromiseTrial RunTrial(const PracticeSetting& setting, std::size_t number, Progress& progress) {
  progress.Update(0, "making " + NameOfPracticeCase(number));
  const PracticeCase made = MakePracticeCase(setting.rigs, setting.seed, number, &interrupted);
  WritePracticeCase(made, setting.folder);
  PromiseOptions options;
  options.seed = setting.seed * 100003 + number;
  options.first = number % made.records.size();
  options.stop = &interrupted;
  options.progress = [&](double f, const std::string& text) {
    progress.Update(f, made.name + ": " + text);
  };
  const auto folder = std::filesystem::path(setting.folder) / made.name;
  PromiseTrial trial = TryPromise(made, ReadCase(folder.string()), options);
  if (trial.planned) WriteNextRecord(made, options.first, std::move(*trial.planned), folder);
  trial.planned.reset();  // it stands in the folder now
  return trial;
}

/// An error (no draw of the law shows on its rig, no fit holds the rotor) leaves the case out.
PromiseTrial TrialOrError(const PracticeSetting& setting, std::size_t number, Progress& progress) {
  try {
    return RunTrial(setting, number, progress);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& e) {
    PromiseTrial none;
    none.name = NameOfPracticeCase(number);
    none.left_out = e.what();
    return none;
  }
}

}  // namespace

void PractisePlans(const PracticeSetting& setting, bool report_only, const CommonOptions& common) {
  const std::string header = PracticeHeader(setting) + " plans";
  std::map<std::string, PromiseTrial> finished;
  ReadPracticeJournals(setting, kPlans, header, [&](const Json& json) {
    PromiseTrial t = TrialOf(json);
    finished[t.name] = std::move(t);
  });
  const auto path =
      std::filesystem::path(setting.folder) / PracticeJournalName(kPlans, setting.shard);
  std::vector<PromiseTrial> trials;
  Progress progress("practice of plans");
  std::size_t place = 0;  // among the cases that hide one effect
  for (std::size_t number = 0; place < setting.cases; ++number) {
    if (KindOfPracticeCase(number) != "one") continue;
    const bool mine = setting.shard.Has(place++) && !report_only;
    const auto known = finished.find(NameOfPracticeCase(number));
    if (known != finished.end()) {
      trials.push_back(known->second);
    } else if (mine) {
      trials.push_back(TrialOrError(setting, number, progress));
      Journal(path.string(), header,
              {[](std::string_view) {}, [](const JournalEntry&) { return true; }})
          .Append(JsonText(TrialJson(trials.back())));
      progress.Clear();
      PrintTrial(trials.back());
    }
  }
  if (trials.empty()) throw InputError(setting.folder + ": holds no finished plan");
  ReportTrials(trials, common);
}

}  // namespace ambrig
