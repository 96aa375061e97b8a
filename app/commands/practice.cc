/// ambrig practice: explain on cases whose laws are not the catalogue's, and whether its
/// probabilities are true.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <mutex>
#include <set>
#include <thread>

#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/commands/practice_plans.h"
#include "app/commands/practice_work.h"
#include "app/commands/progress.h"
#include "app/json/practice_json.h"
#include "app/pages/practice_page.h"
#include "app/text/screen.h"
#include "core/base/atomic_file.h"
#include "core/base/counted.h"
#include "core/base/json_file.h"
#include "core/base/read_file.h"
#include "core/base/toml_edit.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

constexpr std::size_t kCasesOfATrialFit = 20;  // fewer teach nothing worth showing

struct PracticeCommand {
  CommonOptions common;
  std::vector<std::string> rigs;
  std::string out = "practice-cases", shard, fit;
  PracticeSetting setting;
  int jobs = 1;
  bool make_only = false, report_only = false, plans = false;
};

PracticeRig ReadPracticeRig(const std::string& file) {
  const RigParameters rig = ReadRig(file);
  if (!rig.effects.empty())
    throw InputError(file + ": has effects of its own, allowed: a rig without");
  return {rig.name.empty() ? std::filesystem::path(file).stem().string() : rig.name, file,
          WithAbsoluteFiles(ReadFile(file), file)};
}

void PrintResult(const PracticeResult& r) {
  const bool right = r.failure.empty() && ScoreCase(r.name, r.answer, r.finding).right();
  fmt::print("{:<10} {:<8} {:>5.0f} s  {}  {}\n", r.name, r.kind, r.finding.seconds,
             right ? Coloured("right", "green") : Coloured("wrong", "red"),
             JudgeResult(r, nullptr).in_set ? "in set" : "not in set");
  fmt::print("{}\n", Wrapped("    hidden: " + HiddenText(r) +
                                 (r.mistake.empty() ? "" : " (" + r.mistake + ")"),
                             12));
  fmt::print("{}\n", Wrapped("    said:   " + SaidText(r), 12));
  std::fflush(stdout);
}

/// The pending cases on some threads; each finished one goes into the journal at once.
void WorkOff(const PracticeCommand& o, const std::vector<std::size_t>& pending) {
  const std::string path =
      (std::filesystem::path(o.out) / PracticeJournalName("journal", o.setting.shard));
  std::unique_ptr<Journal> journal;
  if (!o.make_only)
    journal = std::make_unique<Journal>(
        path, PracticeHeader(o.setting),
        JournalVisitor{[](std::string_view) {}, [](const JournalEntry&) { return true; }});
  Progress progress("practice");
  std::mutex mutex;
  std::atomic<std::size_t> next{0}, done{0};
  std::exception_ptr failure;
  const auto work = [&] {
    for (std::size_t k = next++; k < pending.size(); k = next++) {
      try {
        const PracticeResult r = RunPracticeCase(
            o.setting, pending[k], o.make_only, [&](double f, const std::string& text) {
              progress.Update((static_cast<double>(done) + f) / static_cast<double>(pending.size()),
                              text);
            });
        const std::scoped_lock lock(mutex);
        ++done;
        if (!journal) continue;
        journal->Append(JsonText(PracticeResultJson(r)));
        progress.Clear();
        PrintResult(r);
      } catch (const PracticeCaseNotMade& e) {
        const std::scoped_lock lock(mutex);
        progress.Clear();
        fmt::print(stderr, "{}\n", Wrapped(fmt::format("left out: {}", e.what()), 4));
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (!failure) failure = std::current_exception();
        next = pending.size();
      }
    }
  };
  std::vector<std::thread> threads;
  for (int k = 1; k < o.jobs; ++k) threads.emplace_back(work);
  work();
  for (std::thread& t : threads) t.join();
  if (failure) std::rethrow_exception(failure);
}

/// The source file of the fitted calibration.
std::string CalibrationSource(const CalibrationTable& table, const PracticeCommand& o) {
  std::string rigs, weights;
  for (const std::string& rig : o.rigs) rigs += " " + rig;
  for (const double w : table.weights)
    weights += fmt::format("{}{:.6g}", weights.empty() ? "" : ", ", w);
  return fmt::format(
      "/// The fitted calibration, made by ambrig practice:\n///   ambrig practice{} --cases {} "
      "--seed {} -o {} --fit FILE\n#include \"discovery/calibration/calibration.h\"\n\nnamespace "
      "ambrig {{\n\nconst CalibrationTable& StoredCalibration() {{\n  static const "
      "CalibrationTable table = {{{{{}}}, {:.6g}, {}}};\n  return table;\n}}\n\n}}  // namespace "
      "ambrig\n",
      rigs, o.setting.cases, o.setting.seed, o.out, weights, table.least, table.cases);
}

std::vector<PracticeResult> Only(const std::vector<PracticeResult>& all, bool for_fit) {
  std::vector<PracticeResult> out;
  for (const PracticeResult& r : all)
    if (r.for_fit == for_fit) out.push_back(r);
  return out;
}

void PrintPractice(const PracticeSummary& s, const char* title) {
  fmt::print("\n{}\n{:<30} {:>12} {:>14} {:>14}\n", title, "kind of case", "all right",
             "verdict right", "in 95 % set");
  const auto cell = [](const Share& x) { return fmt::format("{} of {}", x.right, x.of); };
  for (const PracticeCount& c : s.counts)
    fmt::print("{:<30} {:>12} {:>14} {:>14}\n", c.kind, cell(c.right), cell(c.verdict),
               cell(c.in_set));
  fmt::print("wrong data recognised: {}, effects named from it: {}\n", cell(s.data_recognised),
             s.named_from_wrong_data);
  fmt::print("expected calibration error: {:.3f} +- {:.3f} (by chance {:.3f})\n", s.error.value,
             s.error.sd, s.error.by_chance);
}

/// Counts, page, JSON and table of what is finished.
void ReportPractice(const PracticeCommand& o) {
  std::vector<PracticeResult> results;
  for (const auto& [name, r] : FinishedCases(o.setting)) results.push_back(r);
  if (results.empty()) throw InputError(o.out + ": holds no finished case");
  const PracticeSummary raw = Summarise(results, nullptr);
  PrintPractice(raw, "as computed");
  const std::vector<PracticeResult> fitted = Only(results, true), checked = Only(results, false);
  std::unique_ptr<PracticeSummary> calibrated;
  if (fitted.size() >= kCasesOfATrialFit && !checked.empty()) {
    const CalibrationTable table = MakeCalibration(CalibrationCases(fitted));
    calibrated = std::make_unique<PracticeSummary>(Summarise(checked, &table));
    PrintPractice(*calibrated, "calibrated with the other law families");
    if (!o.fit.empty()) WriteFileAtomically(o.fit, CalibrationSource(table, o));
    if (table.cases < kCasesForCalibration)
      fmt::print("{} fitted, fewer than {}: explain will not apply the table\n",
                 Counted(static_cast<std::size_t>(table.cases), "case"), kCasesForCalibration);
  } else if (!o.fit.empty()) {
    throw InputError(fmt::format("--fit: {} to fit with, allowed: {} or more",
                                 Counted(fitted.size(), "case"), kCasesOfATrialFit));
  }
  const std::string page = (std::filesystem::path(o.out) / "report.html").string();
  WritePracticeReport(results, raw, calibrated.get(), page);
  if (!o.common.html.empty()) WritePracticeReport(results, raw, calibrated.get(), o.common.html);
  o.common.WriteJson(PracticeJson(results, raw, calibrated.get()));
  fmt::print("written {}\n", page);
}

int RunPlans(const PracticeCommand& o) {
  try {
    PractisePlans(o.setting, o.report_only, o.common);
  } catch (const Interrupted&) {
    fmt::print(stderr, "ambrig: stopped; re-run the command to resume\n");
    return 130;
  }
  return 0;
}

int RunPractice(PracticeCommand o) {
  std::set<std::filesystem::path> rigs;
  for (const std::string& file : o.rigs) {
    std::error_code error;
    if (!rigs.insert(std::filesystem::weakly_canonical(file, error)).second)
      throw InputError(file + " is named twice, allowed: each rig once");
    if (o.report_only && !std::filesystem::is_directory(o.out, error))
      throw InputError(o.out +
                       ": no such folder, allowed with --report-only: one of ambrig practice");
  }
  for (const std::string& file : o.rigs) o.setting.rigs.push_back(ReadPracticeRig(file));
  o.setting.shard = o.shard.empty() ? Shard{} : ParseShard(o.shard);
  o.setting.folder = o.out;
  o.common.CheckOutputs(o.rigs, {o.fit});
  PrepareStudyFolder(o.out, {"answers.toml", "report.html"}, o.common.force);
  if (o.plans) return RunPlans(o);
  const auto finished = FinishedCases(o.setting);
  const auto pending = PendingCases(o.setting, finished);
  if (!o.report_only) RefuseOverwriting(FilesOfCases(o.out, pending), o.common.force);
  if (!finished.empty())
    fmt::print("{}: resumed, {} done before\n", o.out, Counted(finished.size(), "case"));
  if (!o.report_only) {
    try {
      WorkOff(o, pending);
    } catch (const Interrupted&) {
      fmt::print(stderr, "ambrig: stopped; re-run the command to resume\n");
      return 130;
    }
    JoinAnswers(o.out);
  }
  if (o.make_only)
    fmt::print("written {} and their answers in {}\nnow: ambrig score {}\n",
               Counted(pending.size(), "case"), o.out, o.out);
  else
    ReportPractice(o);
  return 0;
}

}  // namespace

void AddPractice(CLI::App& app, Work& work) {
  auto options = std::make_shared<PracticeCommand>();
  options->setting.cases = 20;
  CLI::App* command = app.add_subcommand("practice",
                                         "test the probabilities of explain on synthetic cases "
                                         "whose laws differ from the catalogue's");
  command->add_option("rig", options->rigs, "rig files without effects")->required();
  command->add_option("-o,--out", options->out, "folder of cases, journal and report.html")
      ->capture_default_str();
  command->add_option("--cases", options->setting.cases, "number of cases, of every kind in turn")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--seed", options->setting.seed, "seed of laws, sizes, noise and mistakes")
      ->check(NumberIn(0, 9e12, "(an integer)"))
      ->capture_default_str();
  command->add_option("--shard", options->shard,
                      "only part i of n of the cases, e.g. 2/4, with a journal of its own in the "
                      "same folder");
  command->add_option("-j,--jobs", options->jobs, "cases at a time; each uses all cores")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  CLI::Option* make =
      command->add_flag("--make-only", options->make_only, "write the cases, explain none");
  command->add_flag("--report-only", options->report_only, "only count what is finished")
      ->excludes(make);
  CLI::Option* fit =
      command
          ->add_option(
              "--fit", options->fit,
              "write the calibration fitted with one half of the law families to this file "
              "(discovery/calibration/calibration_table.cc of the sources)")
          ->check(OutputFile())
          ->type_name("FILE");
  command
      ->add_flag("--plans", options->plans,
                 "practise plan instead: one record of each case that hides one effect, the "
                 "record that plan proposes, and whether the right one of two names is then found")
      ->excludes(make)
      ->excludes(fit);
  options->common.AddTo(*command);
  command->footer(
      "Examples:\n"
      "  ambrig practice examples/reference/rig.toml --cases 2 --make-only -o made\n"
      "  ambrig practice examples/small_spindle/rig.toml --cases 1 -o spindle\n"
      "  ambrig practice examples/reference/rig.toml --plans --cases 100 -o plans\n"
      "Re-run the command to resume; with another --cases the same cases come first.\n"
      "Explaining a case takes half a minute to some minutes.");
  command->callback([options, &work] { work = [options] { return RunPractice(*options); }; });
}

}  // namespace ambrig
