#pragma once
/// What `ambrig new` asks and what it answers, for programs that ask in its place.
#include "app/commands/commands.h"
#include "app/commands/new_columns.h"

namespace ambrig {

/// Prints what each template asks for, and writes it as JSON where that is asked for. Returns the
/// exit code.
int ListQuestions(const CommonOptions& common);

/// The files written and the columns taken.
nlohmann::ordered_json BenchJson(const std::vector<std::string>& files,
                                 const std::vector<ColumnChoice>& choices);

}  // namespace ambrig
