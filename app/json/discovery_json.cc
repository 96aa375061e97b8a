#include "app/json/discovery_json.h"

#include <cmath>

namespace ambrig {

namespace {

using Json = nlohmann::ordered_json;

Json Number(double v) {
  if (std::isnan(v)) return nullptr;
  if (std::isinf(v)) return v > 0 ? "inf" : "-inf";
  return v;
}

Json EffectJson(const EffectInstance& e) {
  Json parameters = Json::object();
  for (std::size_t k = 0; k < e.table.size(); ++k)
    parameters[e.table[k].name] = {{"value", Number(e.values[k])},
                                   {"sd", Number(k < e.sd.size() ? e.sd[k] : 0)},
                                   {"unit", e.table[k].unit}};
  return {{"effect", e.name}, {"target", e.target}, {"parameters", parameters}};
}

Json RankingJson(const std::vector<RankedEffect>& ranking) {
  Json all = Json::array();
  for (const RankedEffect& r : ranking) {
    Json j = EffectJson(r.effect);
    j["probability"] = r.probability;
    j["ratio_fit"] = Number(r.fit.ratio_fit);
    j["ratio_validate"] = Number(r.fit.ratio_validate);
    if (r.shaped)
      j["shaped"] = {{"ratio_fit", Number(r.shaped->fit)},
                     {"ratio_validate", Number(r.shaped->validate)}};
    j["converged"] = r.fit.converged;
    j["warnings"] = r.fit.warnings;
    all.push_back(j);
  }
  return all;
}

Json DataJson(const std::vector<DataFault>& faults) {
  Json all = Json::array();
  for (const DataFault& f : faults)
    all.push_back({{"record", f.record},
                   {"channel", f.channel},
                   {"fault", f.fault},
                   {"factor", Number(f.factor)},
                   {"seconds", Number(f.seconds)},
                   {"with", f.with},
                   {"mend", f.mend},
                   {"detail", f.detail},
                   {"probability", f.probability}});
  return all;
}

Json NoiseJson(const NoiseModel& noise) {
  Json all = Json::object();
  for (const auto& [channel, c] : noise.channels)
    all[channel] = {
        {"stated", Number(c.stated)}, {"estimated", Number(c.estimated)}, {"used", Number(c.used)}};
  return all;
}

Json SetJson(const std::vector<SetMember>& set) {
  Json all = Json::array();
  for (const SetMember& m : set)
    all.push_back({{"effect", m.effect}, {"target", m.target}, {"probability", m.probability}});
  return all;
}

Json RemainderJson(const Remainder& r) {
  Json where = Json::array();
  for (const RemainderPlace& p : r.where)
    where.push_back({{"record", p.record}, {"channel", p.channel}, {"ratio", Number(p.ratio)}});
  return {{"kind", ToText(r.kind)}, {"where", where}, {"text", r.text}};
}

Json ClosureJson(const Closure& c) {
  return {{"explained", c.explained},
          {"floors_before", Number(c.floors_before)},
          {"floors_after", Number(c.floors_after)},
          {"test", {{"before", Number(c.test_before)}, {"after", Number(c.test_after)}}}};
}

Json NuisancesJson(const std::vector<NuisanceFound>& nuisances) {
  Json all = Json::array();
  for (const NuisanceFound& n : nuisances)
    all.push_back({{"record", n.record},
                   {"name", n.name},
                   {"unit", n.unit},
                   {"value", Number(n.value)},
                   {"sd", Number(n.sd)}});
  return all;
}

/// The rig's toleranced parameters as the last fit has them.
Json ParametersJson(const FitResult& fit) {
  Json all = Json::array();
  for (std::size_t k = 0; k < fit.hypothesis.free.size(); ++k) {
    const FreeParameter& p = fit.hypothesis.free[k];
    if (p.effect >= 0) continue;
    all.push_back({{"path", p.path},
                   {"value", Number(p.value)},
                   {"sd", k < fit.sd.size() ? Number(fit.sd[k]) : Json(nullptr)},
                   {"drawing", Number(p.start)},
                   {"drawing_sd", Number(p.sd)}});
  }
  return all;
}

Json HiddenJson(const std::vector<VisibleSize>& hidden) {
  Json all = Json::array();
  for (const VisibleSize& v : hidden)
    all.push_back({{"effect", v.effect},
                   {"target", v.target},
                   {"parameter", v.parameter},
                   {"unit", v.unit},
                   {"size", Number(v.size)}});
  return all;
}

}  // namespace

Json CompareJson(const Comparison& c) {
  Json records = Json::array();
  for (const RecordComparison& r : c.records) {
    Json channels = Json::object(), blocks = Json::object();
    for (const ChannelError& e : r.channels)
      channels[e.channel] = {{"nrmse", Number(e.nrmse)},
                             {"rms_error", Number(e.rms_error)},
                             {"noise", Number(e.noise)},
                             {"ratio", Number(e.ratio)},
                             {"whiteness", Number(e.whiteness)}};
    for (const auto& [block, ratio] : r.blocks) blocks[block] = Number(ratio);
    records.push_back({{"data", r.data},
                       {"scenario", r.scenario},
                       {"use", r.test       ? "test"
                               : r.validate ? "validate"
                                            : "fit"},
                       {"ratio", Number(r.ratio)},
                       {"channels", channels},
                       {"blocks", blocks}});
  }
  return {{"records", records},
          {"ratio", Number(c.ratio)},
          {"ratio_fit", Number(c.ratio_fit)},
          {"ratio_validate", Number(c.ratio_validate)},
          {"data", DataJson(c.data)},
          {"noise", NoiseJson(c.noise)},
          {"words", c.words}};
}

Json ExplainJson(const Explanation& e) {
  Json adopted = Json::array(), confusable = Json::array(), ladder = Json::array(),
       screened = Json::array();
  for (const EffectInstance& a : e.adopted) {
    adopted.push_back(EffectJson(a));
    const auto further = e.further_sets.find(Named(a));
    if (further != e.further_sets.end()) adopted.back()["set"] = SetJson(further->second);
  }
  for (const Confusable& c : e.confusable) confusable.push_back({c.first, c.second, c.record});
  for (const LadderStep& s : e.ladder)
    ladder.push_back({{"added", s.added},
                      {"ratio_fit", Number(s.ratio_fit)},
                      {"ratio_validate", Number(s.ratio_validate)}});
  for (std::size_t k = 0; k < e.screened.size() && k < 20; ++k)
    screened.push_back({{"effect", e.screened[k].effect.name},
                        {"target", e.screened[k].effect.target},
                        {"ratio_validate", Number(e.screened[k].ratio_validate)}});
  Json out = {{"verdict", ToText(e.verdict)},
              {"ranking", RankingJson(e.ranking)},
              {"judged_beside", e.judged_beside},
              {"adopted", adopted},
              {"set", SetJson(e.set)},
              {"closure", ClosureJson(e.closure)},
              {"remainder", RemainderJson(e.remainder)},
              {"data", DataJson(e.data)},
              {"noise", NoiseJson(e.noise)},
              {"nuisances", NuisancesJson(e.nuisances)},
              {"hidden", HiddenJson(e.hidden)},
              {"base_ratio_validate", Number(e.base_ratio_validate)},
              {"final_ratio_validate", Number(e.final_ratio_validate)},
              {"nominal_ratio_validate", Number(e.nominal_ratio_validate)},
              {"confusable", confusable},
              {"second_round", RankingJson(e.second_round)},
              {"second_round_beside", e.second_beside},
              {"ladder", ladder},
              {"screened", screened},
              {"parameters", ParametersJson(e.final_fit)},
              {"parameter_shifts", e.parameter_shifts},
              {"warnings", e.warnings},
              {"seconds", e.seconds},
              {"simulated_records", e.runs}};
  if (e.verdict == ExplanationVerdict::kUnknown)
    out["unexplained"] = {{"block", e.unexplained.block},
                          {"where", e.unexplained.where},
                          {"dependence", e.unexplained.dependence},
                          {"frequencies", e.unexplained.frequencies},
                          {"text", e.unexplained.text},
                          {"formula", e.unexplained.formula}};
  return out;
}

}  // namespace ambrig
