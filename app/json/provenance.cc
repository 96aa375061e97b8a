#include "app/json/provenance.h"

#include <filesystem>
#include <set>

#include "core/base/build_id.h"
#include "core/base/errors.h"
#include "core/base/fingerprint.h"
#include "core/base/read_file.h"

namespace ambrig {
namespace {

std::vector<std::string>& CommandLine() {
  static std::vector<std::string> line;
  return line;
}

}  // namespace

void SetCommandLine(int argc, char** argv) { CommandLine().assign(argv, argv + argc); }

std::string FileHash(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return "";
  try {
    return HashText(ReadFile(path));
  } catch (const InputError&) {
    return "";
  }
}

nlohmann::ordered_json Provenance(const std::vector<std::string>& inputs) {
  // By name: threads read in any order, and the same work writes the same bytes.
  const std::set<std::string> sorted(inputs.begin(), inputs.end());
  nlohmann::ordered_json hashes = nlohmann::ordered_json::object();
  for (const std::string& file : sorted) hashes[file] = FileHash(file);
  return {{"build", BuildId()}, {"argv", CommandLine()}, {"inputs", hashes}};
}

}  // namespace ambrig
