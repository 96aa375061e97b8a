/// ambrig hide: a case to practise on, its answer sealed beside it.
#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "app/commands/commands.h"
#include "app/commands/effect_names.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "core/base/atomic_file.h"
#include "core/base/counted.h"
#include "core/base/read_file.h"
#include "core/base/toml_edit.h"
#include "core/record/hdf5.h"
#include "discovery/practice/hide.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

struct HideCommand {
  std::vector<std::string> effects;
  std::string rig, output = "hidden-case";
  bool exact = false, force = false;
  HideRequest request;
};

const std::string kMark = "# made by ambrig hide\n";

std::string AnswerFile(const std::filesystem::path& folder) {
  return (folder.has_filename() ? folder : folder.parent_path()).string() + ".answer.toml";
}

/// What a case's folder holds, as far as it exists.
std::vector<std::string> FilesOf(const HideCommand& o) {
  std::vector<std::string> files{AnswerFile(o.output)};
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(o.output, error)) {
    const std::string name = entry.path().filename().string();
    if (name == "case.toml" || name == "rig.toml" || name.starts_with("record-"))
      files.push_back(entry.path().string());
  }
  return files;
}

void RejectRepeated(const std::vector<std::pair<std::string, std::string>>& effects) {
  std::set<std::string> seen;
  for (const auto& [name, target] : effects)
    if (!seen.insert(name).second)
      throw InputError(fmt::format("{} is named twice, allowed: each effect once", name));
}

int RunHide(const HideCommand& o) {
  HideRequest request = o.request;
  request.draw_parameters = !o.exact;
  for (const std::string& text : o.effects) request.effects.push_back(EffectAtTarget(text));
  const RigParameters rig = ReadRig(o.rig);
  RejectRepeated(request.effects);
  PrepareFolder(o.output);
  RefuseOverwriting(FilesOf(o), o.force);
  if (!rig.effects.empty())
    throw InputError(o.rig + ": has effects of its own; hide them in a rig without");
  Progress progress("hide");
  progress.Update(0.1, "drawing and measuring");
  const HiddenCase hidden = Hide(rig, request, &interrupted);
  const std::filesystem::path folder(o.output);
  for (std::size_t r = 0; r < hidden.records.size(); ++r) {
    progress.Update(0.8 + 0.2 * static_cast<double>(r) / static_cast<double>(hidden.records.size()),
                    "writing");
    const std::string stem = (folder / fmt::format("record-{}", r + 1)).string();
    WriteMarkedText(stem + ".toml", "hide", kMark + hidden.records[r].toml);
    Record data = hidden.data.records[r].data;
    data.attributes["made_by"] = "ambrig hide";
    WriteHdf5(data, stem + ".h5");
  }
  WriteMarkedText((folder / "rig.toml").string(), "hide",
                  kMark + WithAbsoluteFiles(ReadFile(o.rig), o.rig));
  WriteMarkedText((folder / "case.toml").string(), "hide", kMark + CaseText(hidden));
  std::string name = folder.filename().string();
  if (name.empty()) name = folder.parent_path().filename().string();
  const std::string answer = AnswerFile(folder);
  WriteMarkedText(answer, "hide", kMark + AnswerText(hidden, request, name));
  progress.Clear();
  fmt::print(
      "written: {} with {}\nsealed answer: {}\nnow: ambrig compare {}\nthen: ambrig explain {}\n",
      (folder / "case.toml").string(), Counted(hidden.records.size(), "record"), answer,
      (folder / "case.toml").string(), (folder / "case.toml").string());
  return 0;
}

}  // namespace

void AddHide(CLI::App& app, Work& work) {
  auto options = std::make_shared<HideCommand>();
  CLI::App* command = app.add_subcommand("hide", "generate a synthetic case with a hidden effect");
  command->add_option("effect", options->effects,
                      "effects to hide, NAME or NAME@TARGET; none: parameters only");
  command->add_option("--rig", options->rig, "rig file as its user believes it")->required();
  command
      ->add_option("-o,--out", options->output,
                   "folder of the case; the answer goes to FOLDER.answer.toml")
      ->capture_default_str();
  command
      ->add_option("--seed", options->request.seed,
                   "seed of the random sizes, targets, parameters and noise")
      ->check(NumberIn(0, 9e15, "(an integer)"))
      ->capture_default_str();
  command->add_flag("--exact", options->exact, "keep every rig parameter at its nominal value");
  command->add_flag("--force", options->force, kForceHelp);
  command->footer(
      "Examples:\n"
      "  ambrig hide sensor-gain --rig examples/reference/rig.toml -o practice\n"
      "  ambrig hide unbalance@A side-pull --rig examples/reference/rig.toml -o two\n"
      "  ambrig hide --rig examples/reference/rig.toml --seed 7 -o parameters-only");
  command->callback([options, &work] { work = [options] { return RunHide(*options); }; });
}

}  // namespace ambrig
