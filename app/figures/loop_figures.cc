#include "app/figures/loop_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/text/format.h"
#include "core/math/constants.h"

namespace ambrig {
namespace {

std::vector<double> Magnitude(const std::vector<std::complex<double>>& z) {
  std::vector<double> out;
  for (const auto& v : z) out.push_back(std::abs(v));
  return out;
}

/// Degrees without jumps.
std::vector<double> Phase(const std::vector<std::complex<double>>& z) {
  std::vector<double> out;
  double turn = 0, last = 0;
  for (const auto& v : z) {
    double p = std::arg(v) * 180 / kPi;
    if (!out.empty()) {
      if (p - last > 180) turn -= 360;
      if (p - last < -180) turn += 360;
    }
    last = p;
    out.push_back(p + turn);
  }
  return out;
}

}  // namespace

Figure SensitivityFigure(const RigAnalysis& a) {
  Grid grid;
  grid.rows = static_cast<int>(a.sensitivity.size());
  grid.panel_height = 260;
  for (const Sensitivity& s : a.sensitivity)
    grid.titles.push_back(s.speed == 0 ? "at rest" : "at " + Rpm(s.speed));
  Figure f = MakeFigure(
      "Sensitivity |S| of every axis, all other loops closed. Below 3 (9.5 dB) zone A of ISO "
      "14839-3, below 4 zone B, below 5 "
      "zone C, above zone D. Points: a sine injected into the nonlinear switching rig.",
      grid);
  double top = 3.4;
  for (const Sensitivity& s : a.sensitivity)
    for (const AxisSensitivity& x : s.axes) top = std::max(top, 1.1 * x.peak);
  for (std::size_t p = 0; p < a.sensitivity.size(); ++p) {
    const Sensitivity& s = a.sensitivity[p];
    const int panel = static_cast<int>(p);
    SetAxes(f, panel, "frequency [Hz]", "|S| [-]", {}, std::array<double, 2>{0, top});
    LogAxes(f, panel, true, false);
    for (std::size_t k = 0; k < s.axes.size(); ++k) {
      Style style = SeriesStyle(static_cast<int>(k));
      style.legend = p == 0;
      AddLine(f, panel, s.axes[k].axis, s.frequency, Magnitude(s.axes[k].S), style);
      if (s.speed != 0) continue;
      std::vector<double> x, y;
      for (const MeasuredPoint& m : a.measured)
        if (m.axis == k) {
          x.push_back(m.frequency);
          y.push_back(std::abs(m.measured));
        }
      if (x.empty()) continue;
      style.markers = true;
      AddLine(f, panel, s.axes[k].axis + " measured", x, y, style);
    }
    AddLevel(f, panel, 3, "A/B", "@green");
    if (top > 4) AddLevel(f, panel, 4, "B/C", "@orange");
    if (top > 5) AddLevel(f, panel, 5, "C/D", "@red");
  }
  return f;
}

Figure NyquistFigure(const RigAnalysis& a) {
  Figure f = MakeFigure(
      "Return ratio L = 1/S - 1 of every axis at the highest operating speed, near the critical "
      "point -1. The circles round it are "
      "|S| = 3, 4 and 5: a curve outside the largest is in zone A. An AMB's loop is unstable when "
      "open and must go round -1.");
  f.height = 520;
  f.narrow = 620;
  SetAxes(f, 0, "Re L", "Im L", std::array<double, 2>{-3, 1.5}, std::array<double, 2>{-2.2, 2.2});
  EqualAspect(f, 0);
  const Sensitivity& s = a.sensitivity.back();
  for (std::size_t k = 0; k < s.axes.size(); ++k) {
    std::vector<double> re, im;
    for (const auto& v : s.axes[k].S) {
      const std::complex<double> L = 1.0 / v - 1.0;
      if (std::abs(L) > 6) continue;
      re.push_back(L.real());
      im.push_back(L.imag());
    }
    AddOrbit(f, 0, s.axes[k].axis, re, im, SeriesStyle(static_cast<int>(k)));
  }
  AddCircle(f, 0, -1, 0, 1.0 / 3, "@green");
  AddCircle(f, 0, -1, 0, 1.0 / 4, "@orange");
  AddCircle(f, 0, -1, 0, 1.0 / 5, "@red");
  return f;
}

Figure RootLocusFigure(const RigAnalysis& a) {
  Figure f = MakeFigure(
      "Poles of the closed loop over speed, as s = ln z / Ts (upper half). Blue: modes of the "
      "rotor; grey: current loops, filters, "
      "integrators. Large points: at rest.");
  f.height = 460;
  SetAxes(f, 0, "Re s [1/s]", "Im s / 2π [Hz]");
  std::vector<double> re[2], im[2], re0[2], im0[2];
  double reach = 1;
  for (const ClosedLoopModes& r : a.rows)
    for (const ClosedLoopMode& m : r.modes)
      if (m.of_rotor()) reach = std::max(reach, std::abs(m.s));
  for (const ClosedLoopModes& r : a.rows)
    for (const ClosedLoopMode& m : r.modes) {
      const int kind = m.of_rotor() ? 0 : 1;
      if (std::abs(m.s) > 1.5 * reach) continue;  // far left: the current loops
      (r.speed == 0 ? re0 : re)[kind].push_back(m.s.real());
      (r.speed == 0 ? im0 : im)[kind].push_back(m.frequency);
    }
  for (int kind : {1, 0}) {
    Style style;
    style.color = kind == 0 ? "@blue" : "@muted";
    style.markers = true;
    style.size = 3;
    AddLine(f, 0, kind == 0 ? "rotor" : "others", re[kind], im[kind], style);
    style.size = 8;
    AddLine(f, 0, kind == 0 ? "rotor, at rest" : "others, at rest", re0[kind], im0[kind], style);
  }
  return f;
}

Figure StiffnessFigure(const RigAnalysis& a) {
  Grid grid;
  grid.rows = 3;
  grid.panel_height = 220;
  grid.titles = {"bearing: stiffness k = Re K", "bearing: damping c = Im K / ω",
                 "levitated rotor: |force per displacement|"};
  Figure f = MakeFigure(
      "Dynamic stiffness of every axis. Above: the force that comes back when the shaft is moved, "
      "with negative stiffness, current "
      "loops, sampling and delay in it; where c < 0 the bearing feeds energy into the shaft. "
      "Below: force per displacement of the "
      "levitated rotor at the magnets; its minima are the resonances.",
      grid);
  SetAxes(f, 0, "frequency [Hz]", "[N/µm]");
  SetAxes(f, 1, "frequency [Hz]", "[N s/m]");
  SetAxes(f, 2, "frequency [Hz]", "[N/µm]");
  for (int p = 0; p < 3; ++p) LogAxes(f, p, true, p == 2);
  for (std::size_t k = 0; k < a.stiffness.axes.size(); ++k) {
    const AxisStiffness& s = a.stiffness.axes[k];
    std::vector<double> stiffness, damping, rotor;
    for (std::size_t i = 0; i < s.bearing.size(); ++i) {
      stiffness.push_back(s.bearing[i].real() * 1e-6);
      damping.push_back(s.bearing[i].imag() / (2 * kPi * a.stiffness.frequency[i]));
      rotor.push_back(std::abs(s.rotor[i]) * 1e-6);
    }
    Style style = SeriesStyle(static_cast<int>(k));
    AddLine(f, 0, s.axis, a.stiffness.frequency, stiffness, style);
    style.legend = false;
    AddLine(f, 1, s.axis, a.stiffness.frequency, damping, style);
    AddLine(f, 2, s.axis, a.stiffness.frequency, rotor, style);
  }
  return f;
}

Figure BodeFigure(const ResponseCurve& c) {
  Grid grid;
  grid.rows = 2;
  grid.panel_height = 220;
  Figure f =
      MakeFigure(fmt::format("Frequency response from {} to {}, at the highest operating speed.",
                             c.input, c.output),
                 grid);
  SetAxes(f, 0, "frequency [Hz]", fmt::format("[{}]", c.unit));
  SetAxes(f, 1, "frequency [Hz]", "phase [deg]");
  LogAxes(f, 0, true, true);
  LogAxes(f, 1, true, false);
  AddLine(f, 0, c.output, c.frequency, Magnitude(c.values), SeriesStyle(0));
  Style style = SeriesStyle(0);
  style.legend = false;
  AddLine(f, 1, c.output, c.frequency, Phase(c.values), style);
  return f;
}

}  // namespace ambrig
