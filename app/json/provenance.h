#pragma once
/// Where a JSON answer comes from: the build, the command line, and every input file with its hash,
/// so that a reader can tell whether the answer is still that of the files.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace ambrig {

/// The command line, as main was given it, for the provenance of all answers.
void SetCommandLine(int argc, char** argv);

/// 16 hexadecimal digits of a file's bytes (FNV-1a, 64 bits); empty when it cannot be read.
std::string FileHash(const std::string& path);

/// { "build", "argv", "inputs": { file: hash } } with files as this process named them.
nlohmann::ordered_json Provenance(const std::vector<std::string>& inputs);

}  // namespace ambrig
