#include "app/json/event_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

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

double First(const EventDifference& e) {
  if (e.kind == EventDifference::Kind::kMoved) return std::min(e.before, e.after);
  return e.kind == EventDifference::Kind::kCame ? e.after : e.before;
}

}  // namespace

std::vector<EventDifference> CompareEvents(const nlohmann::json& a, const nlohmann::json& b,
                                           double tolerance) {
  using Kind = EventDifference::Kind;
  std::vector<EventDifference> out;
  Times before = TimesOf(a), after = TimesOf(b);
  for (const auto& [name, ignored] : after) before.try_emplace(name);
  for (const auto& [name, old] : before) {
    const std::vector<double>& now = after[name];
    for (std::size_t k = 0; k < std::max(old.size(), now.size()); ++k) {
      if (k >= now.size())
        out.push_back({Kind::kWent, name, old[k], 0});
      else if (k >= old.size())
        out.push_back({Kind::kCame, name, 0, now[k]});
      else if (std::abs(old[k] - now[k]) > tolerance)
        out.push_back({Kind::kMoved, name, old[k], now[k]});
    }
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
