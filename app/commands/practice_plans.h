#pragma once
/// The work behind `ambrig practice --plans`: is the right one of two names found with the record
/// that `plan` proposes as often as it promises?
#include "app/commands/command_line.h"
#include "app/commands/commands.h"
#include "app/commands/practice_work.h"

namespace ambrig {

/// The first `setting.cases` cases that hide one effect; finished ones are in plans.txt of the
/// folder. Prints every one and the promises kept. @throws Interrupted, InputError
void PractisePlans(const PracticeSetting& setting, bool report_only, const CommonOptions& common);

}  // namespace ambrig
