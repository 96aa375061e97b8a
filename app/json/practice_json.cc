#include "app/json/practice_json.h"

#include <cmath>

namespace ambrig {

namespace {

using Json = nlohmann::ordered_json;

Json PairsJson(const std::vector<NamedEffect>& effects) {
  Json all = Json::array();
  for (const auto& [effect, target] : effects) all.push_back({effect, target});
  return all;
}

std::vector<NamedEffect> PairsOf(const Json& all) {
  std::vector<NamedEffect> out;
  for (const Json& e : all)
    out.emplace_back(e.at(0).get<std::string>(), e.at(1).get<std::string>());
  return out;
}

template <class Member>
Json MembersJson(const std::vector<Member>& members) {
  Json all = Json::array();
  for (const Member& m : members) all.push_back({m.effect, m.target, m.probability});
  return all;
}

template <class Member>
std::vector<Member> MembersOf(const Json& all) {
  std::vector<Member> out;
  for (const Json& m : all)
    out.push_back({m.at(0).get<std::string>(), m.at(1).get<std::string>(), m.at(2).get<double>()});
  return out;
}

Json FiniteJson(double v) { return std::isfinite(v) ? Json(v) : Json(nullptr); }
double FiniteOf(const Json& v) { return v.is_number() ? v.get<double>() : INFINITY; }

Json ShareJson(const Share& s) {
  return {{"right", s.right}, {"of", s.of}, {"share", s.value}, {"lo", s.lo}, {"hi", s.hi}};
}

Json SummaryJson(const PracticeSummary& s) {
  Json counts = Json::array(), bins = Json::array();
  for (const PracticeCount& c : s.counts)
    counts.push_back({{"kind", c.kind},
                      {"right", ShareJson(c.right)},
                      {"verdict_right", ShareJson(c.verdict)},
                      {"in_set", ShareJson(c.in_set)},
                      {"mean_set", c.mean_set}});
  for (const ReliabilityBin& b : s.bins)
    bins.push_back(
        {{"lo", b.lo}, {"hi", b.hi}, {"count", b.count}, {"stated", b.stated}, {"found", b.found}});
  return {{"cases", s.cases},
          {"failed", s.failed},
          {"counts", counts},
          {"reliability", bins},
          {"calibration_error",
           {{"value", s.error.value}, {"sd", s.error.sd}, {"by_chance", s.error.by_chance}}},
          {"data_recognised", ShareJson(s.data_recognised)},
          {"named_from_wrong_data", s.named_from_wrong_data},
          {"by_family", s.by_family},
          {"by_mistake", s.by_mistake}};
}

}  // namespace

Json PracticeResultJson(const PracticeResult& r) {
  Json slots = Json::array();
  for (const auto& slot : r.answer.slots) slots.push_back(PairsJson(slot));
  return {{"case", r.name},
          {"kind", r.kind},
          {"rig", r.rig},
          {"noise", r.noise},
          {"nuisances", r.nuisances},
          {"mistake", r.mistake},
          {"laws", r.laws},
          {"families", r.families},
          {"use", r.for_fit ? "fit" : "check"},
          {"worst_ratio", FiniteJson(r.worst_ratio)},
          {"right_verdicts", r.answer.verdicts},
          {"hidden", slots},
          {"verdict", r.finding.verdict},
          {"first", PairsJson({r.finding.first})},
          {"adopted", PairsJson(r.finding.adopted)},
          {"nominal_ratio", FiniteJson(r.finding.nominal_ratio)},
          {"final_ratio", FiniteJson(r.finding.final_ratio)},
          {"seconds", r.finding.seconds},
          {"members", MembersJson(r.stated.members)},
          {"features", r.stated.features},
          {"set", MembersJson(r.set)},
          {"failure", r.failure}};
}

PracticeResult PracticeResultOf(const Json& j) {
  PracticeResult r;
  const auto text = [&](const char* key) { return j.at(key).get<std::string>(); };
  r.name = text("case");
  r.kind = text("kind");
  r.rig = text("rig");
  r.noise = text("noise");
  r.nuisances = text("nuisances");
  r.mistake = text("mistake");
  r.laws = j.at("laws").get<std::vector<std::string>>();
  r.families = j.at("families").get<std::vector<std::string>>();
  r.for_fit = text("use") == "fit";
  r.worst_ratio = FiniteOf(j.at("worst_ratio"));
  r.answer.verdicts = j.at("right_verdicts").get<std::vector<std::string>>();
  for (const Json& slot : j.at("hidden")) r.answer.slots.push_back(PairsOf(slot));
  r.finding.verdict = text("verdict");
  r.finding.first = PairsOf(j.at("first")).at(0);
  r.finding.adopted = PairsOf(j.at("adopted"));
  r.finding.nominal_ratio = FiniteOf(j.at("nominal_ratio"));
  r.finding.final_ratio = FiniteOf(j.at("final_ratio"));
  r.finding.seconds = j.at("seconds").get<double>();
  r.stated.members = MembersOf<StatedMember>(j.at("members"));
  r.stated.features = j.at("features").get<std::array<double, kCalibrationFeatures>>();
  r.set = MembersOf<SetMember>(j.at("set"));
  r.failure = text("failure");
  return r;
}

Json PracticeJson(const std::vector<PracticeResult>& results, const PracticeSummary& as_computed,
                  const PracticeSummary* calibrated) {
  Json cases = Json::array();
  for (const PracticeResult& r : results) {
    Json j = PracticeResultJson(r);
    j["said"] = SaidText(r);
    j["right"] = r.failure.empty() && ScoreCase(r.name, r.answer, r.finding).right();
    j["in_set"] = JudgeResult(r, nullptr).in_set;
    cases.push_back(std::move(j));
  }
  Json out = {{"as_computed", SummaryJson(as_computed)}};
  if (calibrated) out["calibrated_on_other_families"] = SummaryJson(*calibrated);
  out["cases"] = cases;
  return out;
}

}  // namespace ambrig
