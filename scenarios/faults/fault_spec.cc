#include "scenarios/faults/fault_spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

constexpr FaultKind kKinds[] = {
    {"open", FaultTarget::kCoil, "the current is gone within one ADC sample and stays away"},
    {"partial-short", FaultTarget::kCoil,
     "a fraction of the turns that are still driven is shorted"},
    {"amplifier-off", FaultTarget::kCoil, "both switches stay open, the diodes end the current"},
    {"switch-stuck-on", FaultTarget::kCoil, "the bridge drives up all the time"},
    {"current-sensor", FaultTarget::kCoil, "the reading is wrong"},
    {"position-sensor", FaultTarget::kAxis, "the reading is wrong"},
    {"bus-sag", FaultTarget::kRig, "the supply falls, for a while or for good"},
};

constexpr FaultParameter kParameters[] = {
    {"partial-short", "fraction", "-", 0, 1, false, false, "share of the turns"},
    {"partial-short", "short_resistance", "ohm", 0, kInfinity, true, false,
     "of the short; inf (default): turns bypassed"},
    {"current-sensor", "gain", "-", -100, 100, true, false, "factor on the reading"},
    {"current-sensor", "offset", "A", -1e4, 1e4, true, false, "added to the reading"},
    {"current-sensor", "stuck", "-", 0, 1, true, true, "the reading stays where it is"},
    {"position-sensor", "offset", "m", -1, 1, true, false, "added to the reading"},
    {"position-sensor", "stuck", "-", 0, 1, true, true, "the reading stays where it is"},
    {"position-sensor", "lost", "-", 0, 1, true, true, "the reading is zero"},
    {"bus-sag", "voltage", "V", 0, 1e5, true, false,
     "during the sag; default: 0.8 of the nominal one"},
    {"bus-sag", "duration", "s", 0, kInfinity, false, false, "inf (default): for good"},
};

std::string Allowed(const FaultParameter& p) {
  if (p.flag) return "true or false";
  const std::string unit = p.unit == "-" ? "" : fmt::format(" {}", p.unit);
  if (p.ends_allowed) return fmt::format("{} to {}{} ({})", p.lo, p.hi, unit, p.doc);
  return fmt::format("above {} to {}{}{} ({})", p.lo, std::isinf(p.hi) ? "" : "below ", p.hi, unit,
                     p.doc);
}

bool Inside(const FaultParameter& p, double v) {
  if (std::isnan(v)) return false;
  return p.ends_allowed ? v >= p.lo && v <= p.hi : v > p.lo && (v < p.hi || std::isinf(p.hi));
}

double ReadOne(const TomlTable& t, const FaultParameter& p) {
  if (p.flag) return t.Bool(p.key, false) ? 1 : 0;
  const double v = t.Number(p.key, std::isinf(p.hi) ? kInfinity : 0.0);
  if (!Inside(p, v))
    t.Fail(p.key, fmt::format("= {}{}, allowed: {}", v,
                              p.unit == "-" ? "" : fmt::format(" {}", p.unit), Allowed(p)));
  return v;
}

}  // namespace

std::span<const FaultKind> FaultKinds() { return kKinds; }
std::span<const FaultParameter> FaultParameters() { return kParameters; }

std::string FaultKindNames(std::span<const FaultTarget> targets) {
  std::string names;
  for (const FaultKind& k : kKinds)
    if (std::count(targets.begin(), targets.end(), k.target) > 0)
      names += fmt::format("{}{}", names.empty() ? "" : ", ", k.kind);
  return names;
}

const FaultKind& ReadFaultKind(const TomlTable& t, const std::string& allowed,
                               std::map<std::string, double>* parameters) {
  const std::string name = t.Choice("kind", "", allowed);
  const FaultKind& kind = *std::find_if(std::begin(kKinds), std::end(kKinds),
                                        [&](const FaultKind& k) { return k.kind == name; });
  const auto given = t.Table("parameters");
  std::string keys;
  bool nothing = true;  // no parameter that makes a wrong reading
  for (const FaultParameter& p : kParameters) {
    if (p.kind != name) continue;
    keys += fmt::format("{}{}", keys.empty() ? "" : ", ", p.key);
    if (!given || !given->Has(p.key)) continue;
    const double v = (*parameters)[std::string(p.key)] = ReadOne(*given, p);
    if (v != (p.key == "gain" ? 1 : 0)) nothing = false;
  }
  if (given) {
    for (const std::string& key : given->Keys())
      if (!parameters->contains(key))
        given->Fail(key, fmt::format("unknown key, allowed with kind {}: {}", name,
                                     keys.empty() ? "none" : keys));
  }
  if (name == "partial-short" && !parameters->contains("fraction"))
    t.Fail("parameters", "fraction is missing, allowed: above 0 to below 1 (share of the turns)");
  if (name.ends_with("-sensor") && nothing)
    t.Fail("parameters", fmt::format("change nothing, allowed with kind {}: {}", name, keys));
  return kind;
}

}  // namespace ambrig
