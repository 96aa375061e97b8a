#include "app/pages/redistribute_report.h"

#include <fmt/format.h>

#include <cmath>

#include "app/figures/rig_drawing.h"
#include "app/pages/html.h"
#include "core/math/constants.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

constexpr std::size_t kMostPictures = 12;

constexpr const char* kLegend =
    "map       what a run goes to: W (a matrix from forces to currents, exact for\n"
    "          every force or linearised), force by force (currents sought for each\n"
    "          force), or none\n"
    "carries   whether its currents, clamped to the amplifiers' range, truly pull the\n"
    "          load; margin: how many times the load they still pull\n"
    "worst     force that can be added to the load in the worst direction [N], and\n"
    "          that direction [deg]\n";

int Degrees(const MapReach& r) { return r.worst_direction * 360 / MapReach::kDirections; }

std::string Margin(const RedistributionFigures& f, const MapReach& r) {
  return !r.carries || f.load.norm() == 0 ? "-" : fmt::format("{:.2f}", r.margin);
}

std::string MapLine(const RedistributionFigures& f, const std::string& set, const std::string& map,
                    const MapReach& r) {
  return fmt::format("{:<20} {:<15} {:<8} {:>7} {:>9} {:>6}\n", set, map, r.carries ? "yes" : "NO",
                     Margin(f, r), r.carries ? fmt::format("{:.1f}", r.worst) : "-",
                     r.carries ? std::to_string(Degrees(r)) : "-");
}

/// Sum of load and reach in every direction, closed.
void Polygon(const RedistributionFigures& f, const MapReach& r, std::vector<double>* x,
             std::vector<double>* y) {
  for (int k = 0; k <= MapReach::kDirections; ++k) {
    const int at = k % MapReach::kDirections;
    const double angle = 2 * kPi * at / MapReach::kDirections;
    x->push_back(f.load.x() + r.radius[at] * std::cos(angle));
    y->push_back(f.load.y() + r.radius[at] * std::sin(angle));
  }
}

void AddPictures(const BearingParameters& bearing, const RedistributionFigures& f,
                 const FailureSetFigures& set, HtmlReport& report) {
  report.Heading(SetText(set.failed) + " open", 3);
  StatorView view;
  view.title = SetText(set.failed) + " open";
  view.bearing = f.bearing;
  for (const auto& d : CoilDirections(bearing)) view.pole_angles.push_back(std::atan2(d[1], d[0]));
  view.failed = set.failed;
  view.clearance = bearing.auxiliary ? bearing.auxiliary->clearance : 0;
  report.AddFigure(StatorFigure("Poles; failed coils are marked.", std::span(&view, 1)));
  Figure figure = MakeFigure(
      "Forces on the shaft that the map truly gives: outer line healthy, inner line with the set "
      "failed, dot: the load.");
  std::vector<double> hx, hy, x, y;
  Polygon(f, f.healthy, &hx, &hy);
  Style healthy, left, load;
  healthy.color = "@muted";
  healthy.dash = "dash";
  load.markers = true;
  load.color = "@red";
  AddOrbit(figure, 0, "healthy", hx, hy, healthy);
  if (set.reach.carries) {
    Polygon(f, set.reach, &x, &y);
    AddOrbit(figure, 0, SetText(set.failed), x, y, left);
  }
  const double px[] = {f.load.x()}, py[] = {f.load.y()};
  AddOrbit(figure, 0, "load", px, py, load);
  SetAxes(figure, 0, "force x [N]", "force y [N]");
  EqualAspect(figure, 0);
  figure.narrow = 480;
  report.AddFigure(figure);
}

}  // namespace

std::string SetText(const std::vector<int>& failed) {
  std::string text;
  for (const int j : failed) text += (text.empty() ? "{" : ",") + std::to_string(j);
  return text + "}";
}

std::string RedistributionText(const RedistributionFigures& f) {
  std::string text = fmt::format("{:<20} {:<15} {:<8} {:>7} {:>9} {:>6}\n", "failed", "map",
                                 "carries", "margin", "worst [N]", "[deg]");
  text += MapLine(f, "healthy", "W, exact", f.healthy);
  std::size_t carry = 0;
  for (const FailureSetFigures& s : f.sets) {
    text += MapLine(f, SetText(s.failed), s.map, s.reach);
    carry += s.reach.carries;
  }
  text += fmt::format("load: ({:.2f}, {:.2f}) N; commands up to {:.6g} N an axis\n",
                      f.load.x() + 0.0, f.load.y() + 0.0, f.most);
  if (f.sets.size() == 1) {
    const FailureSetFigures& s = f.sets.front();
    text += !s.reach.carries ? "the load is NOT carried: the rotor drops\n"
            : f.load.norm() == 0
                ? "no load to carry\n"
                : fmt::format("carries the weight with margin {:.2f}\n", s.reach.margin);
  } else {
    text += fmt::format("{} of {} sets carry the load\n", carry, f.sets.size());
  }
  return text + kLegend;
}

void WriteRedistributionReport(const RigParameters& rig, const RedistributionFigures& f,
                               const std::string& html) {
  HtmlReport report("Current distribution after coil failures",
                    fmt::format("rig {}, bearing {}", f.rig, f.bearing));
  report.Heading("Failure sets");
  report.Text(fmt::format(
      "The maps that runs go to, with forces told by the reluctance network. Load of the bearing: "
      "({:.2f}, {:.2f}) N; commands reach {:.6g} N an axis. **Margin**: how many times the load is "
      "still pulled. **Worst**: force that can be added to the load in the worst direction.",
      f.load.x() + 0.0, f.load.y() + 0.0, f.most));
  std::vector<std::vector<Cell>> rows;
  const auto add = [&](const std::string& set, const std::string& map, const MapReach& r) {
    rows.push_back({Cell(set), Cell(map), Cell(r.carries ? "yes" : "no", r.carries ? "ok" : "fail"),
                    Cell(Margin(f, r)), Cell(r.carries ? fmt::format("{:.1f}", r.worst) : "-"),
                    Cell(r.carries ? std::to_string(Degrees(r)) : "-")});
  };
  add("healthy", "W, exact", f.healthy);
  for (const FailureSetFigures& s : f.sets) add(SetText(s.failed), s.map, s.reach);
  report.Table({"failed", "map", "carries the load", "margin", "worst [N]", "at [deg]"}, rows);
  if (f.sets.size() <= kMostPictures) {
    report.Heading("Pictures");
    for (const FailureSetFigures& s : f.sets) AddPictures(*rig.Find(f.bearing), f, s, report);
  }
  report.Write(html);
}

}  // namespace ambrig
