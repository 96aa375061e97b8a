// catalogue: Planted
/// Planted by tools/planted_change.py: `ambrig planted` counts the effects of the catalogue.
#include <fmt/format.h>

#include "app/commands/commands.h"
#include "effects/catalogue.h"

namespace ambrig {

void AddPlanted(CLI::App& app, Work& work) {
  auto options = std::make_shared<CommonOptions>();
  CLI::App* command = app.add_subcommand("planted", "counts the effects of the catalogue");
  options->AddTo(*command);
  command->callback([options, &work] {
    work = [options] {
      fmt::print("{} effects\n", Catalogue().size());
      options->WriteJson({{"effects", Catalogue().size()}});
      return 0;
    };
  });
}

}  // namespace ambrig
