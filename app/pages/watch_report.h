#pragma once
/// The trend page of `ambrig watch`: floors, closure and every fitted parameter over the records.
#include <nlohmann/json.hpp>
#include <string>

namespace ambrig {

/// Of the command's JSON. @throws InputError when it cannot be written
void WriteWatchReport(const nlohmann::ordered_json& document, const std::string& path);

}  // namespace ambrig
