#include "app/figures/rotor_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/figures/series.h"
#include "app/json/analysis_json.h"
#include "app/text/format.h"
#include "core/base/counted.h"
#include "core/base/parameters.h"
#include "core/math/constants.h"
#include "rig/parameters/bearing_kind.h"

namespace ambrig {
namespace {

const char* WhirlColour(Whirl w) {
  return w == Whirl::kForward ? "@blue" : w == Whirl::kBackward ? "@orange" : "@muted";
}

Style PlainLine(const std::string& colour, const std::string& dash = "solid") {
  Style s;
  s.color = colour;
  s.dash = dash;
  return s;
}

/// On the axis of the rig file, whose z is a beam's own; the model's counts from the centre of
/// mass.
std::vector<double> OnFileAxis(const RigAnalysis& a, std::vector<double> z) {
  for (double& v : z) v += a.point.rig().z_origin;
  return z;
}

bool Oscillates(const ModeTrack& t) { return t.of_rotor() && t.modes.front().zeta <= 0.97; }

/// Upper end of the frequency axis [Hz]: 1X and the modes that it may meet or that lie a few times
/// above, not those so far away that what matters would lie at the bottom.
double CampbellTop(const std::vector<ModeTrack>& tracks, double fastest) {
  const double end_1x = fastest / (2 * kPi);
  double lowest = kInfinity;
  for (const ModeTrack& t : tracks)
    if (Oscillates(t)) lowest = std::min(lowest, t.modes.front().frequency);
  const double far = 4 * std::max(end_1x, std::isfinite(lowest) ? lowest : 0.0);
  double top = 1.3 * end_1x;
  for (const ModeTrack& t : tracks)
    if (Oscillates(t) && t.modes.back().frequency < far)
      top = std::max(top, 1.15 * t.modes.back().frequency);
  return top;
}

/// Modes that the axis leaves out, for the caption.
std::string HiddenModes(const std::vector<ModeTrack>& tracks, double top) {
  std::size_t hidden = 0;
  double lowest = kInfinity;
  for (const ModeTrack& t : tracks)
    if (Oscillates(t) && t.modes.front().frequency > top && t.modes.back().frequency > top) {
      ++hidden;
      lowest = std::min(lowest, t.modes.front().frequency);
    }
  if (hidden == 0) return "";
  return fmt::format(" {} above this axis (from {} on): zoom out to see them.",
                     Counted(hidden, "mode") + (hidden == 1 ? " lies" : " lie"),
                     FormatSi(lowest, "Hz"));
}

}  // namespace

Figure CampbellFigure(const std::vector<ModeTrack>& tracks,
                      const std::vector<DampedCritical>& criticals, double fastest,
                      const std::string& caption) {
  Grid grid;
  grid.rows = 2;
  grid.panel_height = 300;
  grid.titles = {"damped natural frequency", "logarithmic decrement"};
  const double top = CampbellTop(tracks, fastest);
  Figure f = MakeFigure(caption + HiddenModes(tracks, top), grid);
  SetAxes(f, 0, "speed [rpm]", "frequency [Hz]", {}, std::array<double, 2>{0, top});
  SetAxes(f, 1, "speed [rpm]", "log decrement [-]");
  bool named[3] = {false, false, false};
  for (const ModeTrack& t : tracks) {
    if (!Oscillates(t)) continue;
    std::vector<double> hz, dec;
    for (const ClosedLoopMode& m : t.modes) {
      hz.push_back(m.frequency);
      dec.push_back(m.log_decrement);
    }
    Style style = PlainLine(WhirlColour(t.sense()));
    bool& known = named[static_cast<int>(t.sense())];
    style.legend = !known;
    known = true;
    const std::vector<double> rpm = Scaled(t.speed, 1 / kRpm);
    AddLine(f, 0, SenseName(t.sense()), rpm, hz, style);
    style.legend = false;
    AddLine(f, 1, SenseName(t.sense()), rpm, dec, style);
  }
  const double end = fastest;
  AddLine(f, 0, "1X", std::vector<double>{0, end / kRpm}, std::vector<double>{0, end / (2 * kPi)},
          PlainLine("@ink", "dash"));
  std::vector<double> x, y;
  for (const DampedCritical& c : criticals) {
    if (!c.IsResonance()) continue;
    x.push_back(c.speed / kRpm);
    y.push_back(c.speed / (2 * kPi));
  }
  Style dots = PlainLine("@red");
  dots.markers = true;
  dots.size = 8;
  if (!x.empty()) AddLine(f, 0, "critical speed", x, y, dots);
  AddLevel(f, 1, 0.1, "API 617: 0.1", "@red");
  return f;
}

Figure CampbellFigure(const RigAnalysis& a) {
  return CampbellFigure(a.tracks, a.criticals, a.options.fastest,
                        "Campbell diagram of the closed loop: rotor modes with magnets, current "
                        "loops, controller and delays. Blue turns forward, orange backward, grey "
                        "neither; a critical speed is where a line meets 1X. Below: the log "
                        "decrement of the same modes; API 617 asks for more than 0.1 of the first "
                        "forward mode.");
}

Figure ModeShapeFigure(const RigAnalysis& a) {
  const ClosedLoopModes* row = &a.rows.front();
  for (const ClosedLoopModes& r : a.rows)
    if (std::abs(r.speed - a.options.highest) < std::abs(row->speed - a.options.highest)) row = &r;
  std::vector<const ClosedLoopMode*> modes;
  for (const ClosedLoopMode& m : row->modes)
    if (m.of_rotor() && m.lateral && m.zeta < 0.97 && modes.size() < 6) modes.push_back(&m);
  Grid grid;
  grid.columns = std::max<int>(1, std::min<int>(3, static_cast<int>(modes.size())));
  grid.rows = std::max<int>(1, (static_cast<int>(modes.size()) + grid.columns - 1) / grid.columns);
  grid.shared_x = false;
  grid.panel_height = 180;
  for (const ClosedLoopMode* m : modes)
    grid.titles.push_back(fmt::format("{:.1f} Hz, {}, δ {:.2f}", m->frequency,
                                      SenseName(m->sense()), m->log_decrement));
  Figure f = MakeFigure(fmt::format("Shapes of the rotor modes at {}: shaft centre over the axis "
                                    "z, x (solid) at the instant of its largest "
                                    "deflection, y (dashed) a quarter turn later. z as in the rig "
                                    "file; dots are the bearings.",
                                    Rpm(row->speed)),
                        grid);
  const std::vector<double> z = ShaftStations(a.point);
  const std::vector<double> shown = OnFileAxis(a, z);
  const LinearPlant plant = LinearisePlant(a.point, row->speed);
  for (std::size_t k = 0; k < modes.size(); ++k) {
    Eigen::MatrixXcd d(2, static_cast<Eigen::Index>(z.size()));
    for (std::size_t i = 0; i < z.size(); ++i)
      d.col(static_cast<Eigen::Index>(i)) =
          ShaftRows(a.point, plant, z[i]).cast<std::complex<double>>() * modes[k]->q;
    Eigen::Index r, c;
    d.cwiseAbs().maxCoeff(&r, &c);
    d /= d(r, c) * (r == 0 ? 1.0 : std::complex<double>(0, 1));
    std::vector<double> x, y;
    for (Eigen::Index i = 0; i < d.cols(); ++i) {
      x.push_back(d(0, i).real());
      y.push_back(-d(1, i).imag());
    }
    const int panel = static_cast<int>(k);
    SetAxes(f, panel, "z [m]", "", {}, std::array<double, 2>{-1.15, 1.15});
    Style style = PlainLine(WhirlColour(modes[k]->sense()));
    style.legend = false;
    AddLine(f, panel, "x", shown, x, style);
    style.dash = "dash";
    AddLine(f, panel, "y", shown, y, style);
    std::vector<double> at, zero;
    for (const BearingParameters& b : a.point.rig().bearings)
      if (b.kind->two_axes) {
        at.push_back(b.z + a.point.rig().z_origin);
        zero.push_back(0);
      }
    Style dot = PlainLine("@ink");
    dot.markers = true;
    dot.legend = false;
    AddLine(f, panel, "bearings", at, zero, dot);
  }
  return f;
}

Figure RotorModeFigure(const RigAnalysis& a) {
  const bool bends = !a.supports.free.empty();
  Grid grid;
  grid.columns = bends ? 2 : 1;
  grid.shared_x = false;
  grid.titles = {"on springs k_p - k_s"};
  if (bends) grid.titles.insert(grid.titles.begin(), "free");
  Figure f = MakeFigure(
      bends ? "Undamped modes of the rotor alone at rest: free, and on springs that stand for the "
              "bearings."
            : "Undamped modes of the rigid rotor at rest on springs that stand for the bearings.",
      grid);
  int panel = 0, k = 0;
  for (const auto* modes : {&a.supports.free, &a.supports.supported}) {
    if (modes->empty()) continue;
    SetAxes(f, panel, "z [m]", "", {}, std::array<double, 2>{-1.15, 1.15});
    for (const RotorMode& m : *modes)
      AddLine(f, panel, fmt::format("{:.1f} Hz", m.frequency), OnFileAxis(a, m.z), m.x,
              SeriesStyle(k++));
    ++panel;
  }
  return f;
}

Figure CriticalMapFigure(const std::vector<CriticalMapRow>& map,
                         const std::vector<std::pair<std::string, double>>& lines,
                         const std::string& caption) {
  Figure f = MakeFigure(caption);
  f.height = 420;
  SetAxes(f, 0, "stiffness of every radial bearing [N/m]", "critical speed [rpm]");
  LogAxes(f, 0, true, true);
  std::size_t count = 0;
  for (const CriticalMapRow& row : map) count = std::max(count, row.speeds.size());
  for (std::size_t n = 0; n < count; ++n) {
    std::vector<double> x, y;
    bool forward = true;
    for (const CriticalMapRow& row : map)
      if (n < row.speeds.size()) {
        x.push_back(row.stiffness);
        y.push_back(row.speeds[n].speed / kRpm);
        forward = row.speeds[n].whirl > 0;
      }
    AddLine(f, 0, fmt::format("{} {}", n + 1, forward ? "forward" : "backward"), x, y,
            PlainLine(forward ? "@blue" : "@orange"));
  }
  double low = 1e300, high = 0;
  for (const CriticalMapRow& row : map)
    for (const CriticalSpeed& c : row.speeds) {
      low = std::min(low, c.speed / kRpm);
      high = std::max(high, c.speed / kRpm);
    }
  for (const auto& [name, stiffness] : lines)
    if (stiffness > 0 && high > 0)
      AddLine(f, 0, name, std::vector<double>{stiffness, stiffness}, std::vector<double>{low, high},
              PlainLine("@muted", "dot"));
  return f;
}

Figure CriticalMapFigure(const RigAnalysis& a) {
  std::vector<std::pair<std::string, double>> lines;
  for (const SupportStiffness& s : a.supports.supports) lines.emplace_back(s.bearing, s.net());
  return CriticalMapFigure(
      a.supports.map, lines,
      "Undamped critical speed map: critical speeds of the rotor on bearings "
      "of one common stiffness. Vertical lines: the net static stiffness k_p - "
      "k_s of this rig's bearings.");
}

void MarkOperatingSpeeds(Figure& figure, double lowest, double highest, double fastest) {
  const double low = lowest / kRpm, high = highest / kRpm;
  if (high > low) {
    AddRegion(figure, 0, low, high, "operating", "@green/12");
    figure.caption += " The shaded speeds are the operating range.";
  } else if (high > 0) {
    const Mark mark{high, "operating", "@green"};
    AddMarks(figure, {&mark, 1}, {0, fastest / kRpm});
    figure.caption += " The vertical line is the operating speed.";
  }
}

Figure UnbalanceFigure(const RigAnalysis& a, const UnbalanceSweep& sweep) {
  Grid grid;
  grid.rows = 3;
  grid.panel_height = 200;
  grid.titles = {"orbit at the sensors, long half axis", "phase of x against the unbalance",
                 "force of the magnets"};
  std::string planes;
  for (const PlaneUnbalance& p : sweep.unbalance.planes)
    planes += fmt::format("{}{:.3g} g mm at z = {:.3g} m{}", planes.empty() ? "" : ", ",
                          p.magnitude * 1e6, p.z + a.point.rig().z_origin,
                          p.phase > 1 ? " opposite" : "");
  Figure f =
      MakeFigure(fmt::format("Unbalance, case **{}**: {}.", sweep.unbalance.name, planes), grid);
  SetAxes(f, 0, "speed [rpm]", "[µm]");
  SetAxes(f, 1, "speed [rpm]", "[deg]");
  SetAxes(f, 2, "speed [rpm]", "[N]");
  const std::vector<double> rpm = Scaled(sweep.speed, 1 / kRpm);
  for (std::size_t k = 0; k < sweep.tracks.size(); ++k) {
    const OrderTrack& t = sweep.tracks[k];
    Style style = SeriesStyle(static_cast<int>(k));
    AddLine(f, 0, t.bearing, rpm, Scaled(t.amplitude, 1e6), style);
    style.legend = false;
    AddLine(f, 1, t.bearing, rpm, Scaled(t.phase, 180 / kPi), style);
    AddLine(f, 2, t.bearing, rpm, t.force, style);
  }
  MarkOperatingSpeeds(f, a.options.lowest, a.options.highest, sweep.speed.back());
  return f;
}

}  // namespace ambrig
