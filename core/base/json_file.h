#pragma once
/// JSON as a file and as text.
#include <nlohmann/json.hpp>
#include <string>

namespace ambrig {

/// @throws InputError "FILE:LINE:COLUMN: not valid JSON", or why the file cannot be read.
nlohmann::json ReadJson(const std::string& file);

/// As text. Names of files and channels come as the system or an instrument gives them: bytes that
/// are no UTF-8 become U+FFFD.
template <class Json>
std::string JsonText(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace ambrig
