/// ambrig score: explain many cases whose answers are known, and count.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>

#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/json/discovery_json.h"
#include "app/json/provenance.h"
#include "app/pages/html.h"
#include "app/text/screen.h"
#include "core/base/atomic_file.h"
#include "core/base/counted.h"
#include "core/base/inputs_read.h"
#include "discovery/practice/case_score.h"

namespace ambrig {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct ScoreCommand {
  CommonOptions common;
  std::vector<std::string> paths;
  std::string answers, output = "scored";
  bool again = false;
};

/// Folders with a case.toml, at or directly below the paths, in order.
std::vector<fs::path> CaseFolders(const std::vector<std::string>& paths) {
  std::vector<fs::path> out;
  for (const std::string& p : paths) {
    if (!fs::is_directory(p))
      throw InputError(p + ": no folder, allowed: a case's folder or one that holds such folders");
    if (fs::exists(fs::path(p) / "case.toml")) {
      out.push_back(fs::path(p).lexically_normal());
      continue;
    }
    std::vector<fs::path> inside;
    for (const auto& item : fs::directory_iterator(p))
      if (item.is_directory() && fs::exists(item.path() / "case.toml"))
        inside.push_back(item.path());
    std::sort(inside.begin(), inside.end());
    if (inside.empty()) throw InputError(p + ": holds no case.toml, nor does any folder in it");
    out.insert(out.end(), inside.begin(), inside.end());
  }
  for (fs::path& p : out)
    if (!p.has_filename()) p = p.parent_path();
  return out;
}

/// The answer of a case: from the named file, else answers.toml beside the folders, else
/// FOLDER.answer.toml.
Answer AnswerOf(const fs::path& folder, const std::string& named) {
  const std::string name = folder.filename().string();
  const fs::path own = folder.string() + ".answer.toml",
                 shared = folder.parent_path() / "answers.toml";
  const std::string file = !named.empty()    ? named
                           : fs::exists(own) ? own.string()
                                             : shared.string();
  const auto all = ReadAnswers(file);
  const auto it = all.find(name);
  if (it == all.end()) throw InputError(fmt::format("{}: no answer for {}", file, name));
  return it->second;
}

NamedEffect Named(const Json& j) {
  return {j.at("effect").get<std::string>(), j.at("target").get<std::string>()};
}

Finding FindingOf(const Json& j) {
  Finding f;
  f.verdict = j.at("verdict").get<std::string>();
  if (!j.at("ranking").empty()) f.first = Named(j.at("ranking").at(0));
  for (const Json& a : j.at("adopted")) f.adopted.push_back(Named(a));
  const auto number = [&](const char* key) {
    return j.at(key).is_number() ? j.at(key).get<double>() : kInfinity;
  };
  f.nominal_ratio = number("nominal_ratio_validate");
  f.final_ratio = number("final_ratio_validate");
  f.seconds = number("seconds");
  return f;
}

/// Whether the result's inputs are the files of the case in `folder`, as they are now.
bool IsOfCase(const Json& result, const fs::path& folder) {
  const Json inputs = result.value("/provenance/inputs"_json_pointer, Json::object());
  const fs::path of = fs::weakly_canonical(folder / "case.toml");
  bool of_case = false;
  for (const auto& [input, hash] : inputs.items()) {
    of_case = of_case || fs::weakly_canonical(input) == of;
    if (hash != FileHash(input)) return false;
  }
  return of_case;
}

/// An earlier result, if it is complete and of this case.
std::optional<Finding> Earlier(const fs::path& file, const fs::path& folder) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;  // opening a pipe would wait
  std::ifstream in(file);
  const Json j = Json::parse(in, nullptr, false);
  if (!j.is_object() || j.value("verdict", "unfinished") == "unfinished" || !IsOfCase(j, folder))
    return std::nullopt;
  return FindingOf(j);
}

/// Names of the cases: of their folders, and of the folders above where these are alike.
std::vector<std::string> CaseNames(const std::vector<fs::path>& folders) {
  std::vector<std::string> names;
  for (const fs::path& f : folders) {
    const bool alike = std::count_if(folders.begin(), folders.end(), [&](const fs::path& o) {
                         return o.filename() == f.filename();
                       }) > 1;
    const std::string above = fs::weakly_canonical(f).parent_path().filename().string();
    names.push_back((alike ? above + "-" : "") + f.filename().string());
    if (std::count(names.begin(), names.end(), names.back()) > 1)
      throw InputError(fmt::format("{}: a second case with the name {}, allowed: score them apart",
                                   f.string(), names.back()));
  }
  return names;
}

fs::path ResultOf(const ScoreCommand& o, const std::string& name) {
  return fs::path(o.output) / (name + ".json");
}

std::string Listed(const std::vector<NamedEffect>& effects, const std::string& none) {
  std::string text;
  for (const auto& [name, target] : effects)
    text += (text.empty() ? "" : " + ") + NameAtTarget(name, target);
  return text.empty() ? none : text;
}

std::string Truth(const Answer& a) {
  std::vector<NamedEffect> first;
  for (const auto& slot : a.slots) first.push_back(slot[0]);
  return Listed(first, a.verdicts.empty() ? "?" : a.verdicts[0]);
}

void PrintScoreLine(const CaseScore& j) {
  const char* mark = j.right() ? "right" : j.first_right ? "in part" : "wrong";
  const char* colour = j.right() ? "green" : j.first_right ? "yellow" : "red";
  fmt::print("{:<34} {:>9.3f} {:>9.3f} {:>6.0f} s  {}\n", Shortened(j.name, 34),
             j.finding.nominal_ratio, j.finding.final_ratio, j.finding.seconds,
             Coloured(mark, colour));
  fmt::print("{}\n", Wrapped("    hidden: " + Truth(j.answer), 12));
  fmt::print("{}\n", Wrapped("    found:  " + Listed(j.finding.adopted, j.finding.verdict), 12));
}

Json MatrixJson(const std::vector<CaseScore>& all) {
  Json cases = Json::array(), tallies = Json::array(), confusion = Json::object();
  for (const CaseScore& j : all)
    cases.push_back({{"case", j.name},
                     {"truth", Truth(j.answer)},
                     {"found", Listed(j.finding.adopted, j.finding.verdict)},
                     {"verdict", j.finding.verdict},
                     {"right", j.right()},
                     {"first_right", j.first_right},
                     {"nominal_ratio_validate", j.finding.nominal_ratio},
                     {"final_ratio_validate", j.finding.final_ratio},
                     {"seconds", j.finding.seconds}});
  for (const Tally& t : Tallies(all))
    tallies.push_back({{"kind", t.kind}, {"cases", t.cases}, {"right", t.right}});
  for (const auto& [truth, given] : Confusion(all))
    for (const auto& [name, n] : given) confusion[truth][name] = n;
  return {{"cases", cases}, {"tallies", tallies}, {"confusion", confusion}};
}

void WriteScoreReport(const std::vector<CaseScore>& all, const std::string& file) {
  HtmlReport report("Accuracy of explain",
                    Counted(all.size(), "case") +
                        (all.size() == 1 ? " with a known answer" : " with known answers"));
  report.Heading("Counts");
  std::vector<std::vector<Cell>> rows;
  for (const Tally& t : Tallies(all))
    rows.push_back({t.kind, fmt::format("{} of {}", t.right, t.cases)});
  report.Table({"kind of case", "right"}, rows);
  report.Heading("Hidden and identified effects");
  const auto confusion = Confusion(all);
  std::vector<std::string> columns, names;
  for (const auto& [truth, given] : confusion) {
    names.push_back(truth);
    for (const auto& [name, n] : given)
      if (std::find(columns.begin(), columns.end(), name) == columns.end()) columns.push_back(name);
  }
  std::sort(columns.begin(), columns.end());
  std::vector<std::vector<double>> values;
  for (const std::string& truth : names) {
    values.emplace_back();
    for (const std::string& c : columns)
      values.back().push_back(confusion.at(truth).contains(c) ? confusion.at(truth).at(c) : 0);
  }
  report.Heatmap(
      "Confusion matrix. Rows: hidden effect; columns: identified effect. Correct answers lie on "
      "the diagonal.",
      columns, names, values, "cases");
  report.Heading("Every case");
  rows.clear();
  for (const CaseScore& j : all)
    rows.push_back({j.name, Truth(j.answer), Listed(j.finding.adopted, j.finding.verdict),
                    fmt::format("{:.3f}", j.finding.nominal_ratio),
                    fmt::format("{:.3f}", j.finding.final_ratio),
                    fmt::format("{:.0f}", j.finding.seconds),
                    Cell(j.right()       ? "right"
                         : j.first_right ? "in part"
                                         : "wrong",
                         j.right()       ? "ok"
                         : j.first_right ? "warn"
                                         : "fail")});
  report.Table({"case", "hidden", "found", "error over noise, rig file", "after", "time [s]", ""},
               rows);
  report.Write(file);
}

int RunScore(const ScoreCommand& o) {
  const std::vector<fs::path> folders = CaseFolders(o.paths);
  std::vector<Answer> answers;  // all of them first: complain before hours of work
  for (const fs::path& f : folders) answers.push_back(AnswerOf(f, o.answers));
  const std::vector<std::string> names = CaseNames(folders);
  o.common.CheckOutputs({o.answers});
  PrepareFolder(o.output);
  std::vector<std::optional<Finding>> kept(folders.size());
  for (std::size_t k = 0; k < folders.size(); ++k) {
    const fs::path file = ResultOf(o, names[k]);
    if (!o.again) kept[k] = Earlier(file, folders[k]);
    if (!kept[k]) RefuseOverwriting({file.string()}, o.common.force);
  }
  const std::vector<std::string> read = InputsRead();
  std::set<std::string> inputs(read.begin(), read.end());
  std::vector<CaseScore> all;
  Progress progress("score");
  fmt::print("{:<34} {:>9} {:>9} {:>8}\n", "case", "before", "after", "time");
  fmt::print("(before, after: error over the noise of the unseen records)\n");
  for (std::size_t k = 0; k < folders.size(); ++k) {
    const std::string& name = names[k];
    std::optional<Finding>& finding = kept[k];
    if (!finding) {
      ExplainOptions options;
      options.stop = &interrupted;
      options.progress = [&](double f, const std::string& text) {
        progress.Update((static_cast<double>(k) + f) / static_cast<double>(folders.size()),
                        name + ": " + text);
      };
      ForgetInputs();  // a result names those of its own case
      const Json j = ExplainJson(Explain(ReadCase((folders[k] / "case.toml").string()), options));
      WriteFileAtomically(ResultOf(o, name).string(), MarkedJson(j));
      for (const std::string& input : InputsRead()) inputs.insert(input);
      finding = FindingOf(j);
    }
    all.push_back(ScoreCase(name, answers[k], *finding));
    progress.Clear();
    PrintScoreLine(all.back());
    std::fflush(stdout);
  }
  fmt::print("\n");
  for (const Tally& t : Tallies(all)) fmt::print("{:<60} {:>3} of {}\n", t.kind, t.right, t.cases);
  fmt::print("\nhidden -> found\n");
  for (const auto& [truth, given] : Confusion(all))
    for (const auto& [found, n] : given)
      fmt::print("  {:<24} {:<28} {:>3}{}\n", truth, found, n, truth == found ? "" : "   <-");
  for (const std::string& input : inputs) NoteInput(input);
  o.common.WriteJson(MatrixJson(all));
  if (!o.common.html.empty()) WriteScoreReport(all, o.common.html);
  return 0;
}

}  // namespace

void AddScore(CLI::App& app, Work& work) {
  auto options = std::make_shared<ScoreCommand>();
  CLI::App* command = app.add_subcommand(
      "score", "explain cases with known answers: hit rates and confusion matrix");
  command->alias("judge");  // name until version 0.1, kept for one release
  command->add_option("folder", options->paths, "folders of cases, or folders that hold them")
      ->required();
  command->add_option("--answers", options->answers,
                      "answers file; else answers.toml beside the cases or FOLDER.answer.toml");
  command
      ->add_option("-o,--out", options->output,
                   "folder for each case's result; up-to-date results are reused")
      ->capture_default_str();
  command->add_flag("--again", options->again, "explain every case anew");
  options->common.AddTo(*command);
  command->footer(
      "Examples (after ambrig hide, see its --help):\n"
      "  ambrig score practice --html matrix.html\n"
      "  ambrig score practice -o scored --again\n"
      "Re-run the command to resume an interrupted one.");
  command->callback([options, &work] { work = [options] { return RunScore(*options); }; });
}

}  // namespace ambrig
