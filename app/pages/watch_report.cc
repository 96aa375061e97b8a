#include "app/pages/watch_report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/figures/series.h"
#include "app/pages/html.h"
#include "app/text/format.h"
#include "core/base/counted.h"

namespace ambrig {

namespace {

using Json = nlohmann::ordered_json;

/// A column of numbers over the records, nan where a record has none.
double NumberAt(const Json& record, const char* key) {
  return record.contains(key) && record[key].is_number() ? record[key].get<double>() : std::nan("");
}

std::string TimeText(const Json& record) {
  return fmt::format("{:%F %R}",
                     fmt::gmtime(static_cast<std::time_t>(NumberAt(record, "changed"))));
}

struct Column {
  std::vector<double> at, value;
};

Column ColumnOf(const Json& records, const char* key, double factor) {
  Column c;
  for (std::size_t k = 0; k < records.size(); ++k) {
    if (records[k]["state"] == "refused" || records[k]["state"] == "data") continue;
    c.at.push_back(static_cast<double>(k + 1));
    c.value.push_back(factor * NumberAt(records[k], key));
  }
  return c;
}

void AddFloors(HtmlReport& report, const Json& records) {
  Grid grid;
  grid.rows = 2;
  Figure f = MakeFigure(
      "Error over noise of every record, with the parameters of its reference and with its own; "
      "and the share of the error above the noise that its own parameters explain.",
      grid);
  Style points;
  points.markers = true;
  points.size = 7;
  const Column as = ColumnOf(records, "ratio", 1), own = ColumnOf(records, "ratio_fitted", 1),
               closure = ColumnOf(records, "explained", 100);
  points.color = "@orange";
  AddLine(f, 0, "parameters of the reference", as.at, as.value, points);
  points.color = "@blue";
  AddLine(f, 0, "its own parameters", own.at, own.value, points);
  AddLevel(f, 0, 1, "noise alone");
  AddLine(f, 1, "closure", closure.at, closure.value, points);
  SetAxes(f, 0, "", "error over noise [-]");
  SetAxes(f, 1, "record", "closure [%]");
  report.AddFigure(f);
}

void AddParameter(HtmlReport& report, const Json& records, const std::string& path) {
  std::vector<double> at, value, sd, least, greatest;
  std::string unit;
  for (std::size_t k = 0; k < records.size(); ++k) {
    if (!records[k].contains("parameters") || !records[k]["parameters"].contains(path)) continue;
    const Json& p = records[k]["parameters"][path];
    unit = p["unit"].get<std::string>();
    at.push_back(static_cast<double>(k + 1));
    value.push_back(NumberAt(p, "value"));
    sd.push_back(NumberAt(p, "sd"));
    least.push_back(NumberAt(p, "least"));
    greatest.push_back(NumberAt(p, "greatest"));
  }
  const DisplayUnit shown = ChooseUnit(LargestSize(value), unit);
  Figure f = MakeFigure(path +
                        ": value and sd of every record; shaded: where 99 of 100 unchanged "
                        "records keep all their parameters.");
  f.height = 220;
  AddBand(f, 0, "band", at, Scaled(least, shown.factor), Scaled(greatest, shown.factor), "@green");
  Style points;
  points.markers = true;
  points.size = 7;
  AddLine(f, 0, path, at, Scaled(value, shown.factor), points);
  f.traces.back()["error_y"] = {{"type", "data"}, {"array", Numbers(Scaled(sd, shown.factor))}};
  SetAxes(f, 0, "record", shown.name.empty() ? "[-]" : "[" + shown.name + "]");
  report.AddFigure(f);
}

/// Largest change of each parameter in sd, those that moved most first.
std::vector<std::pair<double, std::string>> Moved(const Json& records) {
  std::map<std::string, double> most;
  for (const Json& r : records)
    if (r.contains("parameters"))
      for (const auto& [path, p] : r["parameters"].items()) {
        const double sds = std::abs(NumberAt(p, "sds"));
        most[path] = std::max(most[path], std::isfinite(sds) ? sds : 0);
      }
  std::vector<std::pair<double, std::string>> out;
  for (const auto& [path, sds] : most) out.emplace_back(sds, path);
  std::ranges::stable_sort(out, [](const auto& a, const auto& b) { return a.first > b.first; });
  return out;
}

Cell StateCell(const Json& r) {
  const std::string state = r["state"];
  if (state == "ok") return {"within its bands", "ok"};
  std::string text = state == "refused" ? "refused: " + r["error"].get<std::string>() : "";
  if (state == "data")
    for (const Json& f : r["data_faults"]) text += f["text"].get<std::string>() + ". ";
  for (const Json& b : r["left"]) text += b["text"].get<std::string>() + ". ";
  if (r.contains("explanation")) text += r["explanation"]["text"].get<std::string>() + ".";
  return {text, state == "left" ? "fail" : "warn"};
}

void AddWatchedRecords(HtmlReport& report, const Json& records) {
  std::vector<std::vector<Cell>> rows;
  for (std::size_t k = 0; k < records.size(); ++k) {
    const Json& r = records[k];
    rows.push_back({fmt::format("{}", k + 1), r["data"].get<std::string>(), TimeText(r),
                    r.value("of", "-"), FormatNumber(NumberAt(r, "ratio"), 3),
                    FormatNumber(NumberAt(r, "ratio_fitted"), 3), StateCell(r)});
  }
  report.Table({"", "record", "written (UTC)", "as", "error over noise", "own parameters", ""},
               rows);
}

}  // namespace

void WriteWatchReport(const Json& document, const std::string& path) {
  const Json& records = document["records"];
  HtmlReport report(
      "Trend of " + document["case"].get<std::string>(),
      Counted(records.size(), "record") + " of " + document["folder"].get<std::string>());
  const auto bad = std::count_if(records.begin(), records.end(),
                                 [](const Json& r) { return r["state"] != "ok"; });
  report.Heading("Records");
  report.Verdict(records.empty() ? Verdict::kInfo
                 : bad == 0      ? Verdict::kOk
                                 : Verdict::kWarn,
                 records.empty() ? "no record yet"
                 : bad == 0      ? "all records stay within their bands"
                                 : fmt::format("{} of {} need somebody's attention", bad,
                                               Counted(records.size(), "record")));
  for (const Json& w : document["warnings"]) report.Verdict(Verdict::kWarn, w.get<std::string>());
  AddWatchedRecords(report, records);
  if (!records.empty()) {
    report.Heading("Error and closure");
    AddFloors(report, records);
    report.Heading("Parameters, the most moved first");
    const auto moved = Moved(records);
    for (std::size_t k = 0; k < moved.size(); ++k) {
      if (k == 8) report.BeginDetails("all other parameters");
      AddParameter(report, records, moved[k].second);
    }
    if (moved.size() > 8) report.EndDetails();
  }
  report.Write(path);
}

}  // namespace ambrig
