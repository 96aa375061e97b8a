/// kind = "library": a controller in C, a shared library that runs in a process of its own.
#include <filesystem>

#include "control/external/external_controller.h"
#include "core/base/toml_checked.h"

namespace ambrig {

namespace {

void ReadLibrary(const TomlTable& t, const ControllerNames&, ControllerParameters& c) {
  auto settings = std::make_shared<ExternalSettings>();
  settings->library = std::filesystem::absolute(ExistingFile(t, "file")).string();
  ReadExternal(t, "file", *settings);
  c.own = std::move(settings);
}

std::unique_ptr<PositionController> MakeLibrary(const ControllerParameters& c,
                                                const ControllerSite& site) {
  return std::make_unique<ExternalController>(dynamic_cast<const ExternalSettings&>(*c.own), site);
}

void DocumentLibrary(std::vector<ParameterRow>& rows) {
  AddRows(rows, "[controller] kind = \"library\", \"socket\" and \"fmu\"", kExternalFields);
}

}  // namespace

const ControllerKind& LibraryKind() {
  static constexpr ControllerKind kind{
      .name = "library",
      .doc = "a controller in C, a shared library",
      .read = ReadLibrary,
      .make = MakeLibrary,
      .document = DocumentLibrary,
  };
  return kind;
}

}  // namespace ambrig
