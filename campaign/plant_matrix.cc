#include "campaign/plant_matrix.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "campaign/plant_groups.h"
#include "campaign/plants.h"

namespace ambrig {

namespace {

constexpr std::array kSizes = {"low", "typical", "high"};
constexpr std::array kTimes = {0.25e-3, 0.5e-3,
                               3e-3};  // [s], in which faults are wanted to be found

/// All plants with one effect, its sizes apart; a mixture has no size.
struct EffectGroups {
  std::string effect;
  std::map<std::string, PlantGroup> sizes;
  PlantGroup all;
};

std::string EffectOf(const Row& r) {
  return r.At("effect") == "mixture" ? "mixtures of effects"
         : r.At("effect") == "none"  ? "no effect"
                                     : r.At("effect");
}

std::string SizeOf(const Row& r) {
  for (const char* size : kSizes)
    if (r.At("effect") != "mixture" && r.At("plant").ends_with(std::string(" ") + size))
      return size;
  return "";
}

/// In the order of the rows, mixtures last; the last entry holds everything.
std::vector<EffectGroups> ByEffect(const std::vector<const Row*>& rows) {
  std::vector<EffectGroups> out;
  EffectGroups all;
  all.effect = "**all**";
  for (const Row* r : rows) {
    const std::string effect = EffectOf(*r);
    auto it = std::ranges::find(out, effect, &EffectGroups::effect);
    if (it == out.end()) {
      out.emplace_back();
      it = out.end() - 1;
      it->effect = effect;
    }
    it->sizes[SizeOf(*r)].Add(*r);
  }
  for (EffectGroups& g : out) {
    for (const auto& [size, group] : g.sizes) g.all.Add(group, size + ":");
    all.all.Add(g.all, g.effect + ":");
  }
  out.push_back(std::move(all));
  return out;
}

/// The weakest size at which a fault is missed or a healthy coil is blamed.
std::string BreaksAt(const EffectGroups& g, const std::string& kind) {
  for (const char* size : kSizes) {
    const auto at = g.sizes.find(size);
    if (at == g.sizes.end()) continue;
    const auto f = at->second.kinds.find(kind);
    if (f != at->second.kinds.end() && !f->second.complete())
      return fmt::format("{} ({})", size, EffectSizeText(g.effect, size));
  }
  return "";
}

std::string FaultCell(const EffectGroups& g, const std::string& kind) {
  const auto it = g.all.kinds.find(kind);
  if (it == g.all.kinds.end()) return "-";
  const FaultsOnPlants& f = it->second;
  std::string text = fmt::format("{}/{}", f.found, f.runs);
  if (!f.delay.empty())
    text += fmt::format("; {:.2f}, {:.2f} ms", 1e3 * f.Delay(0.5), 1e3 * f.Delay(0.95));
  if (f.blamed > 0) text += fmt::format("; wrong coil {}", f.blamed);
  const std::string breaks = BreaksAt(g, kind);
  return breaks.empty() ? text : text + "; breaks at " + breaks;
}

std::string FaultTable(const std::vector<EffectGroups>& groups) {
  const std::map<std::string, FaultsOnPlants>& kinds = groups.back().all.kinds;
  if (kinds.empty()) return "";
  std::string text = "| effect | plants |", rule = "|---|---|";
  for (const auto& [kind, f] : kinds) {
    text += fmt::format(" {} |", kind);
    rule += "---|";
  }
  text += " in contact with, without |\n" + rule + "---|\n";
  for (const EffectGroups& g : groups) {
    std::size_t lost = 0, lost_alone = 0;
    text += fmt::format("| {} | {} |", g.effect, g.all.plants.size());
    for (const auto& [kind, f] : kinds) text += fmt::format(" {} |", FaultCell(g, kind));
    for (const auto& [kind, f] : g.all.kinds) {
      lost += f.lost;
      lost_alone += f.lost_alone;
    }
    text += fmt::format(" {}, {} |\n", lost, lost_alone);
  }
  return text;
}

/// Rounded down, so that 100 % means all.
std::string ShareText(std::size_t some, std::size_t of) {
  if (of == 0) return "-";
  return fmt::format("{:g} %",
                     std::floor(1e3 * static_cast<double>(some) / static_cast<double>(of)) / 10);
}

std::string CountCell(const std::set<std::string>& some, const PlantGroup& g) {
  const double bound = 100 * UpperBound95(some.size(), g.plants.size());
  return fmt::format("{}/{}, < {} %", some.size(), g.plants.size(),
                     bound < 10 ? fmt::format("{:.2g}", bound) : fmt::format("{:.0f}", bound));
}

std::string HealthyTable(const std::vector<EffectGroups>& groups) {
  std::string text =
      "| effect | false alarm | acted on | harmed | model doubtful, of the time | orbit with, "
      "without |\n"
      "|---|---|---|---|---|---|\n";
  for (const EffectGroups& g : groups) {
    if (g.all.plants.empty()) continue;
    const std::string orbits = g.all.orbit > 0 ? fmt::format("{:.3g}, {:.3g} um", 1e6 * g.all.orbit,
                                                             1e6 * g.all.orbit_without)
                                               : "-";
    text += fmt::format("| {} | {} | {} | {} | {}, {:.3g} % | {} |\n", g.effect,
                        CountCell(g.all.alarmed, g.all), CountCell(g.all.acted, g.all),
                        CountCell(g.all.harmed, g.all), g.all.doubtful.size(),
                        100 * g.all.DoubtfulShare(), orbits);
  }
  return text;
}

std::string TimeLine(const std::string& kind, const std::string& set, const FaultsOnPlants& f) {
  std::string text = fmt::format("| {} | {} | {}/{} |", kind, set, f.found, f.runs);
  text += f.delay.empty()
              ? " - |"
              : fmt::format(" {:.2f}, {:.2f} ms |", 1e3 * f.Delay(0.5), 1e3 * f.Delay(0.95));
  for (const double t : kTimes) text += " " + ShareText(f.FoundWithin(t), f.runs) + " |";
  return text + fmt::format(" {} |\n", f.blamed);
}

/// A line for each kind of fault, and where several sets of coils fail one for each of them.
std::string TimeTable(const std::vector<const Row*>& rows) {
  std::map<std::string, PlantGroup> sets;
  PlantGroup all;
  for (const Row* r : rows)
    if (r->Number("failed") > 0) {
      sets[r->At("set")].Add(*r);
      all.Add(*r);
    }
  if (sets.empty()) return "";
  std::string text = "| fault | coils | found | median, 95 % |", rule = "|---|---|---|---|";
  for (const double t : kTimes) {
    text += fmt::format(" within {:g} ms |", 1e3 * t);
    rule += "---|";
  }
  text += " wrong coil |\n" + rule + "---|\n";
  for (const auto& [kind, f] : all.kinds) {
    text += TimeLine(kind, sets.size() > 1 ? "all" : sets.begin()->first, f);
    for (const auto& [set, g] : sets)
      if (const auto of = g.kinds.find(kind); sets.size() > 1 && of != g.kinds.end())
        text += TimeLine(kind, set, of->second);
  }
  return text;
}

}  // namespace

std::string PlantMatrix(const Rows& rows) {
  std::string text;
  for (const char* learnt : {"yes", "no"}) {
    std::vector<const Row*> some;
    for (const auto& [run, row] : rows)
      if (!row.At("plant").empty() && row.At("verdict") != "error" &&
          row.At("commissioned") == learnt)
        some.push_back(&row);
    if (some.empty()) continue;
    std::ranges::stable_partition(some, [](const Row* r) { return r->At("effect") != "mixture"; });
    const std::vector<EffectGroups> groups = ByEffect(some);
    const std::string name =
        learnt == std::string("yes") ? "Commissioned plants" : "Plants that were not commissioned";
    text +=
        fmt::format("{}**{}, faults**\n\n{}\n", text.empty() ? "" : "\n", name, FaultTable(groups));
    const std::string times = TimeTable(some);
    if (!times.empty()) text += fmt::format("**{}, faults in time**\n\n{}\n", name, times);
    text += fmt::format("**{}, healthy**\n\n{}", name, HealthyTable(groups));
  }
  return text;
}

}  // namespace ambrig
