#include "campaign/plant_table.h"

#include <fmt/format.h>

#include <filesystem>

#include "campaign/plant_groups.h"
#include "campaign/plant_matrix.h"
#include "core/base/atomic_file.h"

namespace ambrig {

namespace {

std::string GroupOf(const Row& r) {
  return r.At("effect") == "mixture" ? "mixtures" : r.At("plant");
}

std::string FaultsCell(const FaultsOnPlants& f) {
  std::string text = fmt::format("{}/{}", f.found, f.runs);
  if (!f.delay.empty())
    text += fmt::format(", {:.2f}, {:.2f} ms", 1e3 * f.Delay(0.5), 1e3 * f.Delay(0.95));
  if (f.blamed > 0) text += fmt::format(", wrong coil {}", f.blamed);
  return text;
}

std::string Line(const std::string& name, const PlantGroup& g, const std::set<std::string>& kinds) {
  std::string text = fmt::format("| {} | {} | {} | {} | {} |", name, g.plants.size(),
                                 g.acted.size(), g.harmed.size(), g.doubtful.size());
  for (const std::string& kind : kinds) {
    const auto it = g.kinds.find(kind);
    text += it == g.kinds.end() ? " - |" : " " + FaultsCell(it->second) + " |";
  }
  return text + "\n";
}

std::string Table(const std::map<std::string, PlantGroup>& groups) {
  std::set<std::string> kinds;
  PlantGroup all;
  for (const auto& [name, g] : groups) {
    for (const auto& [kind, f] : g.kinds) kinds.insert(kind);
    all.Add(g, name + ":");
  }
  std::string text = "| plants with | plants | acted on | harmed | doubtful |";
  for (const std::string& kind : kinds) text += fmt::format(" {} |", kind);
  text += "\n|---|---|---|---|---|";
  for (std::size_t k = 0; k < kinds.size(); ++k) text += "---|";
  text += "\n";
  for (const auto& [name, g] : groups) text += Line(name, g, kinds);
  text += Line("**all**", all, kinds);
  const std::size_t n = all.plants.size();
  return text + fmt::format(
                    "\nHealthy plants acted on: at most {:.2g} % (one-sided 95 %); harmed: at most "
                    "{:.2g} %; {:.3g} healthy coil-periods, the model in doubt in {:.3g} % of "
                    "them.\n",
                    100 * UpperBound95(all.acted.size(), n),
                    100 * UpperBound95(all.harmed.size(), n), all.coil_periods,
                    100 * all.DoubtfulShare());
}

}  // namespace

std::string PlantTables(const Rows& rows) {
  std::map<std::string, std::map<std::string, PlantGroup>> tables;  // commissioned, effect and size
  for (const auto& [run, row] : rows)
    if (!row.At("plant").empty() && row.At("verdict") != "error")
      tables[row.At("commissioned")][GroupOf(row)].Add(row);
  std::string text;
  for (const auto& [learnt, groups] : tables)
    text += fmt::format("{}{}\n\n{}", text.empty() ? "" : "\n",
                        learnt == "yes" ? "Commissioned:" : "Not commissioned:", Table(groups));
  return text;
}

bool WritePlantTables(const std::string& folder, const Rows& rows) {
  const std::string text = PlantTables(rows);
  if (text.empty()) return false;
  const std::filesystem::path in(folder);
  WriteFileAtomically((in / "plants.md").string(),
                      "Faults: found of runs, median and 95 % delay.\n\n" + text);
  WriteFileAtomically((in / "matrix.md").string(), PlantMatrix(rows));
  return true;
}

}  // namespace ambrig
