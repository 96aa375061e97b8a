#include "app/commands/new_questions.h"

#include <fmt/format.h>

#include <cmath>

#include "app/commands/new_templates.h"
#include "app/json/json_number.h"

namespace ambrig {

namespace {

/// The questions of every template, for a page that asks them.
nlohmann::ordered_json QuestionsJson() {
  nlohmann::ordered_json templates = nlohmann::ordered_json::array();
  for (const BenchTemplate& t : BenchTemplates()) {
    nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
    for (const BenchNumber& n : t.numbers)
      numbers.push_back({{"key", n.key},
                         {"unit", n.unit},
                         {"doc", n.doc},
                         {"lo", n.lo},
                         {"hi", n.hi},
                         {"fallback", FiniteOrNull(n.fallback)}});
    templates.push_back({{"name", t.name}, {"doc", t.doc}, {"numbers", numbers}});
  }
  return {{"templates", templates}};
}

}  // namespace

int ListQuestions(const CommonOptions& common) {
  for (const BenchTemplate& t : BenchTemplates()) {
    fmt::print("{}: {}\n", t.name, t.doc);
    for (const BenchNumber& n : t.numbers)
      fmt::print("  {:<22} {:<6} {}{}\n", n.key, n.unit, n.doc,
                 std::isnan(n.fallback) ? "" : fmt::format(" (else {:g})", n.fallback));
  }
  common.WriteJson(QuestionsJson());
  return 0;
}

nlohmann::ordered_json BenchJson(const std::vector<std::string>& files,
                                 const std::vector<ColumnChoice>& choices) {
  nlohmann::ordered_json columns = nlohmann::ordered_json::array();
  for (const ColumnChoice& c : choices)
    columns.push_back({{"channel", c.channel},
                       {"column", c.column},
                       {"unit", c.unit},
                       {"gain", c.gain},
                       {"reason", c.reason}});
  return {{"files", files}, {"columns", columns}};
}

}  // namespace ambrig
