#include "app/report/discovery_report.h"

#include <fmt/format.h>

#include "app/report/html.h"

namespace ambrig {

namespace {

void RatioHeatmap(HtmlReport& report, const Comparison& c, const std::string& caption) {
  std::vector<std::string> columns, rows;
  std::vector<std::vector<double>> values;
  for (const RecordComparison& r : c.records) {
    rows.push_back(r.data.substr(r.data.find_last_of('/') + 1));
    std::vector<double> line(columns.size(), 0);
    for (const ChannelError& e : r.channels) {
      std::size_t at = 0;
      while (at < columns.size() && columns[at] != e.channel) ++at;
      if (at == columns.size()) {
        columns.push_back(e.channel);
        line.push_back(0);
        for (auto& v : values) v.push_back(0);
      }
      line[at] = e.ratio;
    }
    values.push_back(line);
  }
  report.Heatmap(caption, columns, rows, values, "error / noise");
}

void Ladder(HtmlReport& report, const std::vector<LadderStep>& ladder) {
  std::vector<std::vector<Cell>> rows;
  for (const LadderStep& s : ladder)
    rows.push_back({Cell(s.added.empty() ? "rig file as it is" : s.added), Cell(fmt::format("{:.3f}", s.ratio_fit)), Cell(fmt::format("{:.3f}", s.ratio_validate))});
  report.Table({"believed", "error / noise, fitted records", "error / noise, unseen records"}, rows, "The ladder: error against what was added.");
}

}  // namespace

void WriteCompareReport(const CaseModel& model, const Comparison& comparison, const std::string& path) {
  HtmlReport report("Model beside measurement", model.data().file);
  report.Heading("Where the model fails");
  std::string list;
  for (const std::string& w : comparison.words) list += "- " + w + "\n";
  report.Text(list);
  RatioHeatmap(report, comparison, "Error of every channel over its noise floor; 1 means nothing is left to explain.");
  report.Write(path);
}

void WriteExplainReport(const Case& c, const Explanation& e, const std::string& path) {
  HtmlReport report("Which effect is missing?", c.file);
  report.Heading("Verdict");
  report.Text("**" + e.verdict + "**");
  Ladder(report, e.ladder);
  report.Write(path);
}

void WriteAdoptReport(const CaseModel& model, const Comparison& before, const Comparison& after,
                      const std::vector<LadderStep>& ladder, const std::string& path) {
  HtmlReport report("Effect adopted", model.data().file);
  report.Heading("The ladder");
  Ladder(report, ladder);
  report.Heading("Before and after");
  RatioHeatmap(report, before, "Before: error of every channel over its noise floor.");
  RatioHeatmap(report, after, "After.");
  report.Write(path);
}

}  // namespace ambrig
