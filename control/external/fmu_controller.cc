#include "control/external/fmu_controller.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <filesystem>
#include <mutex>
#include <set>

#include "core/base/atomic_file.h"
#include "core/base/fingerprint.h"
#include "core/base/zip_file.h"

namespace ambrig {

namespace {

namespace fs = std::filesystem;

/// Folders of this process, by FMU.
class UnpackedFmus {
 public:
  ~UnpackedFmus() {
    std::error_code ignored;
    for (const auto& [file, folder] : folders_) fs::remove_all(folder, ignored);
  }
  std::string FolderOf(const std::string& file) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::string key =
        fmt::format("{} {}", file, fs::last_write_time(file).time_since_epoch().count());
    if (const auto known = folders_.find(key); known != folders_.end()) return known->second;
    std::string folder = (fs::temp_directory_path() / "ambrig_fmu_XXXXXX").string();
    if (!mkdtemp(folder.data())) throw InputError("cannot write " + folder);
    folders_[key] = folder;
    UnpackZip(file, folder);
    return folder;
  }

 private:
  std::mutex mutex_;
  std::map<std::string, std::string> folders_;
};

struct Signal {
  std::string name;   // ambrig's
  const char* field;  // of ambrig_controller.h
  std::size_t index;
};

std::vector<Signal> SignalsOf(const ControllerSite& site, bool inputs, bool currents) {
  std::vector<Signal> all;
  const auto per_axis = [&](const char* field) {
    for (std::size_t a = 0; a < site.axes.size(); ++a)
      all.push_back({fmt::format("{}.{}", field, site.axes[a]), field, a});
  };
  const auto per_coil = [&](const char* field) {
    std::size_t at = 0;
    for (const ControllerSite::Bearing& b : site.bearings)
      for (const std::string& coil : b.coils)
        all.push_back({fmt::format("{}.{}.{}", field, b.name, coil), field, at++});
  };
  if (inputs) {
    for (const char* field : {"position", "reference", "excitation"}) per_axis(field);
    for (const char* field : {"current", "set_point", "duty"}) per_coil(field);
    all.push_back({"speed", "speed", 0});
  } else if (currents) {
    per_coil("command");
  } else {
    per_axis("force");
  }
  return all;
}

std::string NameInFmu(const FmuSettings& s, const std::string& name) {
  const auto other = s.variables.find(name);
  return other == s.variables.end() ? name : other->second;
}

std::string Names(const std::vector<Signal>& signals) {
  std::string text;
  for (const Signal& s : signals) text += (text.empty() ? "" : ", ") + s.name;
  return text;
}

[[noreturn]] void FailAt(const FmuSettings& s, const std::string& text) {
  throw InputError(fmt::format("{} = \"{}\": {}", s.where, s.name, text));
}

/// Lines of the signals that the FMU has; `used`: its variables.
std::string SignalLines(const FmuSettings& s, const std::vector<Signal>& signals, bool inputs,
                        std::set<std::string>& used) {
  std::string lines;
  for (const Signal& signal : signals) {
    const std::string name = NameInFmu(s, signal.name);
    const auto found = s.fmu.variables.find(name);
    const char* causality = inputs ? "input" : "output";
    if (found == s.fmu.variables.end() || found->second.causality != causality) {
      if (!inputs)
        FailAt(s,
               fmt::format("the FMU has no output {}, allowed: outputs {}", name, Names(signals)));
      if (s.variables.contains(signal.name))
        FailAt(s, fmt::format("the FMU has no input {} (key variables)", name));
      continue;
    }
    if (found->second.type != 'r') FailAt(s, fmt::format("{} of the FMU is no real number", name));
    used.insert(name);
    lines += fmt::format("{} {} {} {}\n", inputs ? "in" : "out", signal.field, signal.index,
                         found->second.reference);
  }
  return lines;
}

std::string ParameterLines(const FmuSettings& s) {
  std::string lines;
  for (std::size_t k = 0; k < s.parameters.size(); ++k) {
    const auto found = s.fmu.variables.find(s.parameter_names[k]);
    if (found == s.fmu.variables.end() ||
        (found->second.causality != "parameter" && found->second.causality != "input"))
      FailAt(s, fmt::format("the FMU has no parameter {} (key parameters)", s.parameter_names[k]));
    lines += fmt::format("parameter {} {} {:a}\n", found->second.type, found->second.reference,
                         s.parameters[k]);
  }
  return lines;
}

/// Every key of `variables` is one of ambrig's names.
void CheckMapped(const FmuSettings& s, const std::vector<Signal>& in,
                 const std::vector<Signal>& out) {
  for (const auto& [ours, theirs] : s.variables) {
    const auto is = [&name = ours](const Signal& signal) { return signal.name == name; };
    if (std::ranges::none_of(in, is) && std::ranges::none_of(out, is))
      FailAt(s, fmt::format("variables: \"{}\" is nothing that this rig has, allowed: {}, {}", ours,
                            Names(in), Names(out)));
  }
}

}  // namespace

void OpenFmu(FmuSettings& s) {
  static UnpackedFmus unpacked;
  s.folder = unpacked.FolderOf(s.file);
  s.fmu = ReadFmuInterface((fs::path(s.folder) / "modelDescription.xml").string(), s.file);
}

std::string WriteFmuBinding(const FmuSettings& s, const ControllerSite& site) {
  const fs::path folder = s.folder;
  const std::vector<Signal> in = SignalsOf(site, true, false),
                            out = SignalsOf(site, false, s.commands_currents);
  CheckMapped(s, in, out);
  const fs::path library = folder / "binaries" / (s.fmu.fmi == 2 ? "linux64" : "x86_64-linux") /
                           (s.fmu.identifier + ".so");
  if (!fs::exists(library))
    FailAt(s, fmt::format("the FMU has no library for this machine ({})",
                          library.lexically_relative(folder).string()));
  std::set<std::string> used;
  std::string text = fmt::format("fmi {}\nlibrary {}\ntoken {}\nresources {}/resources\n",
                                 s.fmu.fmi, library.string(), s.fmu.token, folder.string());
  text += ParameterLines(s);
  text += SignalLines(s, in, true, used) + SignalLines(s, out, false, used);
  for (const auto& [name, variable] : s.fmu.variables)
    if (variable.causality == "input" && !used.contains(name) &&
        std::ranges::count(s.parameter_names, name) == 0)
      FailAt(s, fmt::format("nothing is known of the FMU's input {}, allowed: {}; or a value in "
                            "parameters, or another name in variables",
                            name, Names(in)));
  const std::string path = (folder / ("binding_" + HashText(text) + ".fmu-binding")).string();
  WriteFileAtomically(path, text);
  return path;
}

}  // namespace ambrig
