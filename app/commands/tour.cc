/// ambrig tour: three lessons for a newcomer - the main run, a fault of one's own, a hidden effect.
/// Writes the files that they need into a folder and says what to type and what to look at.
#include <fmt/format.h>

#include <filesystem>

#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/commands/tour_files.h"
#include "core/base/atomic_file.h"

namespace ambrig {

namespace {

struct TourCommand {
  std::string folder = "tour";
  bool force = false;
};

constexpr const char* kLessons =
    R"(Three lessons of two minutes each. Type the commands, read what they print.

1  The main run: a coil breaks, the rotor stays up
     cd {0}
     ambrig run coil_opens.toml --out out
   Look at: the events "fault", "detected", "redistributed" (0.1 ms apart),
   the peak orbit beside the clearance, the verdict. With curves, in a browser:
   out/coil_opens.html
   "doubtful": the detection has not learnt this rig, so it acts on gross faults
   only; ambrig commission rig.toml teaches it. Run it again then: the event
   is gone before the fault (after it, it may come for the bearing that is hit).

2  A fault of your own: half of the turns of coil B6 are shorted
     ambrig run my_fault.toml --out out
   Open my_fault.toml: change target, kind, fraction or the speed, run it again.
   Look at: "classified ... partial-short" and the share of turns that it found.
   What may stand in the file: ambrig parameters. Now take the answer
   away: fault_tolerance = false.

3  A hidden effect: physics that the model lacks
     ambrig hide sensor-gain --rig rig.toml --seed 3 -o practice
     ambrig compare practice/case.toml
   Look at: the error over the noise, and the record and channel where it is
   largest (1: only noise is left).
   Then (some minutes): ambrig explain practice/case.toml --html explain.html
   The answer lies sealed in practice.answer.toml.

Afterwards: ambrig --help; ambrig COMMAND --help has examples.
)";

int RunTour(const TourCommand& o) {
  const std::filesystem::path folder(o.folder);
  PrepareFolder(o.folder);
  std::vector<std::string> files;
  for (const TourFile& f : TourFiles()) files.push_back((folder / f.name).string());
  RefuseOverwriting(files, o.force);
  for (const TourFile& f : TourFiles())
    WriteMarkedText((folder / f.name).string(), "tour", std::string(f.text));
  fmt::print("{}", fmt::format(fmt::runtime(kLessons), o.folder));
  return 0;
}

}  // namespace

void AddTour(CLI::App& app, Work& work) {
  auto o = std::make_shared<TourCommand>();
  CLI::App* command = app.add_subcommand("tour", "three short lessons for a newcomer");
  command->add_option("-o,--out", o->folder, "folder for the lessons' files")
      ->capture_default_str();
  command->add_flag("--force", o->force, kForceHelp);
  command->footer("Examples:\n  ambrig tour\n  ambrig tour -o lessons");
  command->callback([o, &work] { work = [o] { return RunTour(*o); }; });
}

}  // namespace ambrig
