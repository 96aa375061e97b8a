#pragma once
/// Commands that ask the linear model of a rig (analysis/).
#include "app/commands/commands.h"

namespace ambrig {

void AddAnalyze(CLI::App& app, Work& work);
void AddValidate(CLI::App& app, Work& work);

}  // namespace ambrig
