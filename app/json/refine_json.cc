#include "app/json/refine_json.h"

#include <cmath>

namespace ambrig {

nlohmann::ordered_json RefineJson(const Refinement& r) {
  using Json = nlohmann::ordered_json;
  Json curve = Json::array();
  for (const CurvePoint& p : r.curve)
    curve.push_back({{"u", p.u},
                     {"value", p.value},
                     {"sd", p.sd},
                     {"support", p.support},
                     {"visited", p.visited},
                     {"named", p.named}});
  const EffectInstance& e = r.fit.fit.hypothesis.rig.effects.back();
  Json parameters = Json::object();
  for (std::size_t k = 0; k < e.table.size(); ++k)
    parameters[e.table[k].name] = {{"value", e.values[k]}, {"unit", e.table[k].unit}};
  Json ladder = Json::array();
  for (const LadderStep& s : r.ladder)
    ladder.push_back(
        {{"added", s.added}, {"ratio_fit", s.ratio_fit}, {"ratio_validate", s.ratio_validate}});
  return {{"effect", r.effect},
          {"target", r.target},
          {"curve", curve},
          {"ratio_before", r.ratio_before},
          {"ratio_after", r.ratio_after},
          {"supported", {r.supported_lo, r.supported_hi}},
          {"u", {{"name", r.shape.u_name}, {"unit", r.shape.u_unit}}},
          {"value", {{"name", r.shape.value_name}, {"unit", r.shape.value_unit}}},
          {"ratio_fit_before", r.ratio_fit_before},
          {"ratio_fit_after", r.ratio_fit_after},
          {"smoothing", r.fit.smoothing},
          {"refined", {{"effect", e.name}, {"parameters", parameters}}},
          {"ladder", ladder},
          {"warnings", r.warnings}};
}

}  // namespace ambrig
