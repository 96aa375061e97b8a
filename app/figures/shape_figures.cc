#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/figures/series.h"
#include "app/figures/shaft_figures.h"
#include "app/json/analysis_json.h"
#include "app/text/format.h"
#include "core/math/constants.h"

namespace ambrig {

namespace {

constexpr std::size_t kShapesShown = 6;
constexpr int kShapeFrames = 24, kShapeTurns = 4, kShapeOrbits = 24, kShapePoints = 48;
// The x axis points out of the page, down to the left: lengths along it by this, at 35 degrees.
constexpr double kDepth = 0.55, kDepthAcross = 0.82, kDepthDown = 0.57;
constexpr double kShapeWidth = 3.2;  // length of the axis over the largest deflection

using Complex = std::complex<double>;

/// Motion of all shafts at their nodes and between, largest deflection 1 along x at phase 0.
struct SpaceShape {
  std::vector<double> along;  // 0 to kShapeWidth
  std::vector<Complex> x, y;
  std::vector<std::size_t> breaks;  // first place of every shaft behind the first
  std::vector<std::size_t> nodes;   // places of the nodes
};

void AddPoint(SpaceShape& s, double along, Complex x, Complex y) {
  s.along.push_back(along);
  s.x.push_back(x);
  s.y.push_back(y);
}

/// Between the nodes i and i + 1, by the element's own shape.
void AddInside(const BeamRotor& beam, const Eigen::VectorXcd& q, std::size_t i, int pieces,
               double left, double right, SpaceShape& out) {
  const ShaftElement& e = beam.elements[i];
  const auto a = 4 * static_cast<Eigen::Index>(i), b = a + 4;
  const Eigen::Vector4cd x(q(a), q(a + 3), q(b), q(b + 3)),
      y(q(a + 1), -q(a + 2), q(b + 1), -q(b + 2));  // psi is beta, -alpha
  for (int k = 1; k < pieces; ++k) {
    const double t = double(k) / pieces;
    const Eigen::RowVector4d w = ShapeAt(e, beam.theory, t * e.length).w;
    AddPoint(out, left + t * (right - left), w * x, w * y);
  }
}

SpaceShape ShapeInSpace(const BeamRotor& beam, const ClosedLoopMode& mode) {
  SpaceShape out;
  const auto [lo, hi] = std::minmax_element(beam.z.begin(), beam.z.end());
  const auto along = [&](std::size_t i) {
    return kShapeWidth * (beam.z[i] - *lo) / std::max(*hi - *lo, 1e-12);
  };
  const int pieces = std::max(1, kShapePoints / static_cast<int>(beam.elements.size()));
  for (std::size_t i = 0; i < beam.z.size(); ++i) {
    const auto at = 4 * static_cast<Eigen::Index>(i);
    if (i > 0 && beam.elements[i - 1].layers.empty())
      out.breaks.push_back(out.along.size());
    else if (i > 0)
      AddInside(beam, mode.q, i - 1, pieces, along(i - 1), along(i), out);
    out.nodes.push_back(out.along.size());
    AddPoint(out, along(i), mode.q(at), mode.q(at + 1));
  }
  Complex largest = 1;
  double peak = 0;
  for (auto* side : {&out.x, &out.y})
    for (const Complex& v : *side)
      if (std::abs(v) > peak) peak = std::abs(v), largest = v;
  for (auto* side : {&out.x, &out.y})
    for (Complex& v : *side) v /= largest;
  return out;
}

/// On the page, of a point (x, y) at a place along the axis.
std::array<double, 2> OnPage(double along, double x, double y) {
  return {along - kDepth * kDepthAcross * x, y - kDepth * kDepthDown * x};
}

/// The centre line at a phase, interrupted between shafts.
Points CentreLine(const SpaceShape& s, double phase) {
  Points out;
  const Complex turn = std::polar(1.0, phase);
  for (std::size_t i = 0; i < s.along.size(); ++i) {
    if (std::find(s.breaks.begin(), s.breaks.end(), i) != s.breaks.end()) {
      out.x.push_back(std::nan(""));
      out.y.push_back(std::nan(""));
    }
    const auto at = OnPage(s.along[i], (s.x[i] * turn).real(), (s.y[i] * turn).real());
    out.x.push_back(at[0]);
    out.y.push_back(at[1]);
  }
  return out;
}

/// Ellipses of some nodes as one line with gaps.
Points OrbitsInSpace(const SpaceShape& s) {
  Points out;
  const std::size_t step = std::max<std::size_t>(1, s.nodes.size() / kShapeOrbits);
  for (std::size_t n = 0; n < s.nodes.size(); n += step) {
    const std::size_t i = s.nodes[n];
    for (int k = 0; k <= kShapeFrames; ++k) {
      const Complex turn = std::polar(1.0, 2 * kPi * k / kShapeFrames);
      const auto at = OnPage(s.along[i], (s.x[i] * turn).real(), (s.y[i] * turn).real());
      out.x.push_back(at[0]);
      out.y.push_back(at[1]);
    }
    out.x.push_back(std::nan(""));
    out.y.push_back(std::nan(""));
  }
  return out;
}

Style ShapeLine(const std::string& colour, double width) {
  Style s;
  s.color = colour;
  s.width = width;
  s.legend = false;
  return s;
}

/// A trace that keeps its gaps: no decimation.
void AddSpaceLine(Figure& f, int panel, const std::string& name, const Points& p,
                  const Style& style) {
  AddLine(f, panel, name, std::vector<double>{0, 0}, std::vector<double>{0, 0}, style);
  f.traces.back()["x"] = Numbers(p.x, 4);
  f.traces.back()["y"] = Numbers(p.y, 4);
  f.traces.back()["hoverinfo"] = "skip";
}

/// Numbers without titles: the axes of the page are none of the shaft.
void HideAxes(Figure& f, int panel) {
  SetAxes(f, panel, "", "", std::array<double, 2>{-0.6, kShapeWidth + 0.6},
          std::array<double, 2>{-1.4, 1.4});
  for (const char c : {'x', 'y'})
    f.layout[fmt::format("{}axis{}", c, panel == 0 ? "" : std::to_string(panel + 1))].update(
        {{"visible", false}, {"fixedrange", true}});
}

/// Buttons that turn the centre lines through the frames, and stop them.
void AddTurning(Figure& f, const std::vector<SpaceShape>& shapes, const std::vector<int>& moving) {
  nlohmann::json frames = nlohmann::json::array(), order = nlohmann::json::array();
  for (int k = 0; k < kShapeFrames; ++k) {
    nlohmann::json data = nlohmann::json::array();
    for (const SpaceShape& s : shapes) {
      const Points line = CentreLine(s, 2 * kPi * k / kShapeFrames);
      data.push_back({{"x", Numbers(line.x, 4)}, {"y", Numbers(line.y, 4)}});
    }
    frames.push_back({{"name", std::to_string(k)}, {"data", data}, {"traces", moving}});
  }
  for (int k = 0; k <= kShapeTurns * kShapeFrames; ++k)
    order.push_back(std::to_string(k % kShapeFrames));
  const nlohmann::json timing = {{"mode", "immediate"},
                                 {"frame", {{"duration", 60}, {"redraw", false}}},
                                 {"transition", {{"duration", 0}}}};
  const nlohmann::json buttons = {
      {{"label", "turn"}, {"method", "animate"}, {"args", {order, timing}}},
      {{"label", "stop"},
       {"method", "animate"},
       {"args", {nlohmann::json::array({nullptr}), timing}}}};
  f.layout["meta"] = {{"frames", frames}};
  const nlohmann::json menu = {{"type", "buttons"},   {"direction", "right"},
                               {"showactive", false}, {"x", 0},
                               {"xanchor", "left"},   {"y", 0},
                               {"yanchor", "top"},    {"pad", {{"t", 20}}},
                               {"bgcolor", "@paper"}, {"font", {{"color", "@ink"}}},
                               {"buttons", buttons}};
  f.layout["updatemenus"] = nlohmann::json::array({menu});
}

std::string ShapeColour(Whirl sense) {
  return sense == Whirl::kForward ? "@blue" : sense == Whirl::kBackward ? "@orange" : "@muted";
}

}  // namespace

Figure ShaftModesFigure(const ShaftAnalysis& a) {
  const ClosedLoopModes* row = &a.campbell.rows.front();
  for (const ClosedLoopModes& r : a.campbell.rows)
    if (std::abs(r.speed - a.options.highest) < std::abs(row->speed - a.options.highest)) row = &r;
  const std::size_t count = std::min(kShapesShown, row->modes.size());
  Grid grid;
  grid.columns = std::max(1, std::min(3, static_cast<int>(count)));
  grid.rows = std::max(1, (static_cast<int>(count) + grid.columns - 1) / grid.columns);
  grid.shared_x = false;
  grid.panel_height = 190;
  for (std::size_t k = 0; k < count; ++k)
    grid.titles.push_back(fmt::format("{:.1f} Hz, {}, δ {:.3f}", row->modes[k].frequency,
                                      SenseName(row->modes[k].sense()),
                                      row->modes[k].log_decrement));
  Figure f = MakeFigure(
      fmt::format("Shapes of the damped modes at {}, seen from the side: z to the right, y up, x "
                  "towards the reader. The thick line is the shaft's centre at one instant, the "
                  "ellipses are its orbits (decay left out), dots the supports. **turn** moves "
                  "the centre along its orbits; blue turns as the shaft does, orange against it.",
                  Rpm(row->speed)),
      grid);
  std::vector<SpaceShape> shapes;
  std::vector<int> moving;
  for (std::size_t k = 0; k < count; ++k) {
    const int panel = static_cast<int>(k);
    const SpaceShape s = ShapeInSpace(a.beam, row->modes[k]);
    HideAxes(f, panel);
    AddSpaceLine(f, panel, "axis", {{0, kShapeWidth}, {0, 0}}, ShapeLine("@faint", 1));
    AddSpaceLine(f, panel, "orbits", OrbitsInSpace(s), ShapeLine("@muted", 0.8));
    moving.push_back(static_cast<int>(f.traces.size()));
    AddSpaceLine(f, panel, "centre", CentreLine(s, 0),
                 ShapeLine(ShapeColour(row->modes[k].sense()), 3));
    Points supports;
    for (const SpringSupport& p : a.beam.supports) {
      if (!p.on_shaft()) continue;
      const auto [lo, hi] = std::minmax_element(a.beam.z.begin(), a.beam.z.end());
      supports.x.push_back(kShapeWidth * (p.z - *lo) / std::max(*hi - *lo, 1e-12));
      supports.y.push_back(0);
    }
    Style dots = ShapeLine("@ink", 1);
    dots.markers = true;
    if (!supports.x.empty()) AddSpaceLine(f, panel, "supports", supports, dots);
    shapes.push_back(s);
  }
  if (count > 0) AddTurning(f, shapes, moving);
  return f;
}

}  // namespace ambrig
