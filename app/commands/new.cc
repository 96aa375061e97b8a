/// ambrig new: from some numbers of a bench, and a record of it, to rig, scenario and case files.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <set>

#include "app/commands/commands.h"
#include "app/commands/new_case.h"
#include "app/commands/new_questions.h"
#include "app/commands/new_templates.h"
#include "app/commands/outputs.h"
#include "app/json/json_number.h"
#include "app/text/screen.h"
#include "core/base/atomic_file.h"
#include "core/base/toml.h"
#include "core/record/read_record.h"
#include "discovery/case/case_file.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

struct NewCommand {
  std::string name, answers, out = "bench";
  std::string body;
  std::vector<std::string> records, set, column;
  CommonOptions common;  // --json and --force of it
  bool ask = false, only_files = false, list = false;
};

double NumberOf(const BenchNumber& n, const std::string& text, const std::string& where) {
  std::size_t used = 0;
  double v = std::nan("");
  try {
    v = std::stod(text, &used);
  } catch (const std::exception&) {
    used = std::string::npos;
  }
  if (used != text.size() || !(n.lo <= v && v <= n.hi))
    throw InputError(fmt::format("{}{} = {}, allowed: {:g} to {:g} {} ({})", where, n.key, text,
                                 n.lo, n.hi, n.unit, n.doc));
  return v;
}

const BenchNumber& NumberNamed(const BenchTemplate& bench, const std::string& key,
                               const std::string& where) {
  std::string keys;
  for (const BenchNumber& n : bench.numbers) {
    if (n.key == key) return n;
    keys += (keys.empty() ? "" : ", ") + std::string(n.key);
  }
  throw InputError(fmt::format("{}\"{}\", allowed: {}", where, key, keys));
}

/// Of the answers file: numbers beside `template` and `record`.
void ReadBenchAnswers(const std::string& file, NewCommand& o, const BenchTemplate*& bench,
                      BenchAnswers& answers) {
  const TomlTable t = TomlTable::FromFile(file);
  const std::string name = t.String("template", o.name);
  if (!name.empty() && o.name.empty()) o.name = name;
  const std::vector<std::string> records = t.Has("record") && t.IsArray("record")
                                               ? t.Strings("record")
                                           : t.Has("record") ? std::vector{t.String("record")}
                                                             : std::vector<std::string>{};
  if (o.records.empty())
    for (const std::string& r : records)
      o.records.push_back((std::filesystem::path(file).parent_path() / r).string());
  if (o.name.empty()) t.Fail("template", "is missing, allowed: one of ambrig new --help");
  bench = &BenchTemplateByName(o.name);
  for (const BenchNumber& n : bench->numbers) {
    if (!t.Has(n.key)) continue;
    const double v = t.Number(n.key);
    if (!(n.lo <= v && v <= n.hi))
      t.Fail(n.key, fmt::format("= {} {}, allowed: {:g} to {:g} {} ({})", v, n.unit, n.lo, n.hi,
                                n.unit, n.doc));
    answers[std::string(n.key)] = v;
  }
  t.RejectUnknownKeys();
}

/// One line from the standard input; an end of it is a mistake of the caller's.
std::string Reply(const std::string& question) {
  fmt::print("{}", question);
  std::fflush(stdout);
  std::string line;
  if (!std::getline(std::cin, line))
    throw InputError("ambrig new --ask: the answers ended, allowed: an answer to every question");
  const auto from = line.find_first_not_of(" \t\r"), to = line.find_last_not_of(" \t\r");
  return from == std::string::npos ? "" : line.substr(from, to - from + 1);
}

void AskNumbers(const BenchTemplate& bench, BenchAnswers& answers) {
  for (const BenchNumber& n : bench.numbers) {
    if (answers.contains(n.key)) continue;
    const std::string standard =
        std::isnan(n.fallback) ? "" : fmt::format(" (nothing: {:g})", n.fallback);
    while (true) {
      const std::string text =
          Reply(fmt::format("{} [{}], {}{}: ", n.key, n.unit, n.doc, standard));
      if (text.empty() && !std::isnan(n.fallback)) break;
      try {
        answers[std::string(n.key)] = NumberOf(n, text, "");
        break;
      } catch (const InputError& e) {
        fmt::print("  {}\n", e.what());
      }
    }
  }
}

void FillIn(const BenchTemplate& bench, BenchAnswers& answers) {
  std::string missing;
  for (const BenchNumber& n : bench.numbers) {
    if (answers.contains(n.key)) continue;
    if (std::isnan(n.fallback))
      missing += fmt::format("{}{} [{}]", missing.empty() ? "" : ", ", n.key, n.unit);
    else
      answers[std::string(n.key)] = n.fallback;
  }
  if (!missing.empty())
    throw InputError(
        fmt::format("template {}: missing {}, allowed: --set KEY=NUMBER, --answers "
                    "FILE or --ask",
                    bench.name, missing));
}

/// `arguments` as if typed after ambrig.
int RunAmbrig(std::vector<std::string> arguments) {
  CLI::App app;
  Work work;
  AddCommands(app, work);
  std::reverse(arguments.begin(), arguments.end());
  app.parse(arguments);
  return work();
}

using Files = std::vector<std::pair<std::string, std::string>>;

/// How files of `folder` name the record: from there where it lies near, so that both may move
/// together.
std::string RecordName(const std::string& record, const std::filesystem::path& folder) {
  const std::string from = NameFrom(folder.string(), record);
  return from.starts_with("../..") ? std::filesystem::absolute(record).lexically_normal().string()
                                   : from;
}

/// Scenarios of the records, then the case. Returns what was taken for what.
std::vector<ColumnChoice> AddBenchRecords(const NewCommand& o, const RigParameters& rig,
                                          const std::vector<Record>& records, Files& files) {
  std::vector<BenchRecord> all;
  std::vector<ColumnChoice> taken;
  const BodySaid body = o.body == "free"   ? BodySaid::kFree
                        : o.body == "held" ? BodySaid::kHeld
                                           : BodySaid::kNothing;
  for (std::size_t k = 0; k < records.size(); ++k) {
    const Record& record = records[k];
    if (records.size() > 1) fmt::print("{}\n", o.records[k]);
    std::vector<ColumnChoice> choices = ChooseColumns(rig, record);
    for (const std::string& said : o.column) SayColumn(said, rig, record, choices);
    const double held = HoldAtDistance(rig, record, choices);
    PrintChoices(record, choices, rig);
    const std::string data = RecordName(o.records[k], o.out),
                      number = records.size() > 1 ? fmt::format("-{}", k + 1) : "";
    const std::string coils = "record" + number + ".toml", rotor = "rotor" + number + ".toml";
    for (BenchRecord& r : RecordsOf(rig, record, choices, coils, rotor, data, body)) {
      files.emplace_back(r.scenario, r.scenario == rotor
                                         ? RotorScenario(rig, record)
                                         : ScenarioOfRecord(rig, record, choices, data, held));
      all.push_back(std::move(r));
    }
    taken.insert(taken.end(), choices.begin(), choices.end());
  }
  if (all.empty())
    throw InputError(
        "no record says anything of coils or rotor, allowed: duties or set-points beside currents "
        "and positions, or a body that the currents carry");
  files.emplace_back("case.toml", CaseText(all));
  return taken;
}

/// What to do with the files that were written; 0.
int TellNext(const char* command, const std::string& file) {
  fmt::print("now: ambrig {} {}\n", command, file);
  return 0;
}

int MakeBench(NewCommand o) {
  o.common.CheckOutputs({o.answers});
  if (o.list) return ListQuestions(o.common);
  BenchAnswers answers;
  const BenchTemplate* bench = nullptr;
  if (!o.answers.empty()) ReadBenchAnswers(o.answers, o, bench, answers);
  if (o.ask && o.name.empty()) {
    for (const BenchTemplate& t : BenchTemplates()) fmt::print("  {:<10} {}\n", t.name, t.doc);
    o.name = Reply("template: ");
  }
  if (o.name.empty())
    throw InputError("--template is missing, allowed: one of ambrig new --help, or --ask");
  bench = &BenchTemplateByName(o.name);
  std::set<std::string_view> said;
  for (const std::string& s : o.set) {
    const std::size_t is = s.find('=');
    const BenchNumber& n = NumberNamed(*bench, s.substr(0, is), "--set = ");
    if (!said.insert(n.key).second)
      throw InputError(fmt::format("--set: {} is named twice, allowed: each key once", n.key));
    answers[std::string(n.key)] =
        NumberOf(n, is == std::string::npos ? "" : s.substr(is + 1), "--set: ");
  }
  if (o.ask && o.records.empty()) {
    const std::string file = Reply("file of a record (nothing: none yet): ");
    if (!file.empty()) o.records.push_back(file);
  }
  std::vector<Record> records;
  for (const std::string& file : o.records) records.push_back(ReadRecord(file));
  if (o.ask) AskNumbers(*bench, answers);
  if (o.ask && !records.empty() && o.body.empty())
    o.body = Reply(
        "does the body hover (free), or does something hold it (held)? (nothing: judged "
        "by its weight): ");
  if (!o.body.empty() && o.body != "free" && o.body != "held")
    throw InputError(fmt::format("body = \"{}\", allowed: free, held", o.body));
  FillIn(*bench, answers);
  const std::string rig_text = RigTextOf(*bench, answers);
  const RigParameters rig = ReadRigText(rig_text, "rig.toml");
  if (o.out.empty()) throw InputError("--out = \"\", allowed: a folder");
  const std::filesystem::path folder(o.out);
  Files files = {{"rig.toml", rig_text}};
  std::vector<ColumnChoice> choices;
  if (records.empty())
    files.emplace_back("levitation.toml", LevitationText(rig));
  else
    choices = AddBenchRecords(o, rig, records, files);
  std::vector<std::string> paths;
  for (const auto& [name, text] : files) paths.push_back((folder / name).string());
  RefuseOverwriting(paths, o.common.force);
  PrepareFolder(o.out);
  for (std::size_t k = 0; k < files.size(); ++k) {
    WriteMarkedText(paths[k], "new", files[k].second);
    fmt::print("written: {}\n", paths[k]);
  }
  o.common.WriteJson(BenchJson(paths, choices));
  const std::string next = records.empty() ? paths[1] : paths.back();
  if (o.only_files) return TellNext(records.empty() ? "run" : "compare", next);
  if (records.empty()) return RunAmbrig({"run", next, "--out", (folder / "out").string()});
  return RunAmbrig({"compare", next, "--html", (folder / "compare.html").string()});
}

}  // namespace

void AddNew(CLI::App& app, Work& work) {
  auto o = std::make_shared<NewCommand>();
  CLI::App* command = app.add_subcommand(
      "new", "write rig, scenario and case files from some ten numbers and records of a bench");
  std::string names;
  for (const BenchTemplate& t : BenchTemplates())
    names += (names.empty() ? "" : ", ") + std::string(t.name);
  command->add_option("--template", o->name, names);
  command->add_option("--set", o->set, "KEY=NUMBER, SI units; without: the missing keys are named");
  command->add_option("--answers", o->answers, "TOML file of keys and numbers, template, record");
  command->add_option("--record", o->records, "files of instruments (ambrig channels shows them)");
  command->add_option("--column", o->column,
                      "CHANNEL=COLUMN, also :UNIT, :UNIT:GAIN or :UNIT:GAIN:OFFSET");
  command->add_option("--body", o->body, "free: it hovers; held: something holds it");
  command->add_option("-o,--out", o->out, "folder")->capture_default_str();
  command->add_flag("--ask", o->ask, "ask for what is missing");
  command->add_flag("--only-files", o->only_files, "write the files, run nothing");
  command->add_flag("--list", o->list, "print what each template asks for; nothing is written");
  command
      ->add_option("--json", o->common.json,
                   "write the files and the columns taken, or with --list the questions, to FILE")
      ->type_name("FILE")
      ->check(OutputFile());
  command->add_flag("--force", o->common.force, kForceHelp);
  command->footer(
      "Examples:\n"
      "  ambrig new --answers examples/new/ball.toml -o ball\n"
      "  ambrig new --answers examples/new/spindle.toml -o spindle\n"
      "Writes rig, scenarios and case, says which column of a record it took for which\n"
      "channel, and compares; without a record it tells whether the rig hovers. With\n"
      "--ask it asks for what the options leave out.");
  command->callback([o, &work] { work = [o] { return MakeBench(*o); }; });
}

}  // namespace ambrig
