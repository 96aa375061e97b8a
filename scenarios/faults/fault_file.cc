#include "scenarios/faults/fault_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ambrig {

namespace {

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

double ReadOne(const TomlTable& t, const FaultParameter& p, const RigParameters& rig) {
  if (p.flag) return t.Bool(p.key, false) ? 1 : 0;
  const double v = t.Number(p.key, std::isinf(p.hi) ? kInfinity : 0.0);
  const std::string unit = p.unit == "-" ? "" : fmt::format(" {}", p.unit);
  if (!Inside(p, v)) t.Fail(p.key, fmt::format("= {}{}, allowed: {}", v, unit, Allowed(p)));
  if (p.below && !(v < rig.amplifier.*p.below))
    t.Fail(p.key, fmt::format("= {}{}, allowed: {} to below {}{} ({})", v, unit, p.lo,
                              rig.amplifier.*p.below, unit, p.doc));
  return v;
}

std::string Add(const std::string& list, std::string_view word) {
  return fmt::format("{}{}{}", list, list.empty() ? "" : ", ", word);
}

/// What is missing, or too much, in `parameters`.
void CheckParameters(const TomlTable& t, const Fault& fault,
                     const std::map<std::string, double>& parameters) {
  std::string keys;
  bool nothing = true;
  for (const FaultParameter& p : fault.parameters) {
    keys = Add(keys, p.key);
    const auto it = parameters.find(std::string(p.key));
    if (it != parameters.end() && it->second != p.neutral) nothing = false;
  }
  if (const auto given = t.Table("parameters"))
    for (const std::string& key : given->Keys())
      if (!parameters.contains(key))
        given->Fail(key, fmt::format("unknown key, allowed with kind {}: {}", fault.kind,
                                     keys.empty() ? "none" : keys));
  for (const FaultParameter& p : fault.parameters)
    if (p.required && !parameters.contains(std::string(p.key)))
      t.Fail("parameters", fmt::format("{} is missing, allowed: {}", p.key, Allowed(p)));
  if (fault.must_change && nothing)
    t.Fail("parameters", fmt::format("change nothing, allowed with kind {}: {}", fault.kind, keys));
}

}  // namespace

std::string FaultKindNames(std::span<const FaultTarget> targets) {
  std::string names;
  for (const Fault* f : Faults())
    if (std::count(targets.begin(), targets.end(), f->target) > 0) names = Add(names, f->kind);
  return names;
}

std::string FaultClassNames() {
  std::string names;
  for (const Fault* f : Faults())
    if (!f->seen_as.empty() &&
        (", " + names + ",").find(fmt::format(", {},", f->seen_as)) == std::string::npos)
      names = Add(names, f->seen_as);
  return names;
}

const Fault& ReadFault(const TomlTable& t, const std::string& allowed, const RigParameters& rig,
                       std::map<std::string, double>* parameters) {
  const Fault& fault = FaultByKind(t.Choice("kind", "", allowed));
  if (const auto given = t.Table("parameters"))
    for (const FaultParameter& p : fault.parameters)
      if (given->Has(p.key)) (*parameters)[std::string(p.key)] = ReadOne(*given, p, rig);
  CheckParameters(t, fault, *parameters);
  return fault;
}

}  // namespace ambrig
