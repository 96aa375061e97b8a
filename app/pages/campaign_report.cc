#include "app/pages/campaign_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "app/figures/series.h"
#include "app/pages/html.h"
#include "app/text/format.h"
#include "campaign/merge.h"
#include "core/base/counted.h"

namespace ambrig {

namespace {

constexpr std::size_t kWorst = 20;

std::vector<std::string> Distinct(const Rows& rows, const char* column) {
  std::vector<std::string> out;
  std::set<std::string> seen;
  for (const auto& [run, row] : rows)
    if (const auto [value, fresh] = seen.insert(row.At(column)); fresh) out.push_back(*value);
  return out;
}

struct Survivors {
  double up = 0, all = 0;  // runs
};
using SurvivalOfSets = std::map<std::string, std::map<std::string, Survivors>>;  // by set and load

Figure SurvivalMap(const SurvivalOfSets& map, const std::string& kind, const std::string& speed,
                   const std::vector<std::string>& sets, const std::vector<std::string>& loads) {
  std::vector<std::string> names, columns;
  std::vector<std::vector<double>> values;
  for (const std::string& set : sets) {
    const auto found = map.find(set);
    if (found == map.end()) continue;
    names.push_back(set);
    values.emplace_back();
    for (const std::string& load : loads) {
      const auto it = found->second.find(load);
      values.back().push_back(it == found->second.end() ? kRequired
                                                        : it->second.up / it->second.all);
    }
  }
  for (const std::string& load : loads) columns.push_back("load " + load);
  Figure figure =
      MakeFigure(fmt::format("Survival: {}, {}", kind, Rpm(std::strtod(speed.c_str(), nullptr))));
  figure.height = std::clamp(140 + 14 * static_cast<int>(names.size()), 260, 3800);
  AddHeatmap(figure, 0, columns, names, values, "stayed up", values.size() <= 40 ? 2 : 0);
  figure.traces.back()["zmin"] = 0;
  figure.traces.back()["zmax"] = 1;
  return figure;
}

/// Share of runs that stayed up, sets x loads, one map for each kind and speed.
void SurvivalMaps(HtmlReport& report, const Rows& rows) {
  report.Heading("Survival map");
  report.Text(
      "Share of the runs that stayed up, of each failure set (row) at each load (column): 1 = all, "
      "0 = none. "
      "Loads are those of the campaign file: shares of the set's own capacity (the weight counts), "
      "or newtons.");
  const auto sets = Distinct(rows, "set"), loads = Distinct(rows, "load_given");
  std::map<std::pair<std::string, std::string>, SurvivalOfSets> maps;  // by kind and speed
  for (const auto& [run, row] : rows) {
    auto& cell = maps[{row.At("kind"), row.At("speed")}][row.At("set")][row.At("load_given")];
    cell.up += row.At("verdict") == "up" ? 1 : 0;
    cell.all += 1;
  }
  for (const std::string& kind : Distinct(rows, "kind"))
    for (const std::string& speed : Distinct(rows, "speed")) {
      const auto map = maps.find({kind, speed});
      if (map != maps.end()) report.AddFigure(SurvivalMap(map->second, kind, speed, sets, loads));
    }
}

void Reasons(HtmlReport& report, const RowCounts& n) {
  report.Heading("Why rotors touched down or dropped");
  std::vector<std::vector<Cell>> table;
  for (const auto& [reason, runs] : n.reasons)
    table.push_back({Cell(reason), Cell(std::to_string(runs))});
  report.Table({"reason", "runs"}, table);
}

void Delays(HtmlReport& report, const Rows& rows) {
  std::map<std::string, std::vector<double>> by_kind;
  for (const auto& [run, row] : rows)
    if (!row.At("detection_delay").empty())
      by_kind[row.At("kind")].push_back(row.Number("detection_delay") * 1e6);
  if (by_kind.empty()) return;
  report.Heading("Detection delay");
  report.Text("Delay from the fault to the alarm; the slowest coil of each run.");
  std::vector<std::vector<Cell>> table;
  for (auto& [kind, values] : by_kind) {
    std::sort(values.begin(), values.end());
    const auto at = [&v = values](double q) {
      return fmt::format("{:.1f}",
                         v[static_cast<std::size_t>(q * static_cast<double>(v.size() - 1))]);
    };
    table.push_back({Cell(kind), Cell(std::to_string(values.size())), Cell(at(0)), Cell(at(0.5)),
                     Cell(at(0.95)), Cell(at(1))});
    Figure figure = MakeFigure("Detection delay: " + kind);
    AddHistogram(figure, 0, kind, values, 40);
    SetAxes(figure, 0, "delay [µs]", "runs");
    report.AddFigure(figure);
  }
  report.Table({"kind", "runs", "least [µs]", "median", "95 %", "greatest"}, table);
}

int Severity(const Row& r) {
  const std::string v = r.At("verdict");
  return v == "error" ? 3 : v == "drop" ? 2 : v == "touchdown" ? 1 : 0;
}

void WorstCases(HtmlReport& report, const JournalHeader& header, const Rows& rows) {
  report.Heading("Worst cases");
  report.Text(
      "Runs that did not stay up first, then by the largest orbit. The command repeats a run with "
      "its record and report.");
  struct Badness {
    int severity = 0;
    double orbit = 0;  // [m]
    const Row* row = nullptr;
  };
  std::vector<Badness> order;
  for (const auto& [run, row] : rows) {
    const double orbit = row.Number("peak_orbit");
    order.push_back({Severity(row), std::isnan(orbit) ? 1e9 : orbit, &row});
  }
  std::ranges::stable_sort(order, [](const Badness& a, const Badness& b) {
    return a.severity != b.severity ? a.severity > b.severity : a.orbit > b.orbit;
  });
  std::vector<std::vector<Cell>> table;
  for (std::size_t k = 0; k < std::min(kWorst, order.size()); ++k) {
    const Row& r = *order[k].row;
    const int s = order[k].severity;
    table.push_back({Cell(r.At("run")), Cell(r.At("set")), Cell(r.At("class")), Cell(r.At("kind")),
                     Cell(Rpm(r.Number("speed"))), Cell(r.At("load_given")),
                     Cell(r.At("verdict"), s > 1    ? "fail"
                                           : s == 1 ? "warn"
                                                    : "ok"),
                     Cell(FormatSi(r.Number("peak_orbit"), "m")),
                     Cell(FormatSi(r.Number("detection_delay"), "s")),
                     Cell(fmt::format("ambrig run --from-campaign {} --row {}", header.file, r.run),
                          "muted path")});
  }
  report.Table({"run", "set", "class", "kind", "speed", "load", "verdict", "largest orbit", "delay",
                "repeat"},
               table);
}

/// Largest static force that was held against what the theory allows.
void Capacity(HtmlReport& report, const Rows& rows) {
  if (std::ranges::none_of(rows, [](const auto& row) { return row.second.Number("load") > 0; }))
    return;  // nothing was loaded: nothing to hold against theory
  std::map<std::string, std::vector<const Row*>> by_set;
  for (const auto& [run, row] : rows) by_set[row.At("set") + ", " + row.At("kind")].push_back(&row);
  report.Heading("Capacity against theory");
  report.Text(
      "Theory: `k c0² rho` of the set's current distribution, at most the controller's largest "
      "force. Held: the largest load beside the weight at which every run of the set stayed up; a "
      "set below the dashed line was not loaded further, or dropped.");
  std::map<std::string, std::array<std::vector<double>, 2>> points;  // class -> theory, held
  for (const auto& [name, list] : by_set) {
    std::map<double, bool> held;
    for (const Row* r : list) {
      auto [it, fresh] = held.try_emplace(r->Number("load"), true);
      it->second = it->second && r->At("verdict") == "up";
    }
    double most = kRequired;
    for (const auto& [load, all] : held)
      if (all) most = load;
    points[list.front()->At("class")][0].push_back(list.front()->Number("capacity"));
    points[list.front()->At("class")][1].push_back(most);
  }
  Figure figure = MakeFigure("Largest load held beside the weight, one point a set and kind");
  int k = 0;
  for (auto& [cls, xy] : points) {
    Style style = SeriesStyle(k++);
    style.markers = true;
    AddLine(figure, 0, cls, xy[0], xy[1], style);
  }
  double reach = 0;
  for (const auto& [cls, xy] : points)
    for (const auto& values : xy) reach = std::max(reach, LargestSize(values));
  Style line;
  line.color = "@muted";
  line.dash = "dash";
  AddLine(figure, 0, "held = theory", std::vector<double>{0, reach}, std::vector<double>{0, reach},
          line);
  SetAxes(figure, 0, "capacity by theory [N]", "load held [N]");
  report.AddFigure(figure);
}

}  // namespace

void WriteCampaignReport(const JournalHeader& header, const Rows& rows, const std::string& path) {
  const RowCounts n = CountRows(rows);
  HtmlReport report(header.name, fmt::format("campaign of {}, fingerprint {}",
                                             Counted(header.runs, "run"), header.fingerprint));
  report.Verdict(n.drop + n.error > 0 ? Verdict::kFail
                 : n.touchdown > 0    ? Verdict::kWarn
                                      : Verdict::kOk,
                 fmt::format("{} of {} stayed up, {} touched down, {} dropped.", n.up,
                             Counted(n.rows, "run"), n.touchdown, n.drop));
  report.KeyValues(
      {{"runs done", fmt::format("{} of {}", n.rows, header.runs)},
       {"not finished (error)", std::to_string(n.error)},
       {"faults", std::to_string(n.faults)},
       {"not detected", std::to_string(n.undetected)},
       {"last class not the true one", std::to_string(n.wrong_class)},
       {"worst detection delay", n.worst_delay > 0 ? FormatSi(n.worst_delay, "s") : "–"},
       {"false alarms", FalseAlarmText(n.false_alarms, n.coil_periods)},
       {"largest orbit of runs that stayed up", n.up > 0 ? FormatSi(n.largest_orbit, "m") : "–"}});
  if (!n.reasons.empty()) Reasons(report, n);
  if (!rows.empty()) {
    SurvivalMaps(report, rows);
    Delays(report, rows);
    WorstCases(report, header, rows);
    Capacity(report, rows);
  }
  report.Write(path);
}

}  // namespace ambrig
