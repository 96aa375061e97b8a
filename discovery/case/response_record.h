#pragma once
/// [[record]] of a case with kind = "frf". Format: docs/guide/files.md.
#include "core/base/toml.h"
#include "discovery/case/case.h"

namespace ambrig {

/// Frequency responses: traces of the file as responses of the rig, in SI, each point with its sd.
/// `r.data_file` is set; without a `scenario` the rig levitates at `speed`. @throws InputError
void ReadResponseRecord(const TomlTable& t, Case& c, CaseRecord& r);

}  // namespace ambrig
