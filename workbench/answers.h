#pragma once
/// Parts of answers and of requests.
#include <nlohmann/json.hpp>
#include <string>

#include "workbench/http_message.h"

namespace ambrig::workbench {

HttpResponse JsonAnswer(const nlohmann::ordered_json& json, int status = 200);
HttpResponse ErrorAnswer(int status, const std::string& text);

/// The number behind `before` of a path; -1: none.
int IdOf(const std::string& path, const std::string& before);
/// @throws InputError when it is no JSON object
nlohmann::json BodyOf(const HttpRequest& request);
/// @throws InputError when it is missing or no text
std::string TextIn(const nlohmann::json& body, const char* key);

}  // namespace ambrig::workbench
