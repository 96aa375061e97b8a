#pragma once
/// The files that this process read as inputs, in the order of their first reading:
/// the provenance of what it writes. Thread-safe.
#include <string>
#include <vector>

namespace ambrig {

/// Told by the readers of TOML files and of records.
void NoteInput(const std::string& path);

/// All that were noted since the process began or forgot them.
std::vector<std::string> InputsRead();

/// Before the inputs of another result are read.
void ForgetInputs();

}  // namespace ambrig
