#include "discovery/practice/practice_result.h"

#include <algorithm>

#include "effects/effect.h"

namespace ambrig {

namespace {

constexpr int kBins = 10;

bool Contains(const std::vector<std::string>& all, const std::string& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

std::string EffectsText(const std::vector<NamedEffect>& effects) {
  std::string text;
  for (const auto& [effect, target] : effects)
    text += (text.empty() ? "" : " + ") + NameAtTarget(effect, target);
  return text;
}

bool AllRight(const PracticeResult& r) {
  return r.failure.empty() && ScoreCase(r.name, r.answer, r.finding).right();
}

/// What was said of a hidden family: its effect, the same elsewhere, another effect, a verdict.
std::string SaidOf(const PracticeResult& r, std::size_t slot) {
  if (!r.failure.empty()) return "failed";
  const auto& names = r.answer.slots.at(slot);
  for (const NamedEffect& e : r.finding.adopted)
    if (std::find(names.begin(), names.end(), e) != names.end()) return "right effect";
  for (const NamedEffect& e : r.finding.adopted)
    if (e.first == names[0].first) return "right effect elsewhere";
  return r.finding.adopted.empty() ? r.finding.verdict : r.finding.adopted[0].first;
}

PracticeCount Count(const std::string& kind, const std::vector<const PracticeResult*>& results,
                    const CalibrationTable* table) {
  PracticeCount c;
  c.kind = kind;
  std::size_t right = 0, verdict = 0, in_set = 0, members = 0;
  for (const PracticeResult* r : results) {
    right += AllRight(*r) ? 1 : 0;
    verdict += Contains(r->answer.verdicts, r->finding.verdict) ? 1 : 0;
    const JudgedResult j = JudgeResult(*r, table);
    in_set += j.in_set ? 1 : 0;
    members += j.set_size;
  }
  const std::size_t n = results.size();
  c.right = ShareOf(right, n);
  c.verdict = ShareOf(verdict, n);
  c.in_set = ShareOf(in_set, n);
  c.mean_set = n > 0 ? static_cast<double>(members) / static_cast<double>(n) : 0;
  return c;
}

void CountWrongData(const PracticeResult& r, PracticeSummary& s, std::size_t& recognised,
                    std::size_t& of) {
  ++of;
  recognised += r.finding.verdict == "data" ? 1 : 0;
  const std::string fault = r.mistake.substr(0, r.mistake.find(':'));
  ++s.by_mistake[fault][r.finding.adopted.empty() ? r.finding.verdict : r.finding.adopted[0].first];
  for (const StatedMember& m : r.stated.members)
    if (!m.target.empty() && m.probability > 0.5) {
      ++s.named_from_wrong_data;
      break;
    }
}

}  // namespace

PracticeResult ResultOf(const PracticeCase& c, const Explanation& e) {
  PracticeResult r = {c.name,    c.kind, c.rig,      c.noise,   c.nuisances,
                      c.mistake, c.laws, c.families, c.for_fit, c.worst_ratio,
                      c.answer,  {},     {},         {},        ""};
  r.finding.verdict = ToText(e.verdict);
  if (!e.ranking.empty()) r.finding.first = {e.ranking[0].effect.name, e.ranking[0].effect.target};
  for (const EffectInstance& a : e.adopted) r.finding.adopted.emplace_back(a.name, a.target);
  r.finding.nominal_ratio = e.nominal_ratio_validate;
  r.finding.final_ratio = e.final_ratio_validate;
  r.finding.seconds = e.seconds;
  r.stated = StatedAnswerOf(e);
  r.set = e.set;
  return r;
}

bool IsRightAnswer(const Answer& answer, const std::string& effect, const std::string& target) {
  if (effect == "quiet" || effect == "none" || effect == "parameters")
    return Contains(answer.verdicts, "none") || Contains(answer.verdicts, "parameters");
  if (effect == "unknown" || effect == "data") return Contains(answer.verdicts, effect);
  return std::any_of(answer.slots.begin(), answer.slots.end(), [&](const auto& slot) {
    return std::find(slot.begin(), slot.end(), NamedEffect{effect, target}) != slot.end();
  });
}

JudgedResult JudgeResult(const PracticeResult& r, const CalibrationTable* table) {
  JudgedResult j;
  if (!r.failure.empty() || r.stated.members.empty()) return j;
  std::vector<double> p;
  for (const StatedMember& m : r.stated.members) p.push_back(m.probability);
  if (table) p = CalibratedProbabilities(table->weights, r.stated);
  const auto best = static_cast<std::size_t>(std::max_element(p.begin(), p.end()) - p.begin());
  const StatedMember& m = r.stated.members[best];
  j.best = {p[best], IsRightAnswer(r.answer, m.effect, m.target)};
  const std::vector<SetMember> set = table ? CalibratedSet(*table, r.stated, "quiet") : r.set;
  j.set_size = set.size();
  j.in_set = std::any_of(set.begin(), set.end(), [&](const SetMember& s) {
    return IsRightAnswer(r.answer, s.effect, s.target);
  });
  return j;
}

PracticeSummary Summarise(const std::vector<PracticeResult>& results,
                          const CalibrationTable* table) {
  PracticeSummary s;
  s.cases = results.size();
  std::vector<const PracticeResult*> all;
  std::map<std::string, std::vector<const PracticeResult*>> kinds;
  std::vector<JudgedStatement> statements;
  std::size_t recognised = 0, wrong_data = 0;
  for (const PracticeResult& r : results) {
    s.failed += r.failure.empty() ? 0 : 1;
    all.push_back(&r);
    kinds[r.kind].push_back(&r);
    if (r.failure.empty()) statements.push_back(JudgeResult(r, table).best);
    if (r.kind == "data") {
      CountWrongData(r, s, recognised, wrong_data);
      continue;
    }
    for (std::size_t k = 0; k < r.families.size(); ++k)
      ++s.by_family[r.families[k]][k < r.answer.slots.size() ? SaidOf(r, k) : SaidText(r)];
  }
  s.counts.push_back(Count("all", all, table));
  for (const auto& [kind, members] : kinds) s.counts.push_back(Count(kind, members, table));
  s.bins = ReliabilityDiagram(statements, kBins);
  s.error = ExpectedCalibrationError(statements, kBins);
  s.data_recognised = ShareOf(recognised, wrong_data);
  return s;
}

std::vector<CalibrationCase> CalibrationCases(const std::vector<PracticeResult>& results) {
  std::vector<CalibrationCase> out;
  for (const PracticeResult& r : results) {
    if (!r.failure.empty()) continue;
    CalibrationCase c = {r.stated, {}};
    for (const StatedMember& m : r.stated.members)
      c.right.push_back(IsRightAnswer(r.answer, m.effect, m.target) ? 1 : 0);
    out.push_back(std::move(c));
  }
  return out;
}

std::string SaidText(const PracticeResult& r) {
  if (!r.failure.empty()) return "failed: " + r.failure;
  return r.finding.adopted.empty() ? r.finding.verdict : EffectsText(r.finding.adopted);
}

std::string HiddenText(const PracticeResult& r) {
  std::vector<NamedEffect> first;
  for (const auto& slot : r.answer.slots) first.push_back(slot[0]);
  if (r.answer.slots.empty()) return r.answer.verdicts.empty() ? "?" : r.answer.verdicts[0];
  return EffectsText(first);
}

}  // namespace ambrig
