#include "app/commands/outputs.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <sstream>

#include "app/json/provenance.h"
#include "core/base/atomic_file.h"
#include "core/base/errors.h"
#include "core/base/fingerprint.h"
#include "core/base/inputs_read.h"
#include "core/base/json_file.h"
#include "core/base/read_file.h"
#include "core/record/units.h"

namespace ambrig {

namespace {

namespace fs = std::filesystem;

void RefuseNamedPipe(const std::string& path) {
  if (IsNamedPipe(path))
    throw InputError(
        fmt::format("cannot write {}: is a named pipe, allowed: a file or /dev/stdout", path));
}

/// Creates a temporary file beside the path and removes it. @throws InputError with the reason.
void TryToWrite(const std::string& path) {
  if (path.empty()) throw InputError("a file without a name, allowed: a file");
  RefuseNamedPipe(path);
  if (!IsWrittenInPlace(path)) AtomicFile probe(path);
}

bool Contains(const std::string& text, std::string_view mark) {
  return text.find(mark) != std::string::npos;
}

constexpr std::string_view kHashLine = "# hash of the lines above: ";

/// Without the hash lines of files that went into it.
std::string WithoutHashes(const std::string& text) {
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with(kHashLine)) out += line + "\n";
  return out;
}

}  // namespace

CLI::Validator NumberIn(double lo, double hi, const std::string& unit) {
  const std::string allowed =
      fmt::format("{:g} to {:g}{}{}", lo, hi, unit.empty() ? "" : " ", unit);
  return CLI::Validator(
      [lo, hi, allowed](std::string& text) {
        std::size_t used = 0;
        double value = lo - 1;
        try {
          value = std::stod(text, &used);
        } catch (const std::exception&) {
          used = std::string::npos;
        }
        return used == text.size() && value >= lo && value <= hi
                   ? std::string()
                   : fmt::format("{}, allowed: {}", text, allowed);
      },
      allowed, "NUMBER");
}

std::string SpeedIn(const std::string& text, const std::string& unit) {
  std::size_t used = 0;
  double value = 0;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    return text;
  }
  used = text.find_first_not_of(' ', used);
  if (used == std::string::npos) return text;
  const double factor = UnitFactor(text.substr(used), "rad/s", text) / UnitFactor(unit, "rad/s");
  return fmt::format("{:.15g}", value * factor);
}

CLI::Validator SpeedUnit(const std::string& unit) {
  return CLI::Validator(
      [unit](std::string& text) {
        try {
          text = SpeedIn(text, unit);
        } catch (const InputError& e) {
          return std::string(e.what());
        }
        return std::string();
      },
      "", "SPEED");
}

CLI::Validator OutputFile() {
  return CLI::Validator(
      [](std::string& path) {
        try {
          TryToWrite(path);
        } catch (const InputError& e) {
          return std::string(e.what());
        }
        return std::string();
      },
      "", "OUTPUT");
}

void PrepareFolder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder, error))
    error = std::make_error_code(std::errc::not_a_directory);
  if (error) throw InputError(fmt::format("cannot write {}: {}", folder, error.message()));
  TryToWrite((fs::path(folder) / "probe").string());
}

bool MadeByAmbrig(const std::string& file) {
  const std::string text = ReadFile(file, 4096);
  if (text.empty()) return true;  // nothing is lost
  if (fs::path(file).extension() ==
      ".csv") {  // has no room for a mark: made with the JSON beside it
    const std::string beside = fs::path(file).replace_extension(".json").string();
    std::error_code error;
    return fs::is_regular_file(beside, error) && MadeByAmbrig(beside);
  }
  if (text.starts_with("\x89HDF")) {
    const std::string whole = ReadFile(file, std::string::npos);
    return Contains(whole, "made_by") && Contains(whole, "ambrig");
  }
  for (const char* mark :
       {"name=\"generator\" content=\"ambrig", "name=\"ambrig check\"", "\"made_by\": \"ambrig"})
    if (Contains(text, mark)) return true;
  return Contains(text.substr(0, 200), "made by ambrig");
}

void WriteMarkedText(const std::string& file, const std::string& command, const std::string& text) {
  const bool marked = Contains(text.substr(0, 200), "made by ambrig");
  const std::string lines =
      (marked ? "" : "# made by ambrig " + command + "\n") + WithoutHashes(text);
  WriteFileAtomically(file, fmt::format("{}{}{}\n", lines, kHashLine, HashText(lines)));
}

bool ChangedSinceWritten(const std::string& text) {
  const auto at = text.rfind(kHashLine);
  return at == std::string::npos || text.substr(at + kHashLine.size()) !=
                                        HashText(std::string_view(text).substr(0, at)) + "\n";
}

void RefuseOverwriting(const std::vector<std::string>& files, bool force) {
  for (const std::string& file : files) RefuseNamedPipe(file);
  if (force) return;
  for (const std::string& file : files) {
    std::error_code error;
    if (!fs::is_regular_file(file, error)) continue;
    if (MadeByAmbrig(file)) {
      // Pages and JSON may hold such files as text: only what begins with a comment has a hash of
      // its own.
      if (ReadFile(file, 1) != "#" || !ChangedSinceWritten(ReadFile(file))) continue;
      throw InputError(fmt::format(
          "{} was changed since ambrig wrote it, allowed: another name, or --force to overwrite it",
          file));
    }
    throw InputError(fmt::format(
        "{} exists and is not an output of ambrig, allowed: another name, or --force to "
        "overwrite it",
        file));
  }
}

void PrepareStudyFolder(const std::string& folder, const std::vector<std::string>& files,
                        bool force) {
  PrepareFolder(folder);
  std::error_code error;
  const bool own = fs::exists(fs::path(folder) / "journal.txt", error);
  std::vector<std::string> paths;
  for (const std::string& file : files) paths.push_back((fs::path(folder) / file).string());
  RefuseOverwriting(paths, force || own);
}

void RefuseInputAsOutput(const std::string& output, const std::vector<std::string>& inputs) {
  std::error_code error;
  for (const std::string& input : inputs)
    if (!output.empty() && fs::equivalent(output, input, error))
      throw InputError(
          fmt::format("{} is read by this command, allowed: another file for its output", output));
}

void RefuseOneFileTwice(const std::vector<std::string>& outputs) {
  std::set<fs::path> seen;
  for (const std::string& file : outputs) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (file.empty() || (fs::exists(status) && !fs::is_regular_file(status))) continue;
    const fs::path whole = fs::weakly_canonical(fs::absolute(file), error);
    if (!seen.insert(error ? fs::path(file) : whole).second)
      throw InputError(fmt::format(
          "{} is named for two outputs of this command, allowed: a file for each", file));
  }
}

std::string MarkedJson(nlohmann::ordered_json document) {
  nlohmann::ordered_json marked{{"made_by", "ambrig"}, {"provenance", Provenance(InputsRead())}};
  if (document.is_array()) {
    if (!document.empty() && document[0].is_object()) {
      marked.update(document[0]);
      document[0] = marked;
    }
    return JsonText(document, 2) + "\n";
  }
  marked.update(document);
  return JsonText(marked, 2) + "\n";
}

}  // namespace ambrig
