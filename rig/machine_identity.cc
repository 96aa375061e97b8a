#include "rig/machine_identity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/fingerprint.h"

namespace ambrig {

namespace {

constexpr std::size_t kHashDigits = 8, kNamedParts = 3;
/// Effects of nothing but the shaft.
constexpr std::string_view kOfShaftAlone[] = {
    "unbalance",      "shaft-bow",      "bending-mode",  "rotating-damping",
    "cross-coupling", "side-pull",      "windage",       "coupling-misalignment",
    "base-mode",      "base-vibration", "constant-load", "contact-friction",
    "contact-mount"};

using Part = MachineIdentity::Part;

std::string ShortHash(const std::string& text) { return HashText(text).substr(0, kHashDigits); }

/// "A" of "bearings.A.gap"; empty for numbers of no bearing.
std::string BearingOfPath(const std::string& path) {
  constexpr std::string_view kBearings = "bearings.";
  if (!path.starts_with(kBearings)) return "";
  const auto end = path.find('.', kBearings.size());
  return path.substr(kBearings.size(), end - kBearings.size());
}

/// "A" of "A.coil3"; empty for what acts on the whole rig.
std::string BearingOfTarget(const RigParameters& rig, const std::string& target) {
  const std::string name = target.substr(0, target.find('.'));
  return rig.Find(name) ? name : "";
}

Part PartOf(const RigParameters& rig, const EffectInstance& e) {
  std::string text;
  for (const double v : e.values) text += fmt::format("{};", v);
  for (const auto& [output, formula] : e.formulas) text += output + "=" + formula + ";";
  return {NameAtTarget(e.name, e.target), ShortHash(text), BearingOfTarget(rig, e.target)};
}

void AddCoilErrors(const BearingParameters& b, std::vector<Part>* parts) {
  if (!b.coil_errors.any()) return;
  std::string text;
  for (const double v : b.coil_errors.current_gain) text += fmt::format("{};", v);
  for (const double v : b.coil_errors.edge) text += fmt::format("{}|", v);
  parts->push_back({fmt::format("bearings.{}.coil_errors", b.name), ShortHash(text), b.name});
}

/// Names of the parts of a bearing that only one of the two has, or that have other values.
std::vector<std::string> Differing(const std::vector<Part>& a, const std::vector<Part>& b,
                                   const std::string& bearing) {
  std::vector<std::string> names;
  const auto collect = [&](const std::vector<Part>& own, const std::vector<Part>& other) {
    for (const Part& p : own) {
      if (!p.bearing.empty() && p.bearing != bearing) continue;
      const bool same = std::ranges::any_of(
          other, [&](const Part& q) { return q.name == p.name && q.hash == p.hash; });
      if (!same && std::ranges::find(names, p.name) == names.end()) names.push_back(p.name);
    }
  };
  collect(a, b);
  collect(b, a);
  return names;
}

void AddWords(const char* what, const std::vector<std::string>& names, std::string* text) {
  if (names.empty()) return;
  *text += fmt::format("{}{} (", text->empty() ? "" : ", ", what);
  for (std::size_t k = 0; k < std::min(names.size(), kNamedParts); ++k)
    *text += (k ? ", " : "") + names[k];
  if (names.size() > kNamedParts) *text += fmt::format(" and {} more", names.size() - kNamedParts);
  *text += ")";
}

}  // namespace

MachineIdentity IdentityOf(const RigParameters& rig) {
  MachineIdentity out;
  out.known = true;
  out.unit = rig.amplifier.unit;
  out.unit_counts = rig.amplifier.edge_spread > 0 || rig.amplifier.current_gain_spread > 0;
  for (const Tolerance& t : rig.tolerances) {
    const std::string bearing = BearingOfPath(t.path);
    if (std::isnan(t.true_value) || (bearing.empty() && !t.path.starts_with("amplifier.")))
      continue;
    out.fitted.push_back({t.path, ShortHash(fmt::format("{}", t.true_value)), bearing});
  }
  for (const BearingParameters& b : rig.bearings) AddCoilErrors(b, &out.fitted);
  for (const EffectInstance& e : rig.effects) {
    if (!e.IsNull() && std::ranges::find(kOfShaftAlone, e.name) == std::end(kOfShaftAlone))
      out.effects.push_back(PartOf(rig, e));
  }
  return out;
}

std::string DifferenceOf(const MachineIdentity& learnt, const MachineIdentity& now,
                         const std::string& bearing) {
  std::string text;
  if (!learnt.known || !now.known) return text;
  AddWords("effects", Differing(learnt.effects, now.effects, bearing), &text);
  AddWords("fitted values", Differing(learnt.fitted, now.fitted, bearing), &text);
  if (now.unit_counts && learnt.unit != now.unit)
    AddWords("unit", {fmt::format("{}, now {}", learnt.unit, now.unit)}, &text);
  return text;
}

}  // namespace ambrig
