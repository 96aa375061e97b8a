#include "fmu/library/component.h"

#include <fmt/format.h>

#include "core/base/json_file.h"

namespace ambrig {

std::unique_ptr<FmuComponent> FmuComponent::Make(
    const std::string& resources, const std::string& token,
    std::function<void(Told, const std::string&)> tell) {
  const nlohmann::json setup = ReadJson((std::filesystem::path(resources) / "setup.json").string());
  const std::string own = setup.value("token", "");
  if (own != token)
    throw InputError(fmt::format(
        "the modelDescription.xml is of another FMU ({}) than the library ({})", token, own));
  auto made = std::make_unique<FmuComponent>();
  made->resources = resources;
  made->tell = std::move(tell);
  made->fmu = std::make_unique<FmuInstance>(resources);
  return made;
}

std::string FolderOfUri(const std::string& uri) {
  std::string rest = uri;
  if (rest.starts_with("file:")) {
    rest = rest.substr(5);
    if (rest.starts_with("//")) {
      const std::size_t path = rest.find('/', 2);  // behind an empty host or localhost
      rest = path == std::string::npos ? "" : rest.substr(path);
    }
  } else {
    return rest;
  }
  std::string out;
  for (std::size_t k = 0; k < rest.size(); ++k) {
    if (rest[k] == '%' && k + 2 < rest.size() && std::isxdigit(rest[k + 1]) &&
        std::isxdigit(rest[k + 2])) {
      out += static_cast<char>(std::stoi(rest.substr(k + 1, 2), nullptr, 16));
      k += 2;
    } else {
      out += rest[k];
    }
  }
  return out;
}

}  // namespace ambrig
