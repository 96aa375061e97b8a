#pragma once
/// [faults] of a campaign file: which coils fail, how and when.
#include "campaign/campaign_file.h"

namespace ambrig {

/// Fills sets, kinds, cases and times; the scenarios must be there. @throws InputError
void ReadFaults(const TomlTable& root, Campaign& c);

}  // namespace ambrig
