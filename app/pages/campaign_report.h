#pragma once
/// The report of a campaign: who stays up where, how fast faults are seen, the worst runs with the
/// command that repeats each, and what the sets carry against theory.
#include "campaign/journal.h"

namespace ambrig {

/// @throws InputError when it cannot be written.
void WriteCampaignReport(const JournalHeader& header, const Rows& rows, const std::string& path);

}  // namespace ambrig
