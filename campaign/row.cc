#include "campaign/row.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>

#include "campaign/drop_reason.h"
#include "core/base/counted.h"
#include "rig/parameters/bearing_kind.h"
#include "simulation/simulate.h"
#include "simulation/verdict/detection_score.h"

namespace ambrig {

namespace {

/// A delay that was not: an empty cell.
std::string Optional(double v) { return v < 0 || !std::isfinite(v) ? "" : NumberText(v); }

double LargestOrbit(const RunResult& r, const std::string& bearing) {
  const auto it = r.metrics.max_orbit.find(bearing);
  return it == r.metrics.max_orbit.end() ? 0 : it->second;
}

double LargestOrbit(const PlannedRun& p, const RunResult& r) {
  double most = 0;
  for (const BearingParameters& b : p.rig.bearings)
    if (!b.kind->axial) most = std::max(most, LargestOrbit(r, b.name));
  return most;
}

std::vector<std::string> Conditions(const RunPlan& plan, const PlannedRun& p) {
  const Campaign& c = plan.campaign();
  const FaultCase& f = c.cases[p.at.fault];
  const FailureSet& set = c.sets[f.set];
  return {std::to_string(p.run),
          OneCell(std::filesystem::path(p.scenario.file).stem().string()),
          SetText(set),
          std::to_string(set.coils.size()),
          p.theory.cls,
          c.kinds[f.kind].label,
          set.coils.empty() ? ""
          : f.sequential    ? "sequential"
                            : "simultaneous",
          p.scenario.faults.empty() ? "" : NumberText(p.scenario.faults.front().time),
          NumberText(p.speed),
          NumberText(c.loads[p.at.load]),
          NumberText(p.load),
          NumberText(p.theory.capacity),
          p.margin ? NumberText(*p.margin) : "",
          NumberText(c.positions[p.at.position]),
          std::to_string(p.at.draw),
          std::to_string(p.scenario.seed),
          p.plant ? OneCell(p.plant->effect) : "",
          p.plant ? OneCell(p.plant->label) : "",
          p.plant ? NumberText(p.plant->scale) : "",
          !p.plant                                  ? ""
          : p.rig.detection.commissioning == "none" ? "no"
                                                    : "yes"};
}

const char* Verdict(const RunResult& r) {
  return r.drop ? "drop" : r.touchdown ? "touchdown" : "up";
}

/// Share of the coil-periods watched in which a detector doubted its model.
double DoubtfulShare(const PlannedRun& p, const RunResult& r) {
  double coils = 0, doubtful = 0;
  for (const BearingParameters& b : p.rig.bearings) {
    const auto it = r.doubtful_share.find(b.name);
    if (it == r.doubtful_share.end()) continue;
    coils += b.coils();
    doubtful += b.coils() * it->second;
  }
  return coils > 0 ? doubtful / coils : 0;
}

std::vector<std::string> Outcome(const RunPlan& plan, const PlannedRun& p, const RunResult& r,
                                 const RunResult* without) {
  const RunMetrics& m = r.metrics;
  const DetectionScore score = ScoreDetection(p.scenario.faults, r.events);
  const bool finite = std::isfinite(LargestOrbit(p, r)) && std::isfinite(m.copper_loss) &&
                      std::isfinite(m.peak_current);
  if (!finite) throw std::runtime_error("the run is not finite");
  return {Verdict(r),
          std::to_string(score.judged()),
          std::to_string(score.detected()),
          std::to_string(score.right_class()),
          Optional(m.detection_delay),
          Optional(m.redistribution_delay),
          NumberText(m.false_alarms),
          NumberText(m.coil_periods),
          NumberText(LargestOrbit(p, r)),
          NumberText(LargestOrbit(r, p.bearing)),
          NumberText(m.settled_orbit),
          NumberText(m.min_clearance_left),
          NumberText(m.longest_contact),
          NumberText(m.peak_current),
          NumberText(m.copper_loss),
          std::to_string(std::ranges::count_if(
              r.actions, [&](const CoilAction& a) { return IsFalseAction(p.scenario, a); })),
          std::to_string(std::ranges::count(r.actions, "restore", &CoilAction::action)),
          r.doubtful ? "yes" : "no",
          NumberText(DoubtfulShare(p, r)),
          without ? Verdict(*without) : "",
          without ? NumberText(LargestOrbit(p, *without)) : "",
          DropReason(plan, p, r),
          ""};
}

/// The columns of words; in every other one stands a number or nothing.
constexpr std::string_view kWords[] = {
    "scenario",     "set",     "class",    "kind", "onset",           "effect", "plant",
    "commissioned", "verdict", "doubtful", "note", "verdict_without", "reason"};

std::optional<double> NumberIn(std::string_view cell) {
  double v = 0;
  const auto [last, error] = std::from_chars(cell.data(), cell.data() + cell.size(), v);
  if (error != std::errc{} || last != cell.data() + cell.size()) return std::nullopt;
  return v;
}

/// Names of the columns without their units.
const std::vector<std::string>& ColumnNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = RowColumns();
    for (std::string& name : all) name.resize(std::min(name.find(" ["), name.size()));
    return all;
  }();
  return names;
}

[[noreturn]] void RefuseCells(const Row& row, const std::string& where) {
  throw InputError(fmt::format("{}: {}, allowed: {} of a campaign's row", where,
                               Counted(row.Cells().size(), "cell"), RowColumns().size()));
}

}  // namespace

std::string OneCell(std::string text) {
  for (char& ch : text)
    if (ch == ',' || ch == '\n' || ch == '\r' || ch == '\t' || ch == '"') ch = ' ';
  return text;
}

const std::vector<std::string>& RowColumns() {
  static const std::vector<std::string> columns{"run",
                                                "scenario",
                                                "set",
                                                "failed",
                                                "class",
                                                "kind",
                                                "onset",
                                                "fault_time [s]",
                                                "speed [rad/s]",
                                                "load_given",
                                                "load [N]",
                                                "capacity [N]",
                                                "margin",
                                                "position",
                                                "draw",
                                                "seed",
                                                "effect",
                                                "plant",
                                                "spread [sd]",
                                                "commissioned",
                                                "verdict",
                                                "judged",
                                                "detected",
                                                "right_class",
                                                "detection_delay [s]",
                                                "redistribution_delay [s]",
                                                "false_alarms",
                                                "coil_periods",
                                                "peak_orbit [m]",
                                                "bearing_orbit [m]",
                                                "late_orbit [m]",
                                                "clearance_left [m]",
                                                "longest_contact [s]",
                                                "peak_current [A]",
                                                "copper_loss [W]",
                                                "false_actions",
                                                "restored",
                                                "doubtful",
                                                "doubtful_share",
                                                "verdict_without",
                                                "orbit_without [m]",
                                                "reason",
                                                "note"};
  return columns;
}

std::string SetText(const FailureSet& set) {
  if (set.coils.empty()) return set.bearing + ":healthy";
  std::string text;
  for (const int coil : set.coils)
    text += (text.empty() ? set.bearing + ":" : "+") + std::to_string(coil);
  return text;
}

std::vector<std::string_view> Row::Cells() const {
  std::vector<std::string_view> cells;
  const std::string_view all = csv;
  for (std::size_t begin = 0; begin <= all.size();) {
    const std::size_t end = std::min(all.find(',', begin), all.size());
    cells.push_back(all.substr(begin, end - begin));
    begin = end + 1;
  }
  return cells;
}

std::string Row::At(std::string_view column) const {
  const auto& names = ColumnNames();
  const auto name = std::ranges::find(names, column);
  Require(name != names.end(), "a column of the table");
  std::size_t begin = 0;
  for (auto k = name - names.begin(); k > 0; --k) {
    begin = csv.find(',', begin) + 1;
    if (begin == 0) RefuseCells(*this, fmt::format("row of run {}", run));
  }
  return csv.substr(begin, csv.find(',', begin) - begin);
}

double Row::Number(std::string_view column) const {
  const std::string text = At(column);
  double v = kRequired;
  if (!text.empty()) std::from_chars(text.data(), text.data() + text.size(), v);
  return v;
}

Row RowOfCells(std::size_t run, const std::vector<std::string>& cells) {
  return {run, fmt::format("{}", fmt::join(cells, ","))};
}

Row ParseRow(std::string_view csv, const std::string& where) {
  Row row{0, std::string(csv)};
  const char* const end = csv.data() + std::min(csv.find(','), csv.size());
  const auto [last, error] = std::from_chars(csv.data(), end, row.run);
  if (error != std::errc{} || last != end)
    throw InputError(
        fmt::format("{}: no row of a campaign, allowed: cells from the run's number on", where));
  return row;
}

void CheckRow(const Row& row, const std::string& where) {
  const auto& columns = ColumnNames();
  const std::vector<std::string_view> cells = row.Cells();
  if (cells.size() != columns.size()) RefuseCells(row, where);
  const bool ended = row.At("verdict") != "error";
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::string& column = columns[k];
    if (std::ranges::count(kWords, column) > 0) continue;
    const bool outcome = column == "judged" || column == "detected" || column == "right_class";
    const bool count = outcome || column == "failed";
    const bool needed = column == "speed" || column == "failed" || (outcome && ended);
    const std::optional<double> v = NumberIn(cells[k]);
    const bool number = v && (!count || (*v >= 0 && *v <= 1e6));
    if (number || (cells[k].empty() && !needed)) continue;
    throw InputError(fmt::format("{}: {} = \"{}\", allowed: {}", where, column, cells[k],
                                 count ? "a count" : "a number"));
  }
}

Row SimulateRow(const RunPlan& plan, std::size_t run, const std::atomic<bool>* stop) {
  const PlannedRun p = plan.Make(run);
  std::vector<std::string> cells = Conditions(plan, p);
  try {
    SimulateOptions options;
    options.record = false;
    options.stop = stop;
    const RunResult result = Simulate(p.rig, p.scenario, options);
    RunResult plain;
    const RunResult* without = plan.campaign().without ? &result : nullptr;
    if (without && result.interfered) {
      Scenario scenario = p.scenario;
      scenario.fault_tolerant = false;
      plain = Simulate(p.rig, scenario, options);
      without = &plain;
    }
    const auto outcome = Outcome(plan, p, result, without);
    cells.insert(cells.end(), outcome.begin(), outcome.end());
  } catch (const Interrupted&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;  // of the machine, not of the run: another machine would have another table
  } catch (const std::exception& e) {
    cells.push_back("error");
    cells.resize(RowColumns().size());
    cells.back() = OneCell(e.what());
  }
  return RowOfCells(run, cells);
}

}  // namespace ambrig
