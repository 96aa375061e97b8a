#include "app/figures/residual_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/figures/series.h"
#include "core/math/fft.h"

namespace ambrig {
namespace {

constexpr std::size_t kPoints = 1500;  // per line: a report has many

struct Stretch {
  std::size_t first = 0, last = 0;
};

/// The 4 % of the record (60 rows at least) where the error is largest.
Stretch WorstStretch(const ChannelView& v) {
  const std::size_t n = v.t.size(), length = std::min(n, std::max<std::size_t>(60, n / 25));
  const std::vector<double> r = Filled(v.residual);
  double sum = 0, most = -1;
  Stretch out{0, n};
  for (std::size_t k = 0; k < n; ++k) {
    sum += r[k] * r[k];
    if (k >= length) sum -= r[k - length] * r[k - length];
    if (k + 1 < length || sum <= most) continue;
    most = sum;
    out = {k + 1 - length, k + 1};
  }
  return out;
}

std::vector<double> CutToStretch(const std::vector<double>& x, Stretch s) {
  return {x.begin() + static_cast<std::ptrdiff_t>(s.first),
          x.begin() + static_cast<std::ptrdiff_t>(s.last)};
}

void AddResidualLine(Figure& figure, int panel, const std::string& name,
                     const std::vector<double>& x, const std::vector<double>& y,
                     const std::string& color, bool legend, double width = 1.3) {
  const Points p = Decimate(x, y, kPoints);
  Style style;
  style.color = color;
  style.width = width;
  style.legend = legend;
  AddLine(figure, panel, name, p.x, p.y, style);
}

DisplayUnit UnitOfTarget(const CaseModel& model, const Target& t, double largest) {
  return ChooseUnit(largest, model.data().records[t.record].data.channels[t.channel].unit);
}

std::string Title(const CaseModel& model, const Target& t) {
  return ChannelName(model, t) + ", " + ShortName(model.data().records[t.record].data_file);
}

Grid ColumnGrid(const CaseModel& model, const std::vector<Target>& channels, int rows, int height) {
  Grid grid;
  grid.rows = rows;
  grid.columns = std::max(1, static_cast<int>(channels.size()));
  grid.shared_x = false;
  grid.panel_height = height;
  for (int row = 0; row < rows; ++row)
    for (const Target& t : channels)
      grid.titles.push_back(row == 0 ? Title(model, t) : row == 1 ? "where it errs most" : "error");
  return grid;
}

/// The panels of one channel: column `c` of the grid.
void TimePanels(Figure& figure, const CaseModel& model, const Target& t, int c, int columns,
                const std::vector<NamedPrediction>& predictions) {
  const ChannelView first = ViewOf(model, *predictions[0].values, t);
  const Stretch zoom = WorstStretch(first);
  const DisplayUnit unit = UnitOfTarget(model, t, LargestSize(first.measured));
  const DisplayUnit error = UnitOfTarget(model, t, std::max(LargestSize(first.residual), t.floor));
  const auto whole = [&](int row, const std::string& name, const std::vector<double>& y,
                         const std::string& color, double width, bool legend) {
    AddResidualLine(figure, row * columns + c, name, first.t,
                    Scaled(y, row == 2 ? error.factor : unit.factor), color, legend, width);
  };
  const auto part = [&](const std::string& name, const std::vector<double>& y,
                        const std::string& color, double width) {
    AddResidualLine(figure, columns + c, name, CutToStretch(first.t, zoom),
                    CutToStretch(Scaled(y, unit.factor), zoom), color, false, width);
  };
  whole(0, "measured", first.measured, "@ink", 1.8, c == 0);
  part("measured", first.measured, "@ink", 1.8);
  for (const NamedPrediction& p : predictions) {
    const ChannelView v = ViewOf(model, *p.values, t);
    whole(0, p.name, v.model, p.color, 1, c == 0);
    part(p.name, v.model, p.color, 1.3);
    whole(2, p.name, v.residual, p.color, 0.9, false);
  }
  const std::vector<double> ends = {first.t.front(), first.t.back()};
  const double band = 2 * t.floor * error.factor;
  AddBand(figure, 2 * columns + c, "twice the noise", ends, std::vector<double>{-band, -band},
          std::vector<double>{band, band}, "@gray");
  figure.traces.back()["showlegend"] = c == 0;
  AddRegion(figure, c, first.t[zoom.first], first.t[zoom.last - 1], "", "@red/15");
  SetAxes(figure, c, "", fmt::format("{} [{}]", first.channel, unit.name));
  SetAxes(figure, columns + c, "", fmt::format("{} [{}]", first.channel, unit.name));
  SetAxes(figure, 2 * columns + c, "time [s]", fmt::format("error [{}]", error.name));
}

/// Powers of ten only: digits between them are unreadable in narrow panels.
void DecadeTicks(Figure& figure, int panel) {
  const std::string number = panel == 0 ? "" : std::to_string(panel + 1);
  figure.layout["xaxis" + number]["dtick"] = 1;
  figure.layout["yaxis" + number]["dtick"] = "D2";
}

struct Density {
  std::vector<double> f, a;
};

Density AmplitudeDensity(const std::vector<double>& x, double rate, double factor) {
  std::size_t segment = 64;
  while (segment * 6 <= x.size()) segment *= 2;
  const PowerDensity p = WelchPsd(Filled(x), rate, std::min(segment, x.size()));
  // lines nearer than 2 % are averaged: on a logarithmic axis they would make a black band
  Density d;
  for (std::size_t k = 1; k < p.frequency.size();) {
    double sum = 0, n = 0, f = 0;
    for (const double first = p.frequency[k];
         k < p.frequency.size() && (n == 0 || p.frequency[k] < 1.02 * first); ++k, ++n) {
      sum += p.density[k];
      f += p.frequency[k];
    }
    d.f.push_back(f / n);
    d.a.push_back(std::sqrt(sum / n) * factor);
  }
  return d;
}

std::vector<double> RowsOfTarget(const std::vector<double>& flat, const Target& t) {
  return {flat.begin() + static_cast<std::ptrdiff_t>(t.first),
          flat.begin() + static_cast<std::ptrdiff_t>(t.first + t.count)};
}

}  // namespace

Figure TimeFigure(const CaseModel& model, const std::vector<Target>& channels,
                  const std::vector<NamedPrediction>& predictions, const std::string& caption) {
  Figure figure = MakeFigure(caption, ColumnGrid(model, channels, 3, 170));
  const int columns = static_cast<int>(channels.size());
  for (int c = 0; c < columns; ++c)
    TimePanels(figure, model, channels[static_cast<std::size_t>(c)], c, columns, predictions);
  return figure;
}

Figure SpectrumFigure(const CaseModel& model, const std::vector<Target>& channels,
                      const std::vector<NamedPrediction>& predictions,
                      const std::vector<double>& noise, const std::string& caption) {
  Figure figure = MakeFigure(caption, ColumnGrid(model, channels, 1, 260));
  for (int c = 0; c < static_cast<int>(channels.size()); ++c) {
    const Target& t = channels[static_cast<std::size_t>(c)];
    if (t.count < 8) continue;
    const ChannelView first = ViewOf(model, *predictions[0].values, t);
    const DisplayUnit unit =
        UnitOfTarget(model, t, LargestSize(AmplitudeDensity(first.residual, first.rate, 1).a));
    for (const NamedPrediction& p : predictions) {
      const Density d =
          AmplitudeDensity(ViewOf(model, *p.values, t).residual, first.rate, unit.factor);
      AddResidualLine(figure, c, "error of " + p.name, d.f, d.a, p.color, c == 0);
    }
    const double flat = t.floor * unit.factor / std::sqrt(first.rate / 2);
    Density n{{first.rate / 1000, first.rate / 2}, {flat, flat}};
    if (!noise.empty()) n = AmplitudeDensity(RowsOfTarget(noise, t), first.rate, unit.factor);
    AddResidualLine(figure, c, "noise alone", n.f, n.a, "@gray", c == 0);
    SetAxes(figure, c, "frequency [Hz]", fmt::format("error density [{}/√Hz]", unit.name));
    LogAxes(figure, c, true, true);
    DecadeTicks(figure, c);
  }
  return figure;
}

Figure WhitenessFigure(const CaseModel& model, const std::vector<Target>& channels,
                       const std::vector<NamedPrediction>& predictions,
                       const std::vector<double>& noise, const std::string& caption) {
  Figure figure = MakeFigure(caption, ColumnGrid(model, channels, 1, 200));
  for (int c = 0; c < static_cast<int>(channels.size()); ++c) {
    const Target& t = channels[static_cast<std::size_t>(c)];
    const std::size_t lags = std::min<std::size_t>(t.count / 4 + 1, 120);
    std::vector<double> lag(lags);
    for (std::size_t k = 0; k < lags; ++k)
      lag[k] = 1e3 * static_cast<double>(k) / model.data().records[t.record].data.rate;
    for (const NamedPrediction& p : predictions)
      AddResidualLine(figure, c, "error of " + p.name, lag,
                      Autocorrelation(ViewOf(model, *p.values, t).residual, lags), p.color, c == 0);
    if (!noise.empty())
      AddResidualLine(figure, c, "noise alone", lag, Autocorrelation(RowsOfTarget(noise, t), lags),
                      "@gray", c == 0);
    SetAxes(figure, c, "lag [ms]", c == 0 ? "autocorrelation [-]" : "", {},
            std::array{-1.05, 1.05});
  }
  return figure;
}

Figure SignatureFigure(const CaseModel& model, const Target& channel,
                       const std::vector<NamedPrediction>& predictions,
                       const std::string& caption) {
  Grid grid;
  grid.rows = static_cast<int>(predictions.size()) - 1;
  grid.panel_height = 150;
  for (std::size_t k = 1; k < predictions.size(); ++k) grid.titles.push_back(predictions[k].name);
  Figure figure = MakeFigure(caption, grid);
  const ChannelView first = ViewOf(model, *predictions[0].values, channel);
  const Stretch whole = {0, first.t.size()}, worst = WorstStretch(first);
  const std::size_t length = worst.last - worst.first;  // shown with as much on both sides
  const Stretch zoom = {worst.first > length ? worst.first - length : 0,
                        std::min(whole.last, worst.last + length)};
  const DisplayUnit unit = UnitOfTarget(model, channel, LargestSize(first.residual));
  for (std::size_t k = 1; k < predictions.size(); ++k) {
    const int panel = static_cast<int>(k) - 1;
    std::vector<double> added = ViewOf(model, *predictions[k].values, channel).model;
    for (std::size_t i = 0; i < added.size(); ++i)
      added[i] = (added[i] - first.model[i]) * unit.factor;
    AddResidualLine(figure, panel, "residual of the rig file's model", CutToStretch(first.t, zoom),
                    CutToStretch(Scaled(first.residual, unit.factor), zoom), "@ink", k == 1, 1.6);
    AddResidualLine(figure, panel, k == 1 ? "best-ranked effect" : "another candidate",
                    CutToStretch(first.t, zoom), CutToStretch(added, zoom),
                    k == 1 ? "@green" : "@orange", k <= 2);
    SetAxes(figure, panel, "time [s]", fmt::format("{} [{}]", first.channel, unit.name));
  }
  return figure;
}

}  // namespace ambrig
