#include "workbench/job_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/base/errors.h"
#include "core/base/fingerprint.h"
#include "core/base/toml_edit.h"
#include "workbench/job_commands.h"
#include "workbench/references.h"

namespace ambrig::workbench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kLargestScenario = 1 << 20;  // [bytes]

/// A name of the catalogue or of a target: nothing that an option or a path could be.
bool IsPlainName(const std::string& text) {
  return !text.empty() && text.size() <= 80 && text.front() != '-' &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) {
           return std::isalnum(c) || c == '-' || c == '_' || c == '.' || c == '@';
         });
}

[[noreturn]] void RefuseValue(const JobArgument& a, const char* allowed) {
  throw InputError(fmt::format("{}: allowed: {}", a.key, allowed));
}

const JobCommand& CommandOf(const json& request) {
  std::string names;
  for (const JobCommand& c : JobCommands()) {
    if (request.is_object() && request.value("command", json()) == c.name) return c;
    names += (names.empty() ? "" : ", ") + std::string(c.name);
  }
  throw InputError("command: allowed: " + names);
}

/// Builds the order, argument by argument.
class OrderMaker {
 public:
  OrderMaker(const ServedFolder& folder, const std::string& job_folder)
      : folder_(folder), job_folder_(job_folder) {}

  void Add(const JobArgument& a, const json& value) {
    if (a.kind == ArgumentKind::kColumns) return Columns(a, value);
    const std::string text = TextOf(a, value);
    if (order.subject.empty()) order.subject = subject_.empty() ? text : subject_;
    if (*a.option != '\0') order.arguments.push_back(a.option);
    order.arguments.push_back(text);
  }

  /// What equal orders share: named by the command, the subject and the text of all that it names.
  std::string Work() const {
    return ".ambrig/work/" + order.command + "-" + HashText(order.subject + read_);
  }

  JobOrder order;

 private:
  std::string TextOf(const JobArgument& a, const json& value) {
    switch (a.kind) {
      case ArgumentKind::kNumber:
        return Number(a, value);
      case ArgumentKind::kRun:
        return RunRecord(a, value);
      case ArgumentKind::kNumbers:
        return Numbers(a, value);
      case ArgumentKind::kScenario:
        return OwnScenario(a, value);
      default:
        break;
    }
    if (!value.is_string()) RefuseValue(a, a.kind == ArgumentKind::kName ? "a name" : "a file");
    const std::string name = value;
    switch (a.kind) {
      case ArgumentKind::kFile:
        return File(name);
      case ArgumentKind::kNewFile:
        return NewFile(name);
      case ArgumentKind::kFolder:
        return Folder(a, name, true);
      case ArgumentKind::kNewFolder:
        return Folder(a, name, false);
      default:
        break;
    }
    if (!IsPlainName(name)) RefuseValue(a, "letters, digits, - _ . @");
    return name;
  }

  std::string File(const std::string& name) {
    for (const auto& [file, text] : FilesNamedBy(folder_, name)) read_ += file + '\n' + text;
    return name;
  }

  std::string NewFile(const std::string& name) {
    if (!IsServedName(name) || !name.ends_with(".toml"))
      throw InputError(fmt::format("{}: allowed: a new .toml file in the served folder", name));
    if (folder_.Has(name)) throw InputError(fmt::format("{}: exists, allowed: another name", name));
    order.new_files.push_back(name);
    return name;
  }

  std::string Folder(const JobArgument& a, const std::string& name, bool there) const {
    if (!IsServedName(name + "/x.toml") || name.ends_with('/'))
      RefuseValue(a, "a folder of the served folder");
    const bool found = folder_.HasFolder(name);
    if (there && !found) throw InputError(fmt::format("{}: there is no such folder", name));
    if (!there &&
        fs::symlink_status(fs::path(folder_.path()) / name).type() != fs::file_type::not_found)
      throw InputError(fmt::format("{}: exists, allowed: another name", name));
    return name;
  }

  static std::string Number(const JobArgument& a, const json& value) {
    if (!value.is_number_integer() || value.get<long long>() < 0 || value.get<long long>() > 100000)
      RefuseValue(a, "0 to 100000");
    return std::to_string(value.get<long long>());
  }

  /// The record of a job that ran a scenario.
  std::string RunRecord(const JobArgument& a, const json& value) const {
    const std::string folder = fmt::format(".ambrig/jobs/{}/run", Number(a, value));
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(fs::path(folder_.path()) / folder, error))
      if (entry.path().extension() == ".h5") return folder + "/" + entry.path().filename().string();
    RefuseValue(a, "the number of a job that ran a scenario");
  }

  /// Keys and numbers as the answers file of `ambrig new`.
  std::string Numbers(const JobArgument& a, const json& value) {
    if (!value.is_object() || value.size() > 100) RefuseValue(a, "keys and numbers");
    std::string text;
    for (const auto& [key, number] : value.items()) {
      if (!IsPlainName(key) || key.find_first_of(".@-") != std::string::npos ||
          !number.is_number() || !std::isfinite(number.get<double>()))
        RefuseValue(a, "keys and numbers");
      text += key + " = " + TomlNumber(number.get<double>()) + "\n";
    }
    order.texts.emplace_back("answers.toml", text);
    return job_folder_ + "/answers.toml";
  }

  void Columns(const JobArgument& a, const json& value) {
    if (!value.is_object() || value.size() > 500) RefuseValue(a, "channels and their columns");
    for (const auto& [channel, column] : value.items()) {
      if (!IsPlainName(channel) || !column.is_string()) RefuseValue(a, "channels and columns");
      const std::string text = column;
      if (text.size() > 300 ||
          std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < 0x20; }))
        RefuseValue(a, "the name of a column");
      order.arguments.push_back(a.option);
      order.arguments.push_back(channel + "=" + text);
    }
  }

  /// A scenario that stands in the job's folder as if beside another one.
  std::string OwnScenario(const JobArgument& a, const json& value) {
    if (!value.is_object() || !value.contains("beside") || !value["beside"].is_string() ||
        !value.contains("text") || !value["text"].is_string())
      RefuseValue(a, "{beside, text}");
    const std::string beside = value["beside"], text = value["text"];
    if (text.size() > kLargestScenario) RefuseValue(a, "a text of less than 1 MiB");
    if (!IsServedName(beside) || !beside.ends_with(".toml")) RefuseValue(a, "a scenario's name");
    const std::string leaf = fs::path(beside).filename().string();
    const std::string file = job_folder_ + "/" + leaf;
    order.texts.emplace_back(leaf, MovedText(folder_, text, beside, file));
    subject_ = beside;
    return file;
  }

  const ServedFolder& folder_;
  const std::string job_folder_;
  std::string read_, subject_;
};

}  // namespace

JobOrder CheckJob(const json& request, const ServedFolder& folder, const std::string& job_folder) {
  const JobCommand& command = CommandOf(request);
  OrderMaker maker(folder, job_folder);
  maker.order.command = command.name;
  maker.order.heavy = command.heavy;
  maker.order.events = command.events;
  maker.order.json = command.json;
  maker.order.key = request.dump(-1, ' ', false, json::error_handler_t::replace);
  maker.order.arguments.push_back(command.command);
  for (const auto& [key, value] : request.items())
    if (key != "command" && std::none_of(command.arguments.begin(), command.arguments.end(),
                                         [&k = key](const JobArgument& a) { return k == a.key; }))
      throw InputError(fmt::format("{}: is no argument of {}", key, command.name));
  for (const JobArgument& a : command.arguments) {
    if (request.contains(a.key))
      maker.Add(a, request[a.key]);
    else if (a.required)
      throw InputError(fmt::format("{}: is missing", a.key));
  }
  for (std::string added : command.added) {
    if (added.starts_with("JOB/")) added = job_folder + added.substr(3);
    if (added == "WORK") added = maker.Work();
    maker.order.arguments.push_back(added);
  }
  return maker.order;
}

}  // namespace ambrig::workbench
