#include "campaign/commissioned_plants.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "core/base/atomic_file.h"
#include "core/base/errors.h"
#include "fdd/learning/commissioning_file.h"
#include "simulation/commissioning/commission.h"

namespace ambrig {

CommissionedPlants::CommissionedPlants(const Campaign& campaign) : campaign_(campaign) {
  std::string folder = (std::filesystem::temp_directory_path() / "ambrig-plants-XXXXXX").string();
  if (!mkdtemp(folder.data()))
    throw InputError(
        fmt::format("{}: no folder for the plants' commissioning can be made, allowed: "
                    "another TMPDIR",
                    folder));
  folder_ = folder;
  for (std::size_t k = 0; k < campaign.plants.size(); ++k)
    entries_.push_back(std::make_unique<Entry>());
}

CommissionedPlants::~CommissionedPlants() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

std::string CommissionedPlants::Commissioned(std::size_t plant) const {
  RigParameters rig = campaign_.rig;
  ApplyPlant(campaign_.plants[plant], &rig);
  try {
    CommissioningOptions options;
    options.plan = campaign_.commissioning;
    const CommissioningResult result = Commission(rig, options);
    const std::string file = fmt::format("{}/{}.commissioning.toml", folder_, plant);
    WriteFileAtomically(file, CommissioningText(result.model));
    return file;
  } catch (const InputError&) {
    return "";
  }
}

std::string CommissionedPlants::FileOf(std::size_t plant) {
  Entry& entry = *entries_.at(plant);
  std::call_once(entry.once, [&] { entry.file = Commissioned(plant); });
  return entry.file;
}

}  // namespace ambrig
