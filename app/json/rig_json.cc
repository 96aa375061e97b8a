#include "app/json/rig_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/json/json_number.h"
#include "core/math/constants.h"
#include "rig/coil_layout.h"
#include "rig/parameters/bearing_kind.h"

namespace ambrig {
namespace {

using Json = nlohmann::ordered_json;

const Tolerance* ToleranceOf(const RigParameters& rig, const std::string& path) {
  for (const Tolerance& t : rig.tolerances)
    if (t.path == path) return &t;
  return nullptr;
}

Json ValuesJson(const RigParameters& rig) {
  Json values = Json::object();
  for (const std::string& path : ParameterPaths(rig)) {
    double lo = 0, hi = 0;
    std::string unit;
    ParameterRange(rig, path, &lo, &hi, &unit);
    Json value{{"value", FiniteOrNull(*ParameterAt(rig, path))}, {"unit", unit}};
    if (const Tolerance* t = ToleranceOf(rig, path)) {
      value["sd"] = t->sd;
      if (!std::isnan(t->true_value)) value["fitted"] = t->true_value;
    }
    values[path] = value;
  }
  return values;
}

Json BearingJson(const BearingParameters& b) {
  Json coils = Json::array();
  for (const CoilPlace& c : CoilsOf(b))
    coils.push_back(
        {{"name", c.name}, {"angle_deg", c.angle * 180 / kPi}, {"turns", c.turns}, {"gap", c.gap}});
  Json out{{"name", b.name}, {"kind", b.kind->name}, {"z", b.z}, {"axes", b.Axes()}};
  out["clearance"] = b.auxiliary ? Json(b.auxiliary->clearance) : Json(nullptr);
  out["coils"] = coils;
  return out;
}

Json RigEffectJson(const EffectInstance& e) {
  Json parameters = Json::object();
  for (std::size_t k = 0; k < e.table.size(); ++k) {
    parameters[e.table[k].name] = {{"value", FiniteOrNull(e.values[k])}, {"unit", e.table[k].unit}};
    if (k < e.sd.size() && e.sd[k] > 0) parameters[e.table[k].name]["sd"] = e.sd[k];
  }
  Json out{{"effect", e.name}, {"target", e.target}, {"parameters", parameters}};
  for (const auto& [where, formula] : e.formulas) out["formulas"][where] = formula;
  return out;
}

/// What is compared of a rig, in its order: name -> text of the value, its unit and number.
struct Fact {
  std::string unit, text;
  double number = kRequired, sd = 0;
};
using Facts = std::vector<std::pair<std::string, Fact>>;

Fact NumberFact(double value, const std::string& unit, double sd = 0) {
  return {unit, fmt::format("{:.9g}", value), value, sd};
}

/// Numbers that stand in no parameter table: where planes lie, gravity.
void AddPlaces(const RigParameters& rig, Facts& facts) {
  for (std::size_t k = 0; k < 3; ++k)
    facts.emplace_back(fmt::format("gravity[{}]", k), NumberFact(rig.gravity[k], "m/s2"));
  facts.emplace_back("rotor.kind", Fact{"", rig.rotor_kind});
  facts.emplace_back("controller.kind", Fact{"", rig.controller.kind});
  for (const BearingParameters& b : rig.bearings) {
    facts.emplace_back("bearings." + b.name + ".kind", Fact{"", std::string(b.kind->name)});
    facts.emplace_back("bearings." + b.name + ".z", NumberFact(b.z, "m"));
  }
}

Facts FactsOf(const RigParameters& rig) {
  Facts facts;
  AddPlaces(rig, facts);
  for (const std::string& path : ParameterPaths(rig)) {
    double lo = 0, hi = 0;
    std::string unit;
    ParameterRange(rig, path, &lo, &hi, &unit);
    double value = *ParameterAt(rig, path);
    const Tolerance* t = ToleranceOf(rig, path);
    if (t && !std::isnan(t->true_value)) value = t->true_value;
    facts.emplace_back(path, NumberFact(value, unit, t ? t->sd : 0));
    if (t) facts.emplace_back(path + ".sd", NumberFact(t->sd, unit));
  }
  for (const EffectInstance& e : rig.effects) {
    const std::string name = "effect " + NameAtTarget(e.label.empty() ? e.name : e.label, e.target);
    for (std::size_t k = 0; k < e.table.size(); ++k)
      facts.emplace_back(name + ": " + e.table[k].name,
                         NumberFact(e.values[k], e.table[k].unit, k < e.sd.size() ? e.sd[k] : 0));
    for (const auto& [where, formula] : e.formulas)
      facts.emplace_back(name + ": " + where, Fact{"", formula});
  }
  return facts;
}

bool SameFact(const Fact& a, const Fact& b) {
  if (std::isnan(a.number) || std::isnan(b.number)) return a.text == b.text;
  return a.number == b.number;
}

RigDifference DifferenceOf(const std::string& what, const Fact* a, const Fact* b) {
  RigDifference d{what, a ? a->unit : b->unit, a ? a->text : "", b ? b->text : "", 0};
  const double sd = a && a->sd > 0 ? a->sd : b ? b->sd : 0;
  if (a && b && sd > 0) d.sds = (b->number - a->number) / sd;
  return d;
}

}  // namespace

Json RigJson(const RigParameters& rig) {
  Json bearings = Json::array(), effects = Json::array();
  for (const BearingParameters& b : rig.bearings) bearings.push_back(BearingJson(b));
  for (const EffectInstance& e : rig.effects) effects.push_back(RigEffectJson(e));
  return {{"name", rig.name},          {"gravity", rig.gravity},
          {"rotor", rig.rotor_kind},   {"controller", rig.controller.kind},
          {"values", ValuesJson(rig)}, {"bearings", bearings},
          {"effects", effects}};
}

std::vector<RigDifference> RigDifferences(const RigParameters& a, const RigParameters& b) {
  const Facts left = FactsOf(a), right = FactsOf(b);
  const std::map<std::string, Fact> known_left(left.begin(), left.end()),
      known_right(right.begin(), right.end());
  std::vector<RigDifference> out;
  for (const auto& [what, fact] : left) {
    const auto other = known_right.find(what);
    if (other == known_right.end())
      out.push_back(DifferenceOf(what, &fact, nullptr));
    else if (!SameFact(fact, other->second))
      out.push_back(DifferenceOf(what, &fact, &other->second));
  }
  for (const auto& [what, fact] : right)
    if (!known_left.contains(what)) out.push_back(DifferenceOf(what, nullptr, &fact));
  return out;
}

}  // namespace ambrig
