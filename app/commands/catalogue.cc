/// The commands of `ambrig` in the order of its help: one line per command, which lives in a file
/// of this folder. Its function adds the options to the command line and sets the work.
#include "app/commands/command.h"

#define AMBRIG_COMMANDS(COMMAND) \
  COMMAND(Tour)                  \
  COMMAND(New)                   \
  COMMAND(Run)                   \
  COMMAND(Check)                 \
  COMMAND(Diff)                  \
  COMMAND(Campaign)              \
  COMMAND(Merge)                 \
  COMMAND(Detectors)             \
  COMMAND(Commission)            \
  COMMAND(Paper)                 \
  COMMAND(Crosscheck)            \
  COMMAND(Rig)                   \
  COMMAND(Rotor)                 \
  COMMAND(Design)                \
  COMMAND(Redistribute)          \
  COMMAND(Export)                \
  COMMAND(Analyze)               \
  COMMAND(Validate)              \
  COMMAND(Effects)               \
  COMMAND(Parameters)            \
  COMMAND(Channels)              \
  COMMAND(Compare)               \
  COMMAND(Explain)               \
  COMMAND(Adopt)                 \
  COMMAND(Refine)                \
  COMMAND(Plan)                  \
  COMMAND(Hide)                  \
  COMMAND(Score)                 \
  COMMAND(Watch)                 \
  COMMAND(Serve)                 \
  COMMAND(Practice)

namespace ambrig {

#define AMBRIG_DECLARE(name) void Add##name(CLI::App& app, Work& work);
AMBRIG_COMMANDS(AMBRIG_DECLARE)
#undef AMBRIG_DECLARE

void AddCommands(CLI::App& app, Work& work) {
#define AMBRIG_ADD(name) Add##name(app, work);
  AMBRIG_COMMANDS(AMBRIG_ADD)
#undef AMBRIG_ADD
}

}  // namespace ambrig
