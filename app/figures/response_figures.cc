#include "app/figures/response_figures.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>

#include "app/figures/series.h"
#include "app/text/format.h"
#include "core/math/constants.h"
#include "core/math/fft.h"
#include "core/math/linear_equations.h"

namespace ambrig {
namespace {

using Complex = std::complex<double>;

bool UnderForce(const Scenario& s) {
  return std::ranges::any_of(s.excitations, [](const Excitation& e) { return e.port == "force"; });
}

Style ResponseStyle(const std::string& color, bool legend, bool markers = false) {
  Style style;
  style.color = color;
  style.legend = legend;
  style.markers = markers;
  return style;
}

// ---- orders

constexpr int kOrders = 4;

struct OrderCurve {
  std::vector<double> at;  // speed [Hz] or time [s]
  std::array<std::vector<double>, kOrders> size;
};

/// Amplitudes of orders 1..4 in rows [first, last).
std::array<double, kOrders> OrdersIn(const std::vector<double>& x, const std::vector<double>& theta,
                                     std::size_t first, std::size_t last) {
  const auto n = static_cast<Eigen::Index>(last - first);
  Eigen::MatrixXd A(n, 2 * kOrders + 2);
  Eigen::VectorXd b(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const std::size_t row = first + static_cast<std::size_t>(k);
    A(k, 0) = 1;
    A(k, 1) = static_cast<double>(k) / static_cast<double>(n);
    for (int o = 1; o <= kOrders; ++o) {
      A(k, 2 * o) = std::cos(o * theta[row]);
      A(k, 2 * o + 1) = std::sin(o * theta[row]);
    }
    b(k) = x[row];
  }
  const Eigen::VectorXd c = SolveLeastSquares(A, b);
  std::array<double, kOrders> out{};
  for (int o = 1; o <= kOrders; ++o)
    out[static_cast<std::size_t>(o - 1)] = std::hypot(c(2 * o), c(2 * o + 1));
  return out;
}

bool RunsUp(const SpeedProfile& speed, double t0, double t1) {
  return std::abs(speed.Speed(t1) - speed.Speed(t0)) > kTurn * 10;
}

OrderCurve TrackOrders(const ChannelView& v, const std::vector<double>& series,
                       const SpeedProfile& speed) {
  const std::vector<double> x = Filled(series);
  std::vector<double> theta;
  for (const double t : v.t) theta.push_back(speed.Angle(t));
  const bool runs_up = RunsUp(speed, v.t.front(), v.t.back());
  const std::size_t least = static_cast<std::size_t>(0.02 * v.rate) + 40;
  OrderCurve track;
  for (std::size_t first = 0; first < x.size();) {
    std::size_t last = std::min(first + least, x.size());
    while (last < x.size() && theta[last - 1] - theta[first] < 4 * kTurn) ++last;
    if (theta[last - 1] - theta[first] >= 3.5 * kTurn) {
      const double middle = 0.5 * (v.t[first] + v.t[last - 1]);
      track.at.push_back(runs_up ? speed.Speed(middle) / kTurn : middle);
      const auto sizes = OrdersIn(x, theta, first, last);
      for (std::size_t o = 0; o < kOrders; ++o) track.size[o].push_back(sizes[o]);
    }
    first += std::max<std::size_t>(1, (last - first) / 2);
    if (last == x.size()) break;
  }
  return track;
}

}  // namespace

std::optional<Figure> OrderFigure(const CaseModel& model, const std::vector<double>& predicted,
                                  const Target& channel) {
  const CaseRecord& record = model.data().records[channel.record];
  const ChannelView v = ViewOf(model, predicted, channel);
  if (UnderForce(record.scenario)) return {};
  const OrderCurve measured = TrackOrders(v, v.measured, record.scenario.speed);
  if (measured.at.size() < 2) return {};
  const OrderCurve modelled = TrackOrders(v, v.model, record.scenario.speed);
  const OrderCurve error = TrackOrders(v, v.residual, record.scenario.speed);
  double largest = 0;
  for (const auto& s : measured.size) largest = std::max(largest, LargestSize(s));
  const DisplayUnit unit = ChooseUnit(largest, record.data.channels[channel.channel].unit);
  Grid grid;
  grid.columns = 2;
  grid.shared_x = false;
  grid.titles = {"order 1: " + v.channel + ", " + v.record, "error, order by order"};
  grid.panel_height = 230;
  Figure figure = MakeFigure(
      "Order tracks: motion synchronous with the rotor, once per turn (order 1), twice (order 2) "
      "and so on. Unbalance and bow are order 1, a run-out of the sensed surface is every order, a "
      "stiffness that differs between two directions of the shaft is order 2.",
      grid);
  const auto line = [&](int p, const std::string& name, const OrderCurve& t, std::size_t o,
                        const Style& style) {
    AddLine(figure, p, name, t.at, Scaled(t.size[o], unit.factor), style);
  };
  line(0, "measured", measured, 0, ResponseStyle("@ink", true));
  line(0, "model", modelled, 0, ResponseStyle("@orange", true));
  for (int o = 0; o < kOrders; ++o) {
    Style style = SeriesStyle(o);
    line(1, fmt::format("error, order {}", o + 1), error, static_cast<std::size_t>(o), style);
  }
  const bool runs_up = RunsUp(record.scenario.speed, v.t.front(), v.t.back());
  for (int p = 0; p < 2; ++p)
    SetAxes(figure, p, runs_up ? "speed [Hz]" : "time [s]",
            fmt::format("{} [{}]", p == 0 ? "amplitude" : "error", unit.name));
  return figure;
}

namespace {

// ---- force responses

struct Response {
  std::vector<double> f, magnitude, phase;  // [Hz], [m/N], [deg]
  bool lines = false;
};

void Push(Response& r, double f, Complex h) {
  r.f.push_back(f);
  r.magnitude.push_back(std::abs(h) * 1e6);
  r.phase.push_back(std::arg(h) * 360 / kTurn);
}

/// Hann-windowed line at f over the rows inside [start, stop).
Complex LineAt(const std::vector<double>& t, const std::vector<double>& x, double start,
               double stop, double f) {
  double mean = 0, n = 0;
  for (std::size_t k = 0; k < t.size(); ++k)
    if (t[k] >= start && t[k] < stop) mean += x[k], n += 1;
  mean /= std::max(1.0, n);
  Complex sum = 0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    if (t[k] < start || t[k] >= stop) continue;
    const double w = 1 - std::cos(kTurn * (t[k] - start) / (stop - start));
    sum += w * (x[k] - mean) * std::polar(1.0, -kTurn * f * t[k]);
  }
  return sum;
}

/// Lines that this length of record tells from those of the other axes.
bool Separate(const Scenario& s, const Excitation& mine, double f, double width) {
  for (const Excitation& e : s.excitations) {
    if (e.target == mine.target || e.port != "force") continue;
    for (const double other : e.frequencies)
      if (std::abs(other - f) < width) return false;
  }
  return true;
}

Response MultisineResponse(const Scenario& s, const Excitation& e, const ChannelView& v,
                           const std::vector<double>& u, const std::vector<double>& y) {
  Response r;
  r.lines = true;
  const double start = std::max(e.start, v.t.front()), stop = std::min(e.stop, v.t.back());
  for (const double f : e.frequencies)
    if (Separate(s, e, f, 1 / (stop - start)))
      Push(r, f, LineAt(v.t, y, start, stop, f) / LineAt(v.t, u, start, stop, f));
  return r;
}

Response WelchResponse(const ChannelView& v, const std::vector<double>& u,
                       const std::vector<double>& y) {
  Response r;
  const ResponseEstimate h = EstimateResponse(u, y, v.rate, std::max<std::size_t>(8, u.size() / 3));
  const double strongest = LargestSize(h.coherence);
  for (std::size_t k = 1; k < h.frequency.size(); ++k)
    if (h.coherence[k] > 0.6 * strongest) Push(r, h.frequency[k], h.response[k]);
  return r;
}

Response ResponseOf(const Scenario& s, const Excitation& e, const ChannelView& v,
                    const std::vector<double>& y) {
  std::vector<double> u;
  for (const double t : v.t) u.push_back(e.Value(t));
  return e.frequencies.empty() ? WelchResponse(v, u, Filled(y))
                               : MultisineResponse(s, e, v, u, Filled(y));
}

struct ForceAxis {
  const Excitation* excitation;
  const Target* target;
};

std::vector<ForceAxis> ForceAxes(const CaseModel& model, std::size_t record) {
  std::vector<ForceAxis> out;
  for (const Excitation& e : model.data().records[record].scenario.excitations)
    for (const Target& t : model.targets())
      if (e.port == "force" && t.record == record && ChannelName(model, t) == e.target)
        out.push_back({&e, &t});
  return out;
}

void ResponsePanels(Figure& figure, int c, int columns, const std::string& name, const Response& r,
                    const std::string& color) {
  AddLine(figure, c, name, r.f, r.magnitude,
          ResponseStyle(color, c == 0, r.lines && name == "measured"));
  AddLine(figure, columns + c, name, r.f, r.phase,
          ResponseStyle(color, false, r.lines && name == "measured"));
}

}  // namespace

std::optional<Figure> ResponseFigure(const CaseModel& model, const std::vector<double>& predicted,
                                     std::size_t record) {
  std::vector<ForceAxis> axes = ForceAxes(model, record);
  if (axes.empty()) return {};
  if (axes.size() > 4) axes.resize(4);
  const int columns = static_cast<int>(axes.size());
  Grid grid;
  grid.rows = 2;
  grid.columns = columns;
  grid.panel_height = 170;
  for (const ForceAxis& a : axes) grid.titles.push_back(a.excitation->target);
  Figure figure = MakeFigure(
      "Response to the injected force: displacement per newton, in closed loop. Where the model's "
      "line leaves the measured points, stiffness (low frequencies), damping (the hump) or delay "
      "(phase at high ones) is wrong. Points that scatter at high frequencies are noise. Curves "
      "that coincide with those of another axis are omitted.",
      grid);
  const Scenario& s = model.data().records[record].scenario;
  for (int c = 0; c < columns; ++c) {
    const ForceAxis& a = axes[static_cast<std::size_t>(c)];
    const ChannelView v = ViewOf(model, predicted, *a.target);
    ResponsePanels(figure, c, columns, "measured", ResponseOf(s, *a.excitation, v, v.measured),
                   "@ink");
    ResponsePanels(figure, c, columns, "model", ResponseOf(s, *a.excitation, v, v.model),
                   "@orange");
    SetAxes(figure, c, "", c == 0 ? "[µm/N]" : "");
    SetAxes(figure, columns + c, "frequency [Hz]", c == 0 ? "phase [deg]" : "");
    LogAxes(figure, c, true, true);
    LogAxes(figure, columns + c, true, false);
    for (const int panel : {c, columns + c})
      figure.layout["xaxis" + (panel == 0 ? std::string() : std::to_string(panel + 1))]["dtick"] =
          1;
    figure.layout["yaxis" + (c == 0 ? std::string() : std::to_string(c + 1))]["dtick"] = "D2";
  }
  return figure;
}

}  // namespace ambrig
