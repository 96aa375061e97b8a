#include "app/json/watch_json.h"

#include <fmt/format.h>

#include <cmath>

#include "app/json/discovery_json.h"
#include "app/json/json_number.h"
#include "app/text/screen.h"
#include "effects/effect.h"

namespace ambrig {

namespace {

using Json = nlohmann::ordered_json;

Json MapJson(const std::map<std::string, double>& values) {
  Json out = Json::object();
  for (const auto& [name, v] : values) out[name] = FiniteOrNull(v);
  return out;
}

std::string LeftText(const LeftBand& b) {
  if (b.kind == "channel")
    return b.name +
           " says nothing any more: it is empty or stands still, and the reference's does not";
  if (b.kind == "error")
    return fmt::format("the error is {:.2f} times the noise with parameters of its own, was {:.2f}",
                       b.value, b.was);
  if (b.kind == "noise")
    return fmt::format("the noise of {} is {:.3g} times what it was", b.name, b.value / b.was);
  const std::string unit = b.unit == "-" ? "" : b.unit;
  return fmt::format("{} = {}, was {} ({:+.1f} sd)", b.name, ScreenSi(b.value, unit, 5),
                     ScreenSi(b.was, unit, 5), b.sds);
}

/// One sentence for the log of a machine.
std::string ExplanationText(const Explanation& e) {
  std::string names;
  for (const SetMember& m : e.set)
    names += fmt::format("{}{} ({:.0f} %)", names.empty() ? "" : ", ",
                         NameAtTarget(m.effect, m.target), 100 * m.probability);
  if (e.verdict == ExplanationVerdict::kEffect) return "explained by " + names;
  if (e.verdict == ExplanationVerdict::kNone)
    return "no effect is needed: the rig file explains the record";
  if (e.verdict == ExplanationVerdict::kData) return "the data of the record are wrong";
  if (e.verdict == ExplanationVerdict::kUnknown)
    return "no effect of the catalogue explains it; nearest: " + names;
  std::string shifts;
  for (const std::string& s : e.parameter_shifts) shifts += (shifts.empty() ? "" : ", ") + s;
  return "explained by parameters of the rig" + (shifts.empty() ? "" : ": " + shifts);
}

}  // namespace

Json StateJson(const RecordState& s, const RecordState* reference) {
  Json parameters = Json::object();
  for (const StateParameter& p : s.parameters) {
    Json one{{"value", FiniteOrNull(p.value)}, {"sd", FiniteOrNull(p.sd)}, {"unit", p.unit}};
    for (std::size_t k = 0; reference && k < reference->parameters.size(); ++k) {
      if (reference->parameters[k].path != p.path) continue;
      const LeftBand b = ParameterBand(p, reference->parameters[k], s.parameters.size());
      one.update({{"was", b.was}, {"least", b.least}, {"greatest", b.greatest}, {"sds", b.sds}});
    }
    parameters[p.path] = one;
  }
  Json out{{"ratio", FiniteOrNull(s.ratio)},
           {"ratio_fitted", FiniteOrNull(s.ratio_fitted)},
           {"explained", FiniteOrNull(s.explained)},
           {"effective_sample_size", FiniteOrNull(s.effective_sample_size)},
           {"noise", MapJson(s.noise)},
           {"floors", MapJson(s.floors)},
           {"parameters", parameters}};
  for (const DataFault& f : s.faults)
    out["data_faults"].push_back({{"channel", f.channel},
                                  {"fault", f.fault},
                                  {"mend", f.mend},
                                  {"probability", f.probability},
                                  {"text", FaultText(f)}});
  return out;
}

RecordState ReferenceFromJson(const Json& json) {
  RecordState s;
  s.ratio = json.at("ratio").get<double>();
  s.ratio_fitted = json.at("ratio_fitted").get<double>();
  s.effective_sample_size = json.at("effective_sample_size").get<double>();
  for (const auto& [channel, noise] : json.at("noise").items())
    if (noise.is_number()) s.noise[channel] = noise.get<double>();
  for (const auto& [channel, ratio] : json.at("floors").items())
    if (ratio.is_number()) s.floors[channel] = ratio.get<double>();
  for (const auto& [path, p] : json.at("parameters").items())
    if (p.at("value").is_number() && p.at("sd").is_number())
      s.parameters.push_back({path, p.at("unit").get<std::string>(), p.at("value").get<double>(),
                              p.at("sd").get<double>()});
  return s;
}

Json LeftJson(const std::vector<LeftBand>& left) {
  Json out = Json::array();
  for (const LeftBand& b : left)
    out.push_back({{"kind", b.kind},
                   {"name", b.name},
                   {"unit", b.unit},
                   {"value", FiniteOrNull(b.value)},
                   {"was", FiniteOrNull(b.was)},
                   {"least", FiniteOrNull(b.least)},
                   {"greatest", FiniteOrNull(b.greatest)},
                   {"sds", FiniteOrNull(b.sds)},
                   {"text", LeftText(b)}});
  return out;
}

Json WatchExplanationJson(const Explanation& e) {
  const Json all = ExplainJson(e);
  return {{"verdict", ToText(e.verdict)},
          {"set", all["set"]},
          {"adopted", all["adopted"]},
          {"parameter_shifts", e.parameter_shifts},
          {"text", ExplanationText(e)}};
}

}  // namespace ambrig
