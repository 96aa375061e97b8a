#include "app/pages/run_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/figures/run_figures.h"
#include "app/figures/speed_figures.h"
#include "app/text/format.h"

namespace ambrig {
namespace {

void AddExpectations(HtmlReport& report, const RunReportData& data) {
  if (data.expect.empty()) return;
  report.Heading("Expectations", 3);
  std::vector<std::vector<Cell>> rows;
  for (const ReportExpect& e : data.expect)
    rows.push_back(
        {e.key, e.wanted, e.got, Cell(e.met ? "✓ met" : "✗ not met", e.met ? "ok" : "fail")});
  report.Table({"expectation", "wanted", "got", ""}, rows, "From the scenario's [expect].");
}

constexpr std::size_t kEventsShown = 20;  // a bouncing rotor has hundreds

void AddTimeline(HtmlReport& report, const RunReportData& data, const RunStages& stages) {
  if (data.events.empty()) return;
  report.Heading("Timeline", 3);
  std::vector<ReportEvent> events = data.events;
  std::ranges::stable_sort(events, {}, &ReportEvent::t);
  std::vector<std::vector<Cell>> rows;
  for (const ReportEvent& e : events) {
    const bool bad = e.kind == "fault" || e.kind == "not_redistributed" || e.kind == "touchdown" ||
                     e.kind == "drop";
    const bool good = e.kind == "redistributed" || e.kind == "lift_off";
    std::string kind = e.kind;
    std::ranges::replace(kind, '_', ' ');
    const bool after = stages.fault && e.t >= *stages.fault;
    rows.push_back(
        {fmt::format("{:.6f}", e.t),
         Cell(after ? (e.t > *stages.fault ? "+" : "") + FormatSi(e.t - *stages.fault, "s") : "",
              "muted"),
         Cell(kind, bad    ? "fail"
                    : good ? "ok"
                           : ""),
         e.target, e.text});
  }
  const std::vector<std::string> columns{"time [s]", "after the fault", "event", "where", "what"};
  const std::size_t first = std::min(rows.size(), kEventsShown);
  report.Table(columns, {rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(first)});
  if (first == rows.size()) return;
  report.BeginDetails(fmt::format("{} more events", rows.size() - first));
  report.Table(columns, {rows.begin() + static_cast<std::ptrdiff_t>(first), rows.end()});
  report.EndDetails();
}

void AddDetection(HtmlReport& report, const RunReportData& data, const RunStages& stages) {
  const std::optional<Figure> stage_figure = StageFigure(data, stages);
  if (!stage_figure && data.samples.empty() && data.slopes.empty()) return;
  report.Heading("Fault detection");
  report.Text(
      "In every switching period the bus voltage drives the coil's current up and down in nearly "
      "straight lines; their slope is voltage over inductance. A broken or partly shorted coil has "
      "another slope than the *nominal* rig would have at the sensed position, voltage and "
      "currents.");
  if (stage_figure) report.AddFigure(*stage_figure);
  if (!data.samples.empty()) report.AddFigure(SampleFigure(data));
  if (data.slopes.empty()) return;
  report.AddFigure(SlopeFigure(data.slopes.front(), data, stages));
  if (const auto histogram = SlopeHistogram(data.slopes.front(), stages))
    report.AddFigure(*histogram);
  if (data.slopes.size() > 1) {
    report.Heading("All coils", 3);
    report.AddFigure(SlopeGrid(data, stages));
  }
}

void AddSources(HtmlReport& report, const RunReportData& data) {
  if (data.scenario_toml.empty() && data.rig_toml.empty()) return;
  report.Heading("Scenario and rig files");
  report.Text("As they were read. What they leave out has its default: `ambrig parameters`.");
  for (const auto& [name, text] :
       {std::pair("Scenario", &data.scenario_toml), {"Rig", &data.rig_toml}}) {
    if (text->empty()) continue;
    report.BeginDetails(name);
    report.Code(*text);
    report.EndDetails();
  }
}

}  // namespace

HtmlReport MakeRunReport(const RunReportData& data) {
  const RunStages stages = FindStages(data);
  HtmlReport report(data.name, data.subtitle);
  if (!data.description.empty()) report.Text(data.description);
  report.Heading("Course of the run");
  if (!data.verdict_text.empty()) report.Verdict(data.verdict, data.verdict_text);
  for (const std::string& note : data.notes) report.Verdict(Verdict::kWarn, note);
  if (!data.metrics.empty()) report.KeyValues(data.metrics);
  AddTimeline(report, data, stages);
  AddExpectations(report, data);
  if (!data.bearings.empty() && !data.bearings.front().x.empty()) {
    report.Heading("Orbits");
    report.AddFigure(OrbitFigure(data, stages));
    report.Heading("Positions");
    report.AddFigure(PositionFigure(data, stages, false));
    if (stages.fault) report.AddFigure(PositionFigure(data, stages, true));
    if (!data.bearings.front().currents.empty()) {
      report.Heading("Coil currents");
      report.AddFigure(CurrentFigure(data, stages, false));
      if (stages.fault) report.AddFigure(CurrentFigure(data, stages, true));
    }
  }
  if (SpeedVaries(data)) {
    report.Heading("Over the speed");
    report.AddFigure(WaterfallFigure(data));
    if (const auto orders = OrderFigure(data)) report.AddFigure(*orders);
  }
  AddDetection(report, data, stages);
  if (!data.snapshots.empty()) {
    report.Heading("Stator cross-sections");
    report.AddFigure(SnapshotFigure(data));
  }
  if (!data.channels.empty()) {
    report.Heading("Further channels");
    report.AddFigure(ChannelFigure(data));
  }
  AddSources(report, data);
  return report;
}

void WriteRunReport(const RunReportData& data, const std::filesystem::path& path) {
  MakeRunReport(data).Write(path);
}

}  // namespace ambrig
