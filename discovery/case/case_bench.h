#pragma once
/// [[record]] of a case with kind = "frf" or "static". Format: docs/guide/files.md.
#include "core/base/toml.h"
#include "discovery/case/case.h"

namespace ambrig {

/// Frequency responses: traces of the file as responses of the rig, in SI, each point with its sd.
/// `r.data_file` is set; without a `scenario` the rig levitates at `speed`. @throws InputError
void ReadResponseRecord(const TomlTable& t, Case& c, CaseRecord& r);

/// A table of set positions and currents and what was read. Without a `scenario` what the table
/// leaves out is 0. @throws InputError
void ReadStaticRecord(const TomlTable& t, Case& c, CaseRecord& r);

}  // namespace ambrig
