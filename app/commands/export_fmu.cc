#include "app/commands/export_fmu.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <algorithm>
#include <filesystem>

#include "control/external/external_controller.h"
#include "core/base/fingerprint.h"
#include "core/base/inputs_read.h"
#include "core/base/json_file.h"
#include "core/base/read_file.h"
#include "core/base/zip_file.h"
#include "fmu/description.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

namespace fs = std::filesystem;

constexpr const char* kLibrary = "ambrig_fmu.so";
constexpr const char* kSolver = "libnlopt.so";  // goes with it (cmake/fmu.cmake)

/// Where this code is: the folders of the Python module's file and of the program.
std::vector<fs::path> OwnFolders() {
  std::vector<fs::path> folders;
  std::error_code error;
  Dl_info here{};
  // Of a program the loader knows only the word by which it was called.
  if (dladdr(reinterpret_cast<const void*>(&ExportFmu), &here) && here.dli_fname &&
      std::string(here.dli_fname).find('/') != std::string::npos)
    folders.push_back(fs::absolute(here.dli_fname, error).parent_path());
  folders.push_back(fs::read_symlink("/proc/self/exe", error).parent_path());
  return folders;
}

/// ambrig_fmu.so beside the program (or Python module) that this code is in, in ../lib/ambrig, or,
/// for the module in lib/python3/dist-packages/ambrig, in lib/ambrig.
std::string LibraryFile() {
  std::error_code error;
  const std::vector<fs::path> folders = OwnFolders();
  for (const fs::path& folder : folders)
    for (const fs::path& place :
         {folder / kLibrary, folder.parent_path() / "lib" / "ambrig" / kLibrary,
          folder.parent_path().parent_path().parent_path() / "ambrig" / kLibrary})
      if (fs::is_regular_file(place, error)) return place.string();
  const fs::path& program = folders.back();
  throw InputError(fmt::format(
      "--fmu: {} is neither in {} nor in {}; allowed: an ambrig that was built with AMBRIG_FMU=ON",
      kLibrary, program.string(), (program.parent_path() / "lib" / "ambrig").string()));
}

/// The file from which this process has loaded a library; empty: it has not.
std::string LoadedLibrary(const std::string& name) {
  std::pair<const std::string*, std::string> search{&name, ""};
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* data) {
        auto* s = static_cast<std::pair<const std::string*, std::string>*>(data);
        if (fs::path(info->dlpi_name).filename().string().starts_with(*s->first))
          s->second = info->dlpi_name;
        return s->second.empty() ? 0 : 1;
      },
      &search);
  return search.second;
}

void RefuseWhatFmusLack(const RigParameters& rig, const std::vector<std::string>& inputs) {
  std::vector<const ControllerParameters*> controllers{&rig.controller};
  for (const ControllerParameters& c : rig.other_controllers) controllers.push_back(&c);
  for (const ControllerParameters* c : controllers)
    if (dynamic_cast<const ExternalSettings*>(c->own.get()))
      throw InputError(fmt::format(
          "{}: an FMU does not take along a controller of kind \"{}\", allowed: kinds that ambrig "
          "computes; give its forces as inputs force.AXIS",
          rig.file, c->kind));
  for (const ControllerParameters* c : controllers)
    if (c->kind == "h-infinity")
      throw InputError(fmt::format(
          "{}: an FMU has no synthesis of kind \"h-infinity\", allowed: another kind; the computed "
          "controller is written by --controller-c",
          rig.file));
  for (const EffectInstance& e : rig.effects)
    if (e.IsFormula())
      throw InputError(fmt::format(
          "{}: an FMU has no formulas, allowed: the effects of `ambrig effects`", e.where));
  for (const std::string& file : inputs) {
    const std::string kind = fs::path(file).extension().string();
    if (kind == ".h5" || kind == ".hdf5" || kind == ".mat")
      throw InputError(
          fmt::format("{}: an FMU does not read {} files, allowed: samples as CSV", file, kind));
  }
}

/// The deepest folder in which all files are.
fs::path FolderOfAll(const std::vector<fs::path>& files) {
  fs::path folder = files.front().parent_path();
  for (const fs::path& file : files) {
    const auto inside = [&] {
      const fs::path rest = file.lexically_relative(folder);
      return !rest.empty() && *rest.begin() != "..";
    };
    while (!inside() && folder != folder.parent_path()) folder = folder.parent_path();
  }
  return folder;
}

/// A C identifier from the name of the file.
std::string IdentifierOf(const std::string& file) {
  std::string name = fs::path(file).stem().string();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) || static_cast<unsigned char>(c) > 127)
      c = '_';
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0]))) name = "rig_" + name;
  return name;
}

/// {xxxxxxxx-xxxx-xxxx-xxxx-xxxxxxxxxxxx} of the contents.
std::string TokenOf(const std::string& contents) {
  const std::string h = HashText(contents) + HashText("token" + contents);
  return fmt::format("{{{}-{}-{}-{}-{}}}", h.substr(0, 8), h.substr(8, 4), h.substr(12, 4),
                     h.substr(16, 4), h.substr(20, 12));
}

/// Files that rig and scenario were read from, absolute.
std::vector<fs::path> FilesRead(const RigParameters& rig) {
  std::vector<std::string> names = InputsRead();
  if (!rig.detection.commissioning.empty()) names.push_back(rig.detection.commissioning);
  std::vector<fs::path> files;
  for (const std::string& name : names) files.push_back(fs::weakly_canonical(fs::absolute(name)));
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

}  // namespace

nlohmann::ordered_json ExportFmu(const FmuExport& wanted) {
  if (wanted.fmi != "2.0" && wanted.fmi != "3.0")
    throw InputError(fmt::format("--fmi = {}, allowed: 2.0, 3.0", wanted.fmi));
  ForgetInputs();
  const RigParameters rig = ReadRig(wanted.rig);
  const Scenario scenario =
      wanted.scenario.empty() ? OpenScenario(rig) : ReadScenario(wanted.scenario, rig);
  RefuseWhatFmusLack(rig, InputsRead());
  const SteppedRun run(rig, scenario);
  FmuDescription d;
  d.fmi = wanted.fmi == "2.0" ? 2 : 3;
  d.name = rig.name;
  d.identifier = IdentifierOf(wanted.file);
  d.made_by = "ambrig export";
  d.period = run.T();
  d.step = run.T() * rig.periods_per_control();
  d.variables = FmuVariablesOf(rig, scenario, run.outputs());

  const std::vector<fs::path> files = FilesRead(rig);
  const fs::path root = FolderOfAll(files);
  const auto inside = [&root](const std::string& file) {
    return fs::weakly_canonical(fs::absolute(file)).lexically_relative(root).generic_string();
  };
  nlohmann::ordered_json setup{{"rig", "files/" + inside(wanted.rig)}};
  if (!wanted.scenario.empty()) setup["scenario"] = "files/" + inside(wanted.scenario);
  const std::string library = ReadFile(LibraryFile()), solver = LoadedLibrary(kSolver);
  if (JsonText(setup).find("\ufffd") != std::string::npos)
    throw InputError(wanted.rig + ": a name that is no UTF-8 text, allowed in an FMU: UTF-8");
  std::string contents = setup.dump() + wanted.fmi + HashText(library);
  std::vector<ZipEntry> resources;
  for (const fs::path& file : files) {
    resources.emplace_back("resources/files/" + inside(file.string()), ReadFile(file.string()));
    contents += resources.back().first + resources.back().second;
  }
  d.token = TokenOf(contents);
  setup["token"] = d.token;
  const std::string binaries = d.fmi == 2 ? "binaries/linux64/" : "binaries/x86_64-linux/";
  std::vector<ZipEntry> entries{{"documentation/made_by.txt", "made by ambrig export\n"},
                                {"modelDescription.xml", ModelDescription(d)},
                                {binaries + d.identifier + ".so", library},
                                {"resources/setup.json", setup.dump(2) + "\n"}};
  if (!solver.empty())
    entries.emplace_back(binaries + fs::path(solver).filename().string(), ReadFile(solver));
  entries.insert(entries.end(), resources.begin(), resources.end());
  WriteZip(wanted.file, entries);
  const auto count = [&d](bool (FmuVariable::*is)() const) {
    return std::ranges::count_if(d.variables, [is](const FmuVariable& v) { return (v.*is)(); });
  };
  return {{"file", wanted.file},
          {"fmi", wanted.fmi},
          {"model_identifier", d.identifier},
          {"token", d.token},
          {"parameters", count(&FmuVariable::IsParameter)},
          {"inputs", count(&FmuVariable::IsInput)},
          {"outputs", count(&FmuVariable::IsOutput)},
          {"step", d.step}};
}

}  // namespace ambrig
