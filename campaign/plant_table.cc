#include "campaign/plant_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/base/atomic_file.h"

namespace ambrig {

namespace {

constexpr double kHarmedOrbit = 1.1;  // times that without fault tolerance

struct Found {
  std::size_t runs = 0, found = 0, blamed = 0;  // blamed: a coil without a fault was acted on
  std::vector<double> delay;                    // [s]
};

/// All rows of one effect and size.
struct Group {
  std::set<std::string> plants, acted, harmed, doubtful;  // healthy runs
  double coil_periods = 0;
  std::map<std::string, Found> kinds;
};

int Rank(const std::string& verdict) {
  return verdict == "up" ? 0 : verdict == "touchdown" ? 1 : 2;
}

bool Harmed(const Row& r) {
  const std::string& without = r.At("verdict_without");
  if (without.empty()) return false;
  if (Rank(r.At("verdict")) != Rank(without)) return Rank(r.At("verdict")) > Rank(without);
  return without == "up" && r.Number("peak_orbit") > kHarmedOrbit * r.Number("orbit_without");
}

std::string GroupOf(const Row& r) {
  return r.At("effect") == "mixture" ? "mixtures" : r.At("plant");
}

void AddToGroup(const Row& r, Group* g) {
  const std::string plant = r.At("plant") + " " + r.At("spread");
  const bool acted = r.Number("false_actions") > 0;
  if (r.Number("failed") > 0) {
    Found& f = g->kinds[r.At("kind")];
    ++f.runs;
    f.blamed += acted;
    f.found += r.Number("detected") >= r.Number("failed");
    if (!r.At("detection_delay").empty()) f.delay.push_back(r.Number("detection_delay"));
    return;
  }
  g->plants.insert(plant);
  g->coil_periods += r.Number("coil_periods");
  if (acted) g->acted.insert(plant);
  if (Harmed(r)) g->harmed.insert(plant);
  if (r.At("doubtful") == "yes") g->doubtful.insert(plant);
}

void Append(const Group& from, Group* to, const std::string& prefix) {
  for (const auto& [of, set] : {std::pair{&from.plants, &to->plants},
                                {&from.acted, &to->acted},
                                {&from.harmed, &to->harmed},
                                {&from.doubtful, &to->doubtful}})
    for (const std::string& p : *of) set->insert(prefix + p);
  to->coil_periods += from.coil_periods;
  for (const auto& [kind, f] : from.kinds) {
    Found& sum = to->kinds[kind];
    sum.runs += f.runs;
    sum.found += f.found;
    sum.blamed += f.blamed;
    sum.delay.insert(sum.delay.end(), f.delay.begin(), f.delay.end());
  }
}

double QuantileOf(std::vector<double> v, double share) {
  std::sort(v.begin(), v.end());
  const auto last = static_cast<double>(v.size() - 1);
  return v[static_cast<std::size_t>(std::ceil(share * last))];
}

std::string Text(const Found& f) {
  std::string text = fmt::format("{}/{}", f.found, f.runs);
  if (!f.delay.empty())
    text += fmt::format(", {:.2f}, {:.2f} ms", 1e3 * QuantileOf(f.delay, 0.5),
                        1e3 * QuantileOf(f.delay, 0.95));
  if (f.blamed > 0) text += fmt::format(", wrong coil {}", f.blamed);
  return text;
}

std::string Line(const std::string& name, const Group& g, const std::set<std::string>& kinds) {
  std::string text = fmt::format("| {} | {} | {} | {} | {} |", name, g.plants.size(),
                                 g.acted.size(), g.harmed.size(), g.doubtful.size());
  for (const std::string& kind : kinds) {
    const auto it = g.kinds.find(kind);
    text += it == g.kinds.end() ? " - |" : " " + Text(it->second) + " |";
  }
  return text + "\n";
}

std::string Table(const std::map<std::string, Group>& groups) {
  std::set<std::string> kinds;
  Group all;
  for (const auto& [name, g] : groups) {
    for (const auto& [kind, f] : g.kinds) kinds.insert(kind);
    Append(g, &all, name + ":");
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
                    "{:.2g} %; {:.3g} healthy coil-periods.\n",
                    100 * UpperBound95(all.acted.size(), n),
                    100 * UpperBound95(all.harmed.size(), n), all.coil_periods);
}

}  // namespace

double UpperBound95(std::size_t hits, std::size_t trials) {
  if (trials == 0 || hits >= trials) return 1;
  const auto n = static_cast<double>(trials);
  // P(at most `hits` of n) = 5 %, by bisection over p.
  const auto at_most = [&](double p) {
    double sum = 0;
    for (std::size_t k = 0; k <= hits; ++k) {
      const auto m = static_cast<double>(k);
      sum += std::exp(std::lgamma(n + 1) - std::lgamma(m + 1) - std::lgamma(n - m + 1) +
                      m * std::log(p) + (n - m) * std::log1p(-p));
    }
    return sum;
  };
  double lo = 1e-12, hi = 1 - 1e-12;
  for (int k = 0; k < 60; ++k) {
    const double p = 0.5 * (lo + hi);
    (at_most(p) > 0.05 ? lo : hi) = p;
  }
  return hi;
}

std::string PlantTables(const Rows& rows) {
  std::map<std::string, std::map<std::string, Group>> tables;  // commissioned, effect and size
  for (const auto& [run, row] : rows)
    if (!row.At("plant").empty() && row.At("verdict") != "error")
      AddToGroup(row, &tables[row.At("commissioned")][GroupOf(row)]);
  std::string text;
  for (const auto& [learnt, groups] : tables)
    text += fmt::format("{}{}\n\n{}", text.empty() ? "" : "\n",
                        learnt == "yes" ? "Commissioned:" : "Not commissioned:", Table(groups));
  return text;
}

bool WritePlantTables(const std::string& folder, const Rows& rows) {
  const std::string text = PlantTables(rows);
  if (text.empty()) return false;
  WriteFileAtomically((std::filesystem::path(folder) / "plants.md").string(),
                      "Faults: found of runs, median and 95 % delay.\n\n" + text);
  return true;
}

}  // namespace ambrig
