#include "simulation/commissioning/other_machine.h"

#include <fmt/format.h>

#include <filesystem>

#include "fdd/detectors/detection_feed.h"
#include "fdd/learning/commissioning_file.h"
#include "rig/machine_identity.h"
#include "rig/rig_file.h"

namespace ambrig {

MachineIdentity MachineOfFile(const std::string& rig_file) {
  if (!std::filesystem::is_regular_file(rig_file)) return {};
  return IdentityOf(ReadRig(rig_file));
}

std::string OtherMachineNote(const RigParameters& rig) {
  const DetectionParameters& d = rig.detection;
  if (d.kind != kCommissionedDetector || d.commissioning == "none") return "";
  const std::string file =
      d.commissioning.empty() ? CommissioningFileOf(rig.file) : d.commissioning;
  if (!std::filesystem::is_regular_file(file)) return "";
  const MachineIdentity learnt = ReadCommissioning(file).machine;
  if (!learnt.known) return "";
  const NominalRig nominal(rig);
  const MachineIdentity now = MachineOfFile(rig.file);
  std::string text;
  for (const BearingParameters& b : nominal->bearings) {
    if (!FitsBearing(file, b.name, LinkageModelOf(b), nominal->amplifier)) continue;
    const std::string difference = DifferenceOf(learnt, now, b.name);
    if (!difference.empty())
      text += fmt::format("{}bearing {}: {}", text.empty() ? "" : "; ", b.name, difference);
  }
  if (text.empty()) return text;
  return fmt::format(
      "{} was learnt on another machine ({}), so that this one counts as not commissioned: gross "
      "faults only; run ambrig commission again",
      file, text);
}

}  // namespace ambrig
