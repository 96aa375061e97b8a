#include "app/pages/practice_page.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/pages/html.h"
#include "core/base/counted.h"

namespace ambrig {

namespace {

std::string ShareText(const Share& s) {
  if (s.of == 0) return "-";
  return fmt::format("{} of {} ({:.0f} to {:.0f} %)", s.right, s.of, 100 * s.lo, 100 * s.hi);
}

std::string KindText(const std::string& kind) {
  if (kind == "all") return "all cases";
  if (kind == "one") return "one effect";
  if (kind == "two") return "two effects";
  if (kind == "three") return "three effects";
  if (kind == "unknown") return "physics outside the catalogue";
  return kind == "nothing" ? "no effect" : "wrong data";
}

void CountsTable(HtmlReport& report, const PracticeSummary& s, std::string_view caption) {
  std::vector<std::vector<Cell>> rows;
  for (const PracticeCount& c : s.counts)
    rows.push_back({KindText(c.kind), ShareText(c.right), ShareText(c.verdict), ShareText(c.in_set),
                    fmt::format("{:.1f}", c.mean_set)});
  report.Table({"kind of case", "all right", "verdict right", "in the 95 % set", "set"}, rows,
               caption);
}

std::string ErrorText(const CalibrationError& e) {
  return fmt::format("{:.3f} +- {:.3f} (true probabilities would give {:.3f} with as many cases)",
                     e.value, e.sd, e.by_chance);
}

void ReliabilityFigure(HtmlReport& report, const PracticeSummary& s, const std::string& which) {
  std::vector<double> stated, found, lo, hi;
  for (const ReliabilityBin& b : s.bins) {
    if (b.count == 0) continue;
    const auto right = static_cast<std::size_t>(b.found * static_cast<double>(b.count) + 0.5);
    const Share share = ShareOf(right, b.count);
    stated.push_back(b.stated);
    found.push_back(b.found);
    lo.push_back(share.lo);
    hi.push_back(share.hi);
  }
  Figure figure = MakeFigure("Reliability of the most probable answer, " + which +
                             ": share that was right against the probability that was stated, in "
                             "ten intervals; band: 95 % "
                             "of the share. On the diagonal the probabilities are true.");
  SetAxes(figure, 0, "stated probability [-]", "share right [-]", {{0, 1}}, {{0, 1}});
  const double ends[] = {0, 1};
  Style diagonal;
  diagonal.color = "@muted";
  diagonal.dash = "dash";
  AddLine(figure, 0, "true probabilities", ends, ends, diagonal);
  if (!stated.empty()) AddBand(figure, 0, "95 % of the share", stated, lo, hi, "@blue");
  Style points;
  points.markers = true;
  points.size = 8;
  AddLine(figure, 0, "cases", stated, found, points);
  figure.narrow = 560;
  report.AddFigure(figure);
}

void Confusions(HtmlReport& report, const std::map<std::string, std::map<std::string, int>>& all,
                const std::string& caption) {
  if (all.empty()) return;
  std::vector<std::string> columns, rows;
  std::vector<std::vector<double>> values;
  for (const auto& [hidden, said] : all)
    for (const auto& [name, n] : said)
      if (std::find(columns.begin(), columns.end(), name) == columns.end()) columns.push_back(name);
  std::sort(columns.begin(), columns.end());
  for (const auto& [hidden, said] : all) {
    rows.push_back(hidden);
    values.emplace_back();
    for (const std::string& c : columns) {
      const auto it = said.find(c);
      values.back().push_back(it == said.end() ? 0 : it->second);
    }
  }
  report.Heatmap(caption, columns, rows, values, "cases");
}

void CasesTable(HtmlReport& report, const std::vector<PracticeResult>& results) {
  std::vector<std::vector<Cell>> rows;
  for (const PracticeResult& r : results) {
    const bool right = r.failure.empty() && ScoreCase(r.name, r.answer, r.finding).right();
    const JudgedResult j = JudgeResult(r, nullptr);
    std::string laws;
    for (const std::string& law : r.laws) laws += (laws.empty() ? "" : ", ") + law;
    rows.push_back(
        {r.name, r.rig, HiddenText(r), r.mistake.empty() ? laws : r.mistake, SaidText(r),
         fmt::format("{:.2f}", j.best.probability),
         Cell(std::string(right ? "right" : "wrong") + (j.in_set ? ", in set" : ", not in set"),
              right && j.in_set   ? "ok"
              : right || j.in_set ? "warn"
                                  : "fail"),
         r.noise + "; " + r.nuisances});
  }
  report.Table({"case", "rig", "hidden", "law or mistake", "said", "p", "", "noise; nuisances"},
               rows);
}

}  // namespace

void WritePracticeReport(const std::vector<PracticeResult>& results,
                         const PracticeSummary& as_computed, const PracticeSummary* calibrated,
                         const std::string& file) {
  HtmlReport report("Practice of explain",
                    Counted(results.size(), "case") + " with laws that are not the catalogue's");
  report.Heading("How often it is right");
  CountsTable(
      report, as_computed,
      "As computed. In brackets: the share's interval of 95 % (Wilson). All right: verdict, every "
      "effect found, none invented. Set: mean number of members.");
  report.KeyValues({{"expected calibration error, as computed", ErrorText(as_computed.error)},
                    {"wrong data recognised", ShareText(as_computed.data_recognised)},
                    {"effects named from wrong data at a probability above one half",
                     std::to_string(as_computed.named_from_wrong_data)},
                    {"cases that ended with an error", std::to_string(as_computed.failed)}});
  ReliabilityFigure(report, as_computed, "as computed");
  if (calibrated) {
    report.Heading("After calibration");
    report.Text(
        "Fitted with the law families of one half, judged here on the cases of the other half.");
    CountsTable(report, *calibrated, "Calibrated probabilities and conformal sets.");
    report.Text("Expected calibration error, calibrated: " + ErrorText(calibrated->error) + ".");
    ReliabilityFigure(report, *calibrated, "calibrated");
  }
  report.Heading("What was said of every law family");
  Confusions(report, as_computed.by_family,
             "Rows: family of the hidden law; columns: what was said of it.");
  Confusions(report, as_computed.by_mistake,
             "Rows: the logger's mistake; columns: verdict, or the effect that was named.");
  report.Heading("Every case");
  CasesTable(report, results);
  report.Write(file);
}

}  // namespace ambrig
