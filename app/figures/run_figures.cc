#include "app/figures/run_figures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "app/figures/rig_drawing.h"
#include "app/figures/series.h"
#include "app/text/format.h"

namespace ambrig {
namespace {

// The rows of the record in a stretch of time, with the times as the figure shows them.
struct Cut {
  std::size_t begin = 0, size = 0;
  std::vector<double> t;
  double t0 = 0, factor = 1;  // shown = (t - t0) factor
  std::array<double, 2> range{};
  std::string title;

  std::span<const double> Of(const std::vector<double>& samples) const {
    return std::span(samples).subspan(begin, size);
  }
};

Cut MakeCut(const RunReportData& data, const RunStages& stages, bool zoom, std::size_t rows) {
  Cut cut;
  const std::array<double, 2> stretch = zoom ? stages.window : stages.whole;
  if (zoom) {
    cut.t0 = stages.fault.value_or(0);
    cut.factor = 1e3;
  }
  cut.title = zoom ? "time after the fault [ms]" : "time [s]";
  const auto row = [&](double t) {
    const double r = std::round((t - data.start) * data.rate);
    return static_cast<std::size_t>(std::clamp(r, 0.0, static_cast<double>(rows)));
  };
  cut.begin = row(stretch[0]);
  cut.size = std::min(rows, row(stretch[1]) + 1) - cut.begin;
  cut.t = UniformTime(data.start + static_cast<double>(cut.begin) / data.rate - cut.t0, data.rate,
                      cut.size);
  for (double& t : cut.t) t *= cut.factor;
  cut.range = {(stretch[0] - cut.t0) * cut.factor, (stretch[1] - cut.t0) * cut.factor};
  return cut;
}

std::size_t RowsOfRun(const RunReportData& data) {
  return data.bearings.empty() ? 0 : data.bearings.front().x.size();
}

std::string InUnit(const std::string& quantity, const DisplayUnit& unit) {
  return fmt::format("{} [{}]", quantity, unit.name);
}

double Peak(const ReportBearing& b, std::size_t begin, std::size_t size) {
  double r2 = 0;
  for (std::size_t i = begin; i < begin + size; ++i) {
    const double here = b.x[i] * b.x[i] + b.y[i] * b.y[i];
    if (here > r2) r2 = here;
  }
  return std::sqrt(r2);
}

/// Targets of the faults from event `first` on that come at its instant.
std::vector<std::string> FaultsAtOnce(const std::vector<ReportEvent>& events, std::size_t first) {
  std::vector<std::string> out;
  for (std::size_t k = first; k < events.size(); ++k) {
    if (events[k].kind != "fault" || events[k].t != events[first].t) break;
    out.push_back(events[k].target);
  }
  return out;
}

constexpr const char* kCoilColors[] = {"@blue", "@orange", "@green", "@purple",
                                       "@sky",  "@brown",  "@gray",  "@ink"};

}  // namespace

RunStages FindStages(const RunReportData& data) {
  RunStages s;
  std::size_t rows = std::max<std::size_t>(RowsOfRun(data), 1);
  for (const ReportBearing& b : data.bearings)  // of a clamped shaft there are currents only
    for (const std::vector<double>& current : b.currents) rows = std::max(rows, current.size());
  const double end = data.start + static_cast<double>(rows - 1) / data.rate;
  s.whole = {data.start, end};
  for (const ReportEvent& e : data.events) {
    if (e.kind == "fault" && !s.fault) {
      s.fault = e.t;
      s.coil = e.target;
    }
    if (e.kind == "fault") s.coils.insert(e.target);
    const bool reaction =
        e.kind == "detected" || e.kind == "classified" || e.kind.ends_with("redistributed");
    // Later faults have reactions of their own; the window is for the first.
    if (reaction && s.fault && e.t >= *s.fault && e.t < *s.fault + 0.05) s.reaction = e.t;
  }
  if (!s.fault) return s;
  const double length = std::max(0.012, 4 * (s.reaction.value_or(*s.fault) - *s.fault));
  s.window = {std::max(s.whole[0], *s.fault - 0.3 * length), std::min(end, *s.fault + length)};
  return s;
}

std::vector<Mark> EventMarks(const RunReportData& data, double t0, double factor) {
  static const std::map<std::string, const char*> kColors = {
      {"fault", "@red"},           {"detected", "@orange"},    {"classified", "@purple"},
      {"redistributed", "@green"}, {"touchdown", "@red"},      {"drop", "@red"},
      {"lift_off", "@sky"},        {"alarm_cleared", "@gray"}, {"not_redistributed", "@red"}};
  constexpr std::size_t kContactsMarked = 6;  // the lines of a bouncing rotor would cover its curve
  std::vector<Mark> marks;
  std::size_t contacts = 0, again = 0;
  for (const ReportEvent& e : data.events) {
    if (again > 0 && again-- > 0) continue;  // shares the mark of the faults at its instant
    const bool contact = e.kind == "touchdown" || e.kind == "lift_off";
    if (contact && ++contacts > kContactsMarked) continue;
    const auto color = kColors.find(e.kind);
    std::string label = e.kind;
    std::ranges::replace(label, '_', ' ');
    if (e.kind == "fault" && !e.target.empty()) {
      const auto at_once =
          FaultsAtOnce(data.events, static_cast<std::size_t>(&e - &data.events[0]));
      label = at_once.size() == 1  ? "fault " + e.target
              : at_once.size() < 4 ? fmt::format("faults {}", fmt::join(at_once, ", "))
                                   : fmt::format("{} faults", at_once.size());
      again = at_once.size() - 1;
    }
    marks.push_back(
        {(e.t - t0) * factor, label, color == kColors.end() ? "@muted" : color->second});
  }
  return marks;
}

Figure PositionFigure(const RunReportData& data, const RunStages& stages, bool zoom) {
  Grid grid;
  grid.rows = static_cast<int>(data.bearings.size());
  for (const ReportBearing& b : data.bearings) grid.titles.push_back("bearing " + b.name);
  Figure figure = MakeFigure(
      zoom ? "Shaft position about the fault." : "Shaft position over the whole run.", grid);
  const Cut cut = MakeCut(data, stages, zoom, RowsOfRun(data));
  double peak = 0;
  for (const ReportBearing& b : data.bearings) peak = std::max(peak, Peak(b, cut.begin, cut.size));
  const DisplayUnit unit = ChooseUnit(peak, "m");
  for (int p = 0; p < grid.rows; ++p) {
    const ReportBearing& b = data.bearings[static_cast<std::size_t>(p)];
    Style style = SeriesStyle(0);
    style.legend = p == 0;
    AddLine(figure, p, "x (horizontal)", cut.t, Scaled(cut.Of(b.x), unit.factor), style);
    style.color = "@orange";
    AddLine(figure, p, "y (vertical)", cut.t, Scaled(cut.Of(b.y), unit.factor), style);
    SetAxes(figure, p, cut.title, InUnit("position", unit), cut.range);
    if (Peak(b, cut.begin, cut.size) > 0.7 * b.clearance) {
      AddLevel(figure, p, b.clearance * unit.factor, "clearance");
      AddLevel(figure, p, -b.clearance * unit.factor, "");
    }
  }
  AddMarks(figure, EventMarks(data, cut.t0, cut.factor), cut.range);
  return figure;
}

Figure CurrentFigure(const RunReportData& data, const RunStages& stages, bool zoom) {
  Grid grid;
  grid.panel_height = 240;
  grid.rows = static_cast<int>(data.bearings.size());
  for (const ReportBearing& b : data.bearings) grid.titles.push_back("bearing " + b.name);
  std::string caption = zoom ? "Coil currents about the fault: the current of the faulty coil "
                               "decays or changes its ripple; the other coils compensate."
                             : "Coil currents over the whole run.";
  if (!stages.coils.empty())
    caption += stages.coils.size() > 1 ? " Coils with a fault are drawn bold."
                                       : " The faulty coil is drawn bold.";
  Figure figure = MakeFigure(caption, grid);
  const Cut cut = MakeCut(data, stages, zoom, RowsOfRun(data));
  std::set<std::string> named;
  int bold = 0;  // the second of two faulty coils is dashed
  for (int p = 0; p < grid.rows; ++p) {
    const ReportBearing& b = data.bearings[static_cast<std::size_t>(p)];
    for (std::size_t j = 0; j < b.currents.size(); ++j) {
      Style style = SeriesStyle(static_cast<int>(j));
      std::string name = fmt::format("coil {}", j + 1);
      const std::string full_name = fmt::format("{}{}", b.name, j + 1);
      style.width = 1.2;
      const bool faulty = stages.coils.contains(full_name);
      if (faulty) {
        style = {.color = "@red", .width = 3, .dash = SeriesStyle(4 * bold++).dash};
        name = full_name + " (faulty)";
      }
      // dashes mean something only where a line can be followed
      if (!zoom && !faulty) style = {.color = kCoilColors[j % 8], .width = 1};
      style.legend = named.insert(name).second;  // one legend for all panels
      AddLine(figure, p, name, cut.t, cut.Of(b.currents[j]), style);
    }
    SetAxes(figure, p, cut.title, "current [A]", cut.range);
  }
  AddMarks(figure, EventMarks(data, cut.t0, cut.factor), cut.range);
  return figure;
}

Figure ChannelFigure(const RunReportData& data) {
  Grid grid;
  grid.rows = static_cast<int>(data.channels.size());
  grid.panel_height = 150;
  Figure figure = MakeFigure("Further channels of the record.", grid);
  std::array<double, 2> range{};
  for (int p = 0; p < grid.rows; ++p) {
    const ReportChannel& c = data.channels[static_cast<std::size_t>(p)];
    const std::vector<double> t = UniformTime(data.start, data.rate, c.samples.size());
    const DisplayUnit unit = ChooseUnit(LargestSize(c.samples), c.unit);
    Style style;
    style.legend = false;
    AddLine(figure, p, c.name, t, Scaled(c.samples, unit.factor), style);
    std::optional<std::array<double, 2>> y_range;
    if (!c.samples.empty()) {
      const auto [low, high] = std::ranges::minmax(c.samples);
      const double middle = 0.5 * (low + high) * unit.factor;
      // A constant is drawn as one, not as the last bits of its noise.
      if (high - low <= 1e-3 * std::abs(high) && middle != 0)
        y_range = {middle - 0.05 * std::abs(middle), middle + 0.05 * std::abs(middle)};
    }
    SetAxes(figure, p, "time [s]", InUnit(c.name, unit), {}, y_range);
    if (!t.empty()) range = {t.front(), t.back()};
  }
  AddMarks(figure, EventMarks(data), range);
  return figure;
}

Figure SnapshotFigure(const RunReportData& data) {
  std::vector<StatorView> views;
  for (const ReportSnapshot& s : data.snapshots) {
    StatorView view;
    view.title = fmt::format("{}: {} (t = {} s)", s.bearing, s.label, FormatNumber(s.t, 6));
    view.bearing = s.bearing;
    view.flux = s.flux;
    view.current = s.current;
    view.failed = s.failed;
    view.x = s.x;
    view.y = s.y;
    for (const ReportBearing& b : data.bearings)
      if (b.name == s.bearing) {
        view.pole_angles = b.pole_angles;
        view.clearance = b.clearance;
      }
    views.push_back(std::move(view));
  }
  return StatorFigure(
      "The bearing in cross-section at chosen instants. Poles are coloured by their flux (blue: "
      "into the rotor, orange: out of it), coils at the poles' sides by their current (green); the "
      "deeper, the larger. A faulty coil is dotted red. The shaft's displacement is drawn in "
      "proportion to the clearance (dashed): in the middle, how far the centre has moved.",
      views);
}

}  // namespace ambrig
