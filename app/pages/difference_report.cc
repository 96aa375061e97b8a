#include "app/pages/difference_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/figures/series.h"
#include "app/pages/html.h"
#include "app/text/format.h"

namespace ambrig {

namespace {

constexpr std::size_t kMostFigures = 6;

/// Channels beyond their tolerance: what is missing or no number, then the one that leaves first.
std::vector<const ChannelDifference*> Worst(const RecordDifference& d) {
  std::vector<const ChannelDifference*> out;
  for (const ChannelDifference& c : d.channels)
    if (c.bad()) out.push_back(&c);
  std::ranges::stable_sort(out, {}, [](const ChannelDifference* c) {
    return std::pair(c->verdict == ChannelVerdict::kDiffers, c->first);
  });
  return out;
}

/// b less a at the rows of a that b has too; times in ms.
void NowLessBefore(const RunFiles& a, const Channel& of_a, const RunFiles& b, const Channel& of_b,
                   std::vector<double>* ms, std::vector<double>* difference) {
  for (std::size_t k = 0; k < of_a.samples.size(); ++k) {
    const double t = a.record.start + static_cast<double>(k) / a.record.rate,
                 row = (t - b.record.start) * b.record.rate, near = std::round(row);
    if (std::abs(row - near) > 1e-3 || near < 0) continue;
    const auto at = static_cast<std::size_t>(near);
    if (at >= of_b.samples.size()) break;
    ms->push_back(t * 1e3);
    difference->push_back(of_b.samples[at] - of_a.samples[k]);
  }
}

void AddCurves(HtmlReport& report, const DifferencePage& run, const ChannelDifference& c) {
  const Channel* a = run.a->record.Find(c.channel);
  const Channel* b = run.b->record.Find(c.channel);
  double largest = 0;
  for (const Channel* k : {a, b})
    if (k) largest = std::max(largest, LargestSize(k->samples));
  const DisplayUnit unit = ChooseUnit(largest, c.unit);
  const std::string caption =
      c.rows == 0 ? fmt::format("{}: {}.", c.channel, VerdictText(c.verdict))
                  : fmt::format("{}: {} from {:.6g} ms on, largest difference {} at {:.6g} ms.",
                                c.channel, VerdictText(c.verdict), c.first * 1e3,
                                FormatSi(c.worst, c.unit), c.worst_at * 1e3);
  std::vector<double> ms, difference;
  if (a && b) NowLessBefore(*run.a, *a, *run.b, *b, &ms, &difference);
  Grid grid;
  grid.rows = difference.empty() ? 1 : 2;
  Figure f = MakeFigure(caption, grid);
  SetAxes(f, 0, "time [ms]", fmt::format("{} [{}]", c.channel, unit.name));
  const auto add = [&](const char* name, const RunFiles& of, const Channel* k, int colour) {
    if (k)
      AddLine(f, 0, name,
              Scaled(UniformTime(of.record.start, of.record.rate, k->samples.size()), 1e3),
              Scaled(k->samples, unit.factor), SeriesStyle(colour));
  };
  add("before", *run.a, a, 0);
  add("now", *run.b, b, 1);
  if (!difference.empty()) {
    const DisplayUnit fine = ChooseUnit(LargestSize(difference), c.unit);
    SetAxes(f, 1, "time [ms]", fmt::format("now less before [{}]", fine.name));
    AddLine(f, 1, "now less before", ms, Scaled(difference, fine.factor), SeriesStyle(2));
  }
  report.AddFigure(f);
}

void AddEvents(HtmlReport& report, const RunDifference& d) {
  if (d.events.empty()) return;
  std::vector<std::vector<Cell>> rows;
  for (const EventDifference& e : d.events) rows.push_back({Cell(EventDifferenceText(e), "fail")});
  report.Table({"events"}, rows);
}

void AddChannels(HtmlReport& report, const RunDifference& d) {
  std::vector<std::vector<Cell>> rows;
  for (const ChannelDifference& c : d.record.channels)
    rows.push_back({Cell(c.channel), Cell(VerdictText(c.verdict), c.bad() ? "fail" : "ok"),
                    Cell(c.bad() ? fmt::format("{:.6g} ms", c.first * 1e3) : "-"),
                    Cell(c.worst > 0 ? FormatSi(c.worst, c.unit) : "-"),
                    Cell(c.rms > 0 ? FormatSi(c.rms, c.unit) : "-"),
                    Cell(fmt::format("{} of {}", c.beyond, c.rows))});
  report.Table({"channel", "verdict", "from", "largest difference", "rms of the difference",
                "rows beyond the tolerance"},
               rows,
               "All channels; s: set-points, i: currents, d: duties (0 to 1), r: true position of "
               "the shaft. Without tolerances one bit is a difference.");
}

}  // namespace

void WriteDifferenceReport(const std::vector<DifferencePage>& runs, const std::string& path) {
  HtmlReport report("Runs compared", runs.size() == 1
                                         ? runs[0].difference->a + " and " + runs[0].difference->b
                                         : "stored records beside new ones");
  for (const DifferencePage& run : runs) {
    const RunDifference& d = *run.difference;
    report.Heading(run.name);
    report.Verdict(d.agrees() ? Verdict::kOk : Verdict::kFail,
                   d.identical() ? "No bit differs."
                   : d.agrees()  ? "Everything is within the tolerances."
                                 : "Something differs beyond the tolerances.");
    std::string list;
    for (const std::string& line : DifferenceLines(d)) list += "- " + line + "\n";
    if (!list.empty()) report.Text(list);
    AddEvents(report, d);
    std::size_t figures = 0;
    for (const ChannelDifference* c : Worst(d.record))
      if (figures++ < kMostFigures) AddCurves(report, run, *c);
    AddChannels(report, d);
  }
  report.Write(path);
}

}  // namespace ambrig
