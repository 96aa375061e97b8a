#include "discovery/practice/case_score.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/toml.h"

namespace ambrig {

CaseScore ScoreCase(const std::string& name, const Answer& answer, const Finding& finding) {
  CaseScore j = {name, answer, finding};
  const auto in = [](const std::vector<NamedEffect>& list, const NamedEffect& e) {
    return std::find(list.begin(), list.end(), e) != list.end();
  };
  j.verdict_right = std::find(answer.verdicts.begin(), answer.verdicts.end(), finding.verdict) !=
                    answer.verdicts.end();
  for (const auto& slot : answer.slots) {
    j.first_right = j.first_right || in(slot, finding.first);
    j.found += std::any_of(finding.adopted.begin(), finding.adopted.end(),
                           [&](const NamedEffect& e) { return in(slot, e); })
                   ? 1
                   : 0;
  }
  for (const NamedEffect& e : finding.adopted)
    j.invented += std::none_of(answer.slots.begin(), answer.slots.end(),
                               [&](const auto& slot) { return in(slot, e); })
                      ? 1
                      : 0;
  return j;
}

std::vector<Tally> Tallies(const std::vector<CaseScore>& all) {
  std::vector<Tally> out = {{"one effect: right one first"},
                            {"two effects: both found"},
                            {"no effect: none invented"},
                            {"outside the catalogue: unknown"},
                            {"verdict right"},
                            {"unseen error at most 1.5 floors where an effect is hidden"}};
  const auto count = [&](std::size_t k, bool right) {
    ++out[k].cases;
    out[k].right += right ? 1 : 0;
  };
  for (const CaseScore& j : all) {
    const std::size_t present = j.answer.slots.size();
    const bool unknown = std::find(j.answer.verdicts.begin(), j.answer.verdicts.end(), "unknown") !=
                         j.answer.verdicts.end();
    if (present == 1) count(0, j.first_right && j.verdict_right);
    if (present >= 2) count(1, j.found == present && j.verdict_right);
    if (present == 0) count(2, j.finding.adopted.empty());
    if (unknown) count(3, j.verdict_right);
    count(4, j.verdict_right);
    if (present > 0) count(5, j.finding.final_ratio <= 1.5);
  }
  std::erase_if(out, [](const Tally& t) { return t.cases == 0; });
  return out;
}

std::map<std::string, std::map<std::string, int>> Confusion(const std::vector<CaseScore>& all) {
  std::map<std::string, std::map<std::string, int>> out;
  for (const CaseScore& j : all) {
    const bool named = j.finding.verdict == "effect" && !j.finding.adopted.empty();
    if (j.answer.slots.empty()) {
      ++out[j.answer.verdicts.empty() ? "?" : j.answer.verdicts[0]]
           [named ? j.finding.adopted[0].first : j.finding.verdict];
      continue;
    }
    for (const auto& slot : j.answer.slots) {
      std::string given = j.finding.verdict;
      for (const NamedEffect& e : j.finding.adopted)
        if (std::find(slot.begin(), slot.end(), e) != slot.end()) given = e.first;
      if (named && given == "effect")
        given = j.finding.adopted[0].first +
                (j.finding.adopted[0].first == slot[0].first ? " elsewhere" : "");
      ++out[slot[0].first][given];
    }
  }
  return out;
}

std::map<std::string, Answer> ReadAnswers(const std::string& file) {
  const TomlTable root = TomlTable::FromFile(file);
  std::map<std::string, Answer> out;
  for (const std::string& name : root.Keys()) {
    const TomlTable t = *root.Table(name);
    Answer a;
    a.verdicts = t.Strings("verdict");
    for (const auto& row : t.TableRows("effects")) {
      a.slots.emplace_back();
      for (const TomlTable& e : row)
        a.slots.back().emplace_back(e.String("effect"), e.String("target"));
      if (a.slots.back().empty()) t.Fail("effects", "has an empty slot");
    }
    out[name] = a;
  }
  return out;
}

std::string SlotsText(const std::vector<std::vector<NamedEffect>>& slots) {
  std::string text;
  for (const auto& slot : slots) {
    std::string inside;
    for (const auto& [effect, target] : slot)
      inside += fmt::format("{}{{ effect = \"{}\", target = \"{}\" }}", inside.empty() ? "" : ", ",
                            effect, target);
    text += fmt::format("    [{}],\n", inside);
  }
  return text;
}

}  // namespace ambrig
