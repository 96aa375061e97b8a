#include "app/figures/bench_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>

#include "app/figures/series.h"
#include "core/math/constants.h"

namespace ambrig {
namespace {

using Complex = std::complex<double>;

Style PointStyle(const std::string& color, bool markers, bool legend = true) {
  Style style;
  style.color = color;
  style.markers = markers;
  style.legend = legend;
  return style;
}

/// The targets of a record by its channels; nullptr where a channel is none.
std::vector<const Target*> TargetsOfRecord(const CaseModel& model, std::size_t record) {
  std::vector<const Target*> out(model.data().records[record].data.channels.size(), nullptr);
  for (const Target& t : model.targets())
    if (t.record == record) out[t.channel] = &t;
  return out;
}

/// One response as it is drawn: the points that count.
struct DrawnResponse {
  std::vector<double> f, sd;
  std::vector<Complex> measured;
  std::vector<std::vector<Complex>> models;
  double floor = 1;
};

DrawnResponse Draw(const CaseModel& model, const std::vector<NamedPrediction>& models,
                   const RigResponse& r, const std::vector<double>& f, const Target& re,
                   const Target& im) {
  DrawnResponse out;
  out.models.resize(models.size());
  out.floor = re.floor;
  for (std::size_t k = 0; k < re.count; ++k) {
    const std::size_t point = model.sample(re.first + k);
    if (!model.ok()[re.first + k] || !model.ok()[im.first + k]) continue;
    out.f.push_back(f[point]);
    out.sd.push_back(r.sd[point] * re.floor);
    out.measured.push_back(r.values[point]);
    for (std::size_t m = 0; m < models.size(); ++m) {
      const std::vector<double>& predicted = *models[m].values;
      out.models[m].push_back(r.sd[point] *
                              Complex(predicted[re.first + k], predicted[im.first + k]));
    }
  }
  return out;
}

std::vector<double> Sizes(const std::vector<Complex>& z) {
  std::vector<double> out;
  for (const Complex& v : z) out.push_back(std::abs(v));
  return out;
}

/// Phase [deg], continuous from point to point; `near`: a curve to stay beside, or empty.
std::vector<double> PhaseInDegrees(const std::vector<Complex>& z, const std::vector<double>& near) {
  std::vector<double> out;
  for (std::size_t k = 0; k < z.size(); ++k) {
    const double p = std::arg(z[k]) * 180 / kPi;
    const double beside = !near.empty() ? near[k] : out.empty() ? p : out.back();
    out.push_back(p + 360 * std::round((beside - p) / 360));
  }
  return out;
}

/// |model - measured| over the sd of a point.
std::vector<double> ErrorsOverSd(const DrawnResponse& d, const std::vector<Complex>& model) {
  std::vector<double> out;
  for (std::size_t k = 0; k < model.size(); ++k)
    out.push_back(std::abs(model[k] - d.measured[k]) / d.sd[k] / std::sqrt(2.0));
  return out;
}

Figure BodeFigure(const std::vector<NamedPrediction>& models, const RigResponse& r,
                  const DrawnResponse& d) {
  Grid grid;
  grid.rows = 3;
  grid.panel_height = 190;
  grid.titles = {r.name(), "", ""};
  Figure figure = MakeFigure(
      fmt::format("Response {} under excitation of {}: measured (points) and by the model. Bottom: "
                  "error over its sd{}; 1 is noise.",
                  r.name(), r.excited.name,
                  r.sd_known ? "" : ", estimated from the scatter of neighbouring points"),
      grid);
  const std::vector<double> size = Sizes(d.measured), phase = PhaseInDegrees(d.measured, {});
  const DisplayUnit unit = ChooseUnit(LargestSize(size), r.unit == "-" ? "" : r.unit);
  AddLine(figure, 0, "measured", d.f, Scaled(size, unit.factor), PointStyle("@ink", true));
  AddLine(figure, 1, "measured", d.f, phase, PointStyle("@ink", true, false));
  for (std::size_t m = 0; m < models.size(); ++m) {
    const std::string& color = models[m].color;
    AddLine(figure, 0, models[m].name, d.f, Scaled(Sizes(d.models[m]), unit.factor),
            PointStyle(color, false));
    AddLine(figure, 1, models[m].name, d.f, PhaseInDegrees(d.models[m], phase),
            PointStyle(color, false, false));
    AddLine(figure, 2, models[m].name, d.f, ErrorsOverSd(d, d.models[m]),
            PointStyle(color, false, false));
  }
  SetAxes(figure, 0, "", fmt::format("magnitude [{}]", unit.name.empty() ? "-" : unit.name));
  SetAxes(figure, 1, "", "phase [deg]");
  SetAxes(figure, 2, "frequency [Hz]", "error / sd [-]");
  for (const int panel : {0, 1, 2}) LogAxes(figure, panel, true, panel != 1);
  AddLevel(figure, 2, 1, "noise");
  return figure;
}

/// The input of a table whose values spread most against their size.
const Channel* VariedMost(const StaticTable& table) {
  const Channel* best = nullptr;
  double most = -1;
  for (const Channel& in : table.inputs) {
    double least = kInfinity, greatest = -kInfinity;
    std::vector<double> seen;
    for (const double v : in.samples)
      if (std::isfinite(v)) {
        least = std::min(least, v);
        greatest = std::max(greatest, v);
        if (std::ranges::find(seen, v) == seen.end()) seen.push_back(v);
      }
    const double spread = greatest > least ? static_cast<double>(seen.size()) : 0;
    if (spread > most) most = spread, best = &in;
  }
  return best;
}

Figure TableFigure(const CaseModel& model, const std::vector<NamedPrediction>& models,
                   const CaseRecord& record, const Target& t) {
  const Channel& out = record.table.outputs[t.channel];
  const Channel* input = VariedMost(record.table);
  std::vector<double> x, measured, sd;
  std::vector<std::vector<double>> predicted(models.size()), error(models.size());
  for (std::size_t k = 0; k < t.count; ++k) {
    const std::size_t row = model.sample(t.first + k);
    if (!model.ok()[t.first + k]) continue;
    x.push_back(input ? input->samples[row] : static_cast<double>(row + 1));
    measured.push_back(out.samples[row]);
    sd.push_back(record.table.sd[t.channel][row]);
    for (std::size_t m = 0; m < models.size(); ++m) {
      predicted[m].push_back((*models[m].values)[t.first + k] * sd.back());
      error[m].push_back((measured.back() - predicted[m].back()) / sd.back() / t.floor);
    }
  }
  const DisplayUnit y_unit = ChooseUnit(LargestSize(measured), out.unit),
                    x_unit = ChooseUnit(LargestSize(x), input ? input->unit : "");
  Grid grid;
  grid.rows = 2;
  grid.panel_height = 220;
  Figure figure = MakeFigure(
      fmt::format("{} of the table: measured and by the model. Bottom: error over its sd{}; 1 is "
                  "noise.",
                  out.name,
                  record.table.sd_known[t.channel] ? "" : ", estimated from the scatter of rows"),
      grid);
  AddLine(figure, 0, "measured", Scaled(x, x_unit.factor), Scaled(measured, y_unit.factor),
          PointStyle("@ink", true));
  for (std::size_t m = 0; m < models.size(); ++m) {
    Style style = PointStyle(models[m].color, true);
    style.size = 3;
    AddLine(figure, 0, models[m].name, Scaled(x, x_unit.factor),
            Scaled(predicted[m], y_unit.factor), style);
    style.legend = false;
    AddLine(figure, 1, models[m].name, Scaled(x, x_unit.factor), error[m], style);
  }
  const std::string over =
      input ? fmt::format("{} [{}]", input->name, x_unit.name) : std::string("row");
  SetAxes(figure, 0, "", fmt::format("{} [{}]", out.name, y_unit.name));
  SetAxes(figure, 1, over, "error / sd [-]");
  return figure;
}

}  // namespace

std::vector<Figure> BenchFigures(const CaseModel& model, const std::vector<NamedPrediction>& models,
                                 std::size_t record) {
  const CaseRecord& r = model.data().records[record];
  std::vector<Figure> out;
  if (r.kind == RecordKind::kTime) return out;
  const std::vector<const Target*> targets = TargetsOfRecord(model, record);
  for (std::size_t k = 0; k < targets.size(); ++k) {
    if (!targets[k]) continue;
    if (r.kind == RecordKind::kStatic) out.push_back(TableFigure(model, models, r, *targets[k]));
    if (r.kind != RecordKind::kFrf || k % 2 != 0 || !targets[k + 1]) continue;
    const RigResponse& response = r.responses.responses[k / 2];
    out.push_back(BodeFigure(
        models, response,
        Draw(model, models, response, r.responses.frequency, *targets[k], *targets[k + 1])));
  }
  return out;
}

}  // namespace ambrig
