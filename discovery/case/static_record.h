#pragma once
/// [[record]] of a case with kind = "static". Format: docs/guide/files.md.
#include "core/base/toml.h"
#include "discovery/case/case.h"

namespace ambrig {

/// A table of set positions and currents and what was read. Without a `scenario` what the table
/// leaves out is 0. @throws InputError
void ReadStaticRecord(const TomlTable& t, Case& c, CaseRecord& r);

}  // namespace ambrig
