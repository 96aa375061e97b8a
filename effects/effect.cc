#include "effects/effect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/toml_checked.h"
#include "effects/catalogue.h"
#include "effects/formula.h"

namespace ambrig {

std::string NameAtTarget(const std::string& effect, const std::string& target) {
  return target.empty() ? effect : effect + " at " + target;
}

double EffectInstance::Value(const std::string& parameter) const {
  for (std::size_t k = 0; k < table.size(); ++k)
    if (table[k].name == parameter) return values[k];
  throw std::logic_error("effect " + name + " has no parameter " + parameter);
}

void EffectInstance::Set(const std::string& parameter, double value) {
  for (std::size_t k = 0; k < table.size(); ++k)
    if (table[k].name == parameter) values[k] = value;
}

bool EffectDescription::Switches(const EffectParameter& p) const {
  return off_when_null.empty() ||
         std::find(off_when_null.begin(), off_when_null.end(), p.name) != off_when_null.end();
}

bool EffectInstance::IsNull() const {
  const EffectDescription* d = FindEffect(name);
  bool any_switch = false;
  for (std::size_t k = 0; k < table.size(); ++k) {
    if (!table[k].has_null || (d && !d->Switches(table[k]))) continue;
    any_switch = true;
    if (values[k] != table[k].null_value) return false;
  }
  return any_switch;
}

std::vector<std::string> TargetsOf(const EffectDescription& d, const EffectTargets& known) {
  std::vector<std::string> out;
  const auto add = [&](const std::vector<std::string>& names) {
    out.insert(out.end(), names.begin(), names.end());
  };
  std::vector<std::string> radial;  // planes without z
  for (const auto& p : known.planes)
    if (p != "z") radial.push_back(p);
  switch (d.target) {
    case TargetKind::kRig:
      return {"rig"};
    case TargetKind::kBearing:
      add(known.bearings);
      break;
    case TargetKind::kPlane:
      out = radial;
      break;
    case TargetKind::kPlaneOrZ:
      add(known.planes);
      break;
    case TargetKind::kPlaneOrRig:
      out = radial;
      out.push_back("rig");
      break;
    case TargetKind::kCoil:
      add(known.coils);
      break;
    case TargetKind::kCoilOrBearing:
      add(known.coils);
      add(known.bearings);
      break;
    case TargetKind::kAxis:
      add(known.axes);
      break;
    case TargetKind::kAny:
      out.push_back("rig");
      add(known.bearings);
      add(known.planes);
      add(known.axes);
      add(known.coils);
      break;
  }
  if (d.at_stations) add(known.stations);
  std::erase_if(out, [&](const std::string& name) {
    const auto it = known.kind.find(name);
    return it != known.kind.end() && (it->second & d.acts_on) == 0;
  });
  std::vector<std::string> unique;
  for (const auto& t : out)
    if (std::find(unique.begin(), unique.end(), t) == unique.end()) unique.push_back(t);
  return unique;
}

EffectInstance MakeInstance(const EffectDescription& d, const std::string& target) {
  EffectInstance e;
  e.name = d.id;
  e.target = target;
  e.table = d.parameters;
  for (const auto& p : d.parameters) e.values.push_back(p.null_value);
  e.sd.assign(e.values.size(), 0);
  return e;
}

EffectInstance ReadEffect(const TomlTable& t, const EffectTargets& known) {
  const std::string name = t.String("name");
  const EffectDescription* d = FindEffect(name);
  std::string all;
  for (const auto& c : Catalogue()) all += (all.empty() ? "" : ", ") + c.id;
  if (!d) {
    const std::string near = Nearest(name, all);
    t.Fail("name", fmt::format("= \"{}\": unknown effect{}; `ambrig effects` lists them", name,
                               near.empty() ? "" : fmt::format(", did you mean {}?", near)));
  }
  EffectInstance e = MakeInstance(*d, "");
  e.where = t.Where();
  e.label = t.String("label", "");
  const std::vector<std::string> targets = TargetsOf(*d, known);
  std::string allowed;
  for (const auto& k : targets) allowed += (allowed.empty() ? "" : ", ") + k;
  if (targets.empty())
    t.Fail("name", fmt::format("= \"{}\": acts on no part of this rig, allowed: where `ambrig "
                               "effects {}` says",
                               name, name));
  e.target = t.Choice("target", targets.size() == 1 ? targets[0] : "", allowed);
  if (name == "formula") {
    ReadFormula(t, e);
  } else if (const auto p = t.Table("parameters")) {
    for (std::size_t k = 0; k < e.table.size(); ++k) {
      const EffectParameter& row = e.table[k];
      e.values[k] = p->Number(row.name, row.null_value, &e.sd[k]);
      if (!(row.lo <= e.values[k] && e.values[k] <= row.hi))
        ThrowOutOfRange(p->Where(row.name), row.name, e.values[k], row.unit, row.lo, row.hi,
                        row.doc);
      CheckSpread(p->Where(row.name), e.sd[k], e.values[k], row.lo, row.hi, row.unit);
    }
    p->RejectUnknownKeys();
  }
  t.RejectUnknownKeys();
  return e;
}

}  // namespace ambrig
