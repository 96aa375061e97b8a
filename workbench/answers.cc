#include "workbench/answers.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/errors.h"

namespace ambrig::workbench {

using Json = nlohmann::ordered_json;

HttpResponse JsonAnswer(const Json& json, int status) {
  return {status,
          "application/json",
          json.dump(-1, ' ', false, Json::error_handler_t::replace),
          {},
          {}};
}

HttpResponse ErrorAnswer(int status, const std::string& text) {
  return JsonAnswer({{"error", text}}, status);
}

int IdOf(const std::string& path, const std::string& before) {
  const std::string digits = path.substr(std::min(path.size(), before.size()));
  if (digits.empty() || digits.size() > 8 ||
      digits.find_first_not_of("0123456789") != std::string::npos)
    return -1;
  return std::stoi(digits);
}

nlohmann::json BodyOf(const HttpRequest& r) {
  nlohmann::json body = nlohmann::json::parse(r.body, nullptr, false);
  if (!body.is_object()) throw InputError("the body is no JSON object");
  return body;
}

std::string TextIn(const nlohmann::json& body, const char* key) {
  if (!body.contains(key) || !body[key].is_string())
    throw InputError(fmt::format("{}: is missing", key));
  return body[key];
}

}  // namespace ambrig::workbench
