/// ambrig paper: the seed paper's simulation and experiment done again, its figures redrawn.
#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/commands/progress.h"
#include "app/pages/paper_report.h"

namespace ambrig {

namespace {

int RunPaper(const CommonOptions& common, const std::string& folder) {
  common.CheckOutputs({});
  PaperStudy study;
  {
    Progress progress("paper");
    PaperStudyOptions options;
    options.stop = &interrupted;
    options.progress = [&](double done) { progress.Update(done); };
    study = RunPaperStudy(folder, options);
  }
  fmt::print("{}", PaperText(study));
  common.WriteJson(PaperJson(study));
  if (!common.html.empty()) {
    WritePaperReport(study, common.html);
    fmt::print("written: {} (figures 4, 5 and 11 to 20)\n", common.html);
  }
  return 0;
}

}  // namespace

void AddPaper(CLI::App& app, Work& work) {
  auto common = std::make_shared<CommonOptions>();
  auto folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "paper", "the seed paper redrawn: single coils, slope detector, its figures and numbers");
  command->add_option("folder", *folder, "folder of its coils and runs: examples/paper or a copy")
      ->required();
  common->AddTo(*command);
  command->footer(
      "Examples:\n"
      "  ambrig paper examples/paper --html paper.html\n"
      "  ambrig paper examples/paper --json paper.json\n"
      "The folder holds step_2mH.toml, step_1mH.toml, healthy.toml, open.toml and\n"
      "short.toml with their rigs; copy it and change a coil, a pulse, a fault.");
  command->callback(
      [common, folder, &work] { work = [common, folder] { return RunPaper(*common, *folder); }; });
}

}  // namespace ambrig
