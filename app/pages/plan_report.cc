#include "app/pages/plan_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/pages/html.h"

namespace ambrig {
namespace {

void AddCard(HtmlReport& report, const Plan& plan) {
  double least = 1;
  for (const PlannedPair& p : plan.separates) least = std::min(least, p.probability);
  const std::string::size_type end = plan.text.find('\n');
  report.Verdict(least >= 0.99  ? Verdict::kOk
                 : least >= 0.9 ? Verdict::kInfo
                                : Verdict::kWarn,
                 fmt::format("**{}** tells the names apart with a probability of at least "
                             "{:.1f} %.",
                             plan.title, 100 * least));
  report.Text(plan.text.substr(0, end));
  report.Text(plan.text.substr(end + 1));
  for (const std::string& w : plan.warnings) report.Verdict(Verdict::kWarn, w);
}

void AddTried(HtmlReport& report, const Plan& plan) {
  std::vector<std::string> titles;
  std::vector<double> distances;
  std::vector<std::vector<Cell>> rows;
  for (const TriedScenario& t : plan.tried) {
    if (t.refused.empty()) {
      titles.push_back(t.title);
      distances.push_back(t.least_distance);
    }
    rows.push_back(
        {t.title, fmt::format("{:g}", t.size),
         t.refused.empty() ? fmt::format("{:.1f}", t.least_distance) : "-",
         t.largest_orbit > 0 ? fmt::format("{:.1f} at {}", 1e6 * t.largest_orbit, t.orbit_at) : "-",
         t.refused.empty() ? Cell("yes", "ok") : Cell(t.refused, "warn")});
  }
  Figure f = MakeFigure(
      "Least distance between any two of the names, in standard deviations, whatever their numbers "
      "and the details of their laws do to come nearer: 4.7 means 99 % right.");
  f.height = std::max(200, 90 + 22 * static_cast<int>(titles.size()));
  f.traces.push_back({{"type", "bar"},
                      {"orientation", "h"},  // whole names beside the bars
                      {"name", "distance"},
                      {"x", Numbers(distances)},
                      {"y", titles},
                      {"xaxis", "x"},
                      {"yaxis", "y"},
                      {"marker", {{"color", "@blue"}}}});
  SetAxes(f, 0, "least distance [sd]", "");
  f.layout["yaxis"].update({{"autorange", "reversed"}, {"automargin", true}, {"type", "category"}});
  report.AddFigure(f);
  report.Table({"scenario", "size", "least distance [sd]", "largest orbit [µm]", "safe"}, rows,
               "All scenarios that this rig can make. Size: of the usual excitation, lowered until "
               "every model survives.");
}

}  // namespace

void WritePlanReport(const Plan& plan, const std::string& subject, const std::string& scenario,
                     const std::string& path) {
  HtmlReport report("The next record", subject);
  report.Heading("Card");
  AddCard(report, plan);
  std::vector<std::vector<Cell>> rows;
  for (const PlannedPair& p : plan.separates)
    rows.push_back({p.a, p.b, fmt::format("{:.1f}", p.distance),
                    fmt::format("{:.1f} %", 100 * p.probability),
                    fmt::format("{} of {}", p.right, p.draws)});
  report.Table({"name", "or", "distance [sd]", "probability of the right one",
                "simulated records "
                "decided rightly"},
               rows, "What the record separates.");
  report.Heading("Scenarios compared");
  AddTried(report, plan);
  report.Heading("Scenario file");
  report.Text(fmt::format("`{}`", scenario));
  report.Code(plan.toml);
  report.Write(path);
}

}  // namespace ambrig
