/// kind = "fmu": a controller that is a Functional Mock-up Unit for co-simulation.
#include <filesystem>

#include "control/external/fmu_controller.h"
#include "core/base/toml_checked.h"

namespace ambrig {

namespace {

void ReadFmu(const TomlTable& t, const ControllerNames&, ControllerParameters& c) {
  auto settings = std::make_shared<FmuSettings>();
  settings->file = std::filesystem::absolute(ExistingFile(t, "file")).string();
  ReadExternal(t, "file", *settings);
  if (const auto names = t.Table("variables"))
    for (const std::string& key : names->Keys()) settings->variables[key] = names->String(key);
  OpenFmu(*settings);
  c.own = std::move(settings);
}

std::unique_ptr<PositionController> MakeFmu(const ControllerParameters& c,
                                            const ControllerSite& site) {
  FmuSettings settings = dynamic_cast<const FmuSettings&>(*c.own);
  settings.library = WriteFmuBinding(settings, site);
  return std::make_unique<ExternalController>(settings, site);
}

}  // namespace

const ControllerKind& FmuKind() {
  static constexpr ControllerKind kind{
      .name = "fmu",
      .doc = "a controller that is an FMU (FMI 2.0 or 3.0, co-simulation)",
      .read = ReadFmu,
      .make = MakeFmu,
  };
  return kind;
}

}  // namespace ambrig
