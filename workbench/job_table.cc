#include "workbench/job_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/errors.h"

namespace ambrig::workbench {
namespace {

enum class Kind { kFile, kNewFile, kName, kNumber, kFlag };

/// One argument: its key in the request, its option ("" for a positional one), what it may be.
struct Argument {
  const char *key, *option;
  Kind kind;
  bool required = false;
};

/// What the server adds itself: JOB stands for the job's folder.
struct Command {
  const char* name;
  bool heavy;
  std::vector<Argument> arguments;
  std::vector<const char*> added;
};

const std::vector<Command>& Table() {
  static const std::vector<Command> table = {
      {"compare",
       false,
       {{"case", "", Kind::kFile, true}},
       {"--series", "JOB/series.h5", "--html", "JOB/report.html"}},
      {"explain",
       true,
       {{"case", "", Kind::kFile, true}, {"candidates", "--candidates", Kind::kNumber}},
       {"--resume", "JOB/work", "--html", "JOB/report.html"}},
      {"adopt",
       false,
       {{"case", "", Kind::kFile, true},
        {"effect", "", Kind::kName, true},
        {"target", "--target", Kind::kName},
        {"rig", "--output", Kind::kNewFile, true},
        {"new_case", "--case", Kind::kNewFile, true}},
       {"--html", "JOB/report.html"}},
      {"refine",
       true,
       {{"case", "", Kind::kFile, true},
        {"effect", "", Kind::kName, true},
        {"rig", "--output", Kind::kNewFile, true}},
       {"--html", "JOB/report.html"}},
      {"plan",
       true,
       {{"case", "", Kind::kFile, true}, {"scenario", "--output", Kind::kNewFile, true}},
       {"--html", "JOB/report.html"}},
      {"run", false, {{"scenario", "", Kind::kFile, true}}, {"--out", "JOB/run", "--quiet"}},
      {"campaign",
       true,
       {{"campaign", "", Kind::kFile, true}, {"jobs", "--jobs", Kind::kNumber}},
       {"--out", "JOB/campaign"}},
      {"rig", false, {{"rig", "", Kind::kFile, true}}, {}},
      {"diff", false, {{"a", "", Kind::kFile, true}, {"b", "", Kind::kFile, true}}, {}},
  };
  return table;
}

/// A name of the catalogue or of a target: nothing that an option or a path could be.
bool IsPlainName(const std::string& text) {
  return !text.empty() && text.size() <= 80 && text.front() != '-' &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) {
           return std::isalnum(c) || c == '-' || c == '_' || c == '.' || c == '@';
         });
}

std::string FileArgument(const Argument& a, const nlohmann::json& value,
                         const ServedFolder& folder) {
  if (!value.is_string()) throw InputError(fmt::format("{}: allowed: a file", a.key));
  const std::string name = value;
  if (a.kind == Kind::kNewFile) {
    if (!IsServedName(name) || !name.ends_with(".toml"))
      throw InputError(fmt::format("{}: allowed: a new .toml file in the served folder", name));
    if (folder.Has(name)) throw InputError(fmt::format("{}: exists, allowed: another name", name));
    return name;
  }
  RefuseOutside(folder, name);
  return name;
}

std::string TextOf(const Argument& a, const nlohmann::json& value, const ServedFolder& folder) {
  if (a.kind == Kind::kFile || a.kind == Kind::kNewFile) return FileArgument(a, value, folder);
  if (a.kind == Kind::kNumber) {
    if (!value.is_number_integer() || value.get<long long>() < 0 || value.get<long long>() > 100000)
      throw InputError(fmt::format("{}: allowed: 0 to 100000", a.key));
    return std::to_string(value.get<long long>());
  }
  if (!value.is_string() || !IsPlainName(value))
    throw InputError(fmt::format("{}: allowed: letters, digits, - _ . @", a.key));
  return value;
}

const Command& CommandOf(const nlohmann::json& request) {
  std::string names;
  for (const Command& c : Table()) {
    if (request.is_object() && request.value("command", nlohmann::json()) == c.name) return c;
    names += (names.empty() ? "" : ", ") + std::string(c.name);
  }
  throw InputError("command: allowed: " + names);
}

}  // namespace

JobOrder CheckJob(const nlohmann::json& request, const ServedFolder& folder,
                  const std::string& job_folder) {
  const Command& command = CommandOf(request);
  JobOrder order;
  order.command = command.name;
  order.heavy = command.heavy;
  order.arguments.push_back(command.name);
  for (const auto& [key, value] : request.items())
    if (key != "command" && std::none_of(command.arguments.begin(), command.arguments.end(),
                                         [&k = key](const Argument& a) { return k == a.key; }))
      throw InputError(fmt::format("{}: is no argument of {}", key, command.name));
  for (const Argument& a : command.arguments) {
    if (!request.contains(a.key)) {
      if (a.required) throw InputError(fmt::format("{}: is missing", a.key));
      continue;
    }
    const std::string text = TextOf(a, request[a.key], folder);
    if (order.subject.empty()) order.subject = text;
    if (a.kind == Kind::kNewFile) order.new_files.push_back(text);
    if (*a.option != '\0') order.arguments.push_back(a.option);
    order.arguments.push_back(text);
  }
  for (std::string added : command.added) {
    if (added.starts_with("JOB/")) added = job_folder + added.substr(3);
    order.arguments.push_back(added);
  }
  return order;
}

}  // namespace ambrig::workbench
