#include "app/json/event_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/errors.h"

namespace ambrig {

namespace {

using Times = std::map<std::string, std::vector<double>>;  // of every kind of event [s]

Times TimesOf(const nlohmann::json& events) {
  Times out;
  for (const auto& e : events) {
    std::string name = e.value("kind", "") + " " + e.value("target", "");
    if (e.contains("class")) name += " (" + e["class"].get<std::string>() + ")";
    out[name].push_back(e.value("t", 0.0));
  }
  return out;
}

/// Which of `longer` belongs to each of `shorter` (times in order): the choice that moves them
/// least in all, so that one event more does not make all later ones look moved.
std::vector<std::size_t> PartnersOf(const std::vector<double>& shorter,
                                    const std::vector<double>& longer) {
  constexpr std::size_t kMostCells = 4'000'000;
  const std::size_t n = shorter.size(), more = longer.size() - n;
  std::vector<std::size_t> partner(n);
  for (std::size_t i = 0; i < n; ++i) partner[i] = i;
  if (more == 0 || n * (more + 1) > kMostCells) return partner;
  // least[i][k]: of the first i, of which the last belongs to number i - 1 + k at most
  std::vector<std::vector<double>> least(n + 1, std::vector<double>(more + 1, 0));
  const auto cost = [&](std::size_t i, std::size_t k) {
    return least[i - 1][k] + std::abs(shorter[i - 1] - longer[i - 1 + k]);
  };
  for (std::size_t i = 1; i <= n; ++i)
    for (std::size_t k = 0; k <= more; ++k)
      least[i][k] = k == 0 ? cost(i, 0) : std::min(least[i][k - 1], cost(i, k));
  std::size_t k = more;
  for (std::size_t i = n; i > 0; --i) {
    while (k > 0 && least[i][k - 1] <= cost(i, k)) --k;
    partner[i - 1] = i - 1 + k;
  }
  return partner;
}

double First(const EventDifference& e) {
  if (e.kind == EventDifference::Kind::kMoved) return std::min(e.before, e.after);
  return e.kind == EventDifference::Kind::kCame ? e.after : e.before;
}

}  // namespace

void CheckEvents(const nlohmann::json& events, const std::string& file) {
  for (std::size_t k = 0; k < events.size(); ++k) {
    const nlohmann::json& e = events[k];
    bool sound = e.is_object() && (!e.contains("t") || e["t"].is_number());
    for (const char* text : {"kind", "target", "class"})
      sound = sound && (!e.contains(text) || e[text].is_string());
    if (!sound)
      throw InputError(fmt::format(
          "{}: events[{}] is no event of a run, allowed: objects with a number t and texts kind, "
          "target, class",
          file, k));
  }
}

std::vector<EventDifference> CompareEvents(const nlohmann::json& a, const nlohmann::json& b,
                                           double tolerance) {
  using Kind = EventDifference::Kind;
  std::vector<EventDifference> out;
  Times before = TimesOf(a), after = TimesOf(b);
  for (const auto& [name, ignored] : after) before.try_emplace(name);
  for (const auto& [name, old] : before) {
    const std::vector<double>& now = after[name];
    const bool fewer = old.size() <= now.size();
    const std::vector<double>&shorter = fewer ? old : now, &longer = fewer ? now : old;
    std::vector<bool> alone(longer.size(), true);
    const std::vector<std::size_t> partner = PartnersOf(shorter, longer);
    for (std::size_t k = 0; k < shorter.size(); ++k) {
      alone[partner[k]] = false;
      const double was = fewer ? shorter[k] : longer[partner[k]],
                   is = fewer ? longer[partner[k]] : shorter[k];
      if (std::abs(was - is) > tolerance) out.push_back({Kind::kMoved, name, was, is});
    }
    for (std::size_t k = 0; k < longer.size(); ++k)
      if (alone[k])
        out.push_back(fewer ? EventDifference{Kind::kCame, name, 0, longer[k]}
                            : EventDifference{Kind::kWent, name, longer[k], 0});
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const auto& x, const auto& y) { return First(x) < First(y); });
  return out;
}

std::string EventDifferenceText(const EventDifference& e) {
  switch (e.kind) {
    case EventDifference::Kind::kCame:
      return fmt::format("{} is new, at {:.6g} ms", e.event, e.after * 1e3);
    case EventDifference::Kind::kWent:
      return fmt::format("{} is gone, was at {:.6g} ms", e.event, e.before * 1e3);
    case EventDifference::Kind::kMoved:
      return fmt::format("{} moved from {:.6g} ms to {:.6g} ms", e.event, e.before * 1e3,
                         e.after * 1e3);
  }
  return "";
}

}  // namespace ambrig
