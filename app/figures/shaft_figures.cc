#include "app/figures/shaft_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/figures/rotor_figures.h"
#include "app/figures/series.h"
#include "app/json/analysis_json.h"
#include "app/text/format.h"
#include "core/math/constants.h"

namespace ambrig {

namespace {

Style ShaftLine(const std::string& colour, bool legend = false) {
  Style s;
  s.color = colour;
  s.legend = legend;
  return s;
}

std::vector<double> MajorAxes(const std::vector<std::complex<double>>& x,
                              const std::vector<std::complex<double>>& y) {
  std::vector<double> out;
  for (std::size_t k = 0; k < x.size(); ++k) out.push_back(AxesOfOrbit(x[k], y[k]).major);
  return out;
}

/// Phase of x against the unbalance, without jumps of a turn.
std::vector<double> PhaseOf(const std::vector<std::complex<double>>& x) {
  std::vector<double> out;
  for (const auto& v : x) {
    double phase = std::arg(v);
    if (!out.empty()) phase -= 2 * kPi * std::round((phase - out.back()) / (2 * kPi));
    out.push_back(phase);
  }
  return Scaled(out, 180 / kPi);
}

void AddSupportMarks(Figure& f, int panel, const ShaftAnalysis& a) {
  std::vector<double> z, zero;
  for (const SpringSupport& s : a.beam.supports)
    if (s.on_shaft()) {
      z.push_back(s.z);
      zero.push_back(0);
    }
  Style dot = ShaftLine("@ink");
  dot.markers = true;
  if (!z.empty()) AddLine(f, panel, "supports", z, zero, dot);
}

/// The sweep's index of the largest peak, or of the speed nearest to the highest operating one.
std::size_t OrbitIndex(const ShaftAnalysis& a, const ShaftSweep& sweep) {
  double speed = a.options.highest, largest = 0;
  for (const ProbeOrbit& p : sweep.probes)
    for (const ResponsePeak& k : p.peaks)
      if (k.amplitude > largest) largest = k.amplitude, speed = k.speed;
  std::size_t best = 0;
  for (std::size_t k = 0; k < sweep.speed.size(); ++k)
    if (std::abs(sweep.speed[k] - speed) < std::abs(sweep.speed[best] - speed)) best = k;
  return best;
}

}  // namespace

Figure ShaftFigure(const ShaftAnalysis& a) {
  Figure f = MakeFigure(
      "The shaft as it is computed: nodes are where outlines change. Green lines are disks (height "
      "by the cube root of the mass), dots are supports.");
  f.height = 300;
  SetAxes(f, 0, "z [m]", "radius [mm]");
  for (const ShaftElement& e : a.beam.elements)
    for (const ShaftSection& l : e.layers) {
      const double z[2] = {e.z0, e.z0 + e.length};
      const std::string colour = l.stiff ? "@blue" : "@muted";
      for (const double side : {500.0, -500.0}) {
        AddLine(f, 0, "outline", {{z[0], z[0], z[1], z[1]}},
                {{side * l.id, side * l.od, side * l.od_right, side * l.id_right}},
                ShaftLine(colour));
      }
    }
  double radius = 0, mass = 0;
  for (const ShaftElement& e : a.beam.elements)
    for (const ShaftSection& l : e.layers) radius = std::max({radius, l.od / 2, l.od_right / 2});
  for (const Disk& d : a.beam.disks) mass = std::max(mass, d.mass);
  for (const Disk& d : a.beam.disks) {
    const double height = 1e3 * radius * (1 + 2 * std::cbrt(d.mass / mass));
    Style style = ShaftLine("@green");
    style.width = 4;
    AddLine(f, 0, d.name.empty() ? "disk" : d.name, std::vector<double>{d.z, d.z},
            std::vector<double>{-height, height}, style);
  }
  AddSupportMarks(f, 0, a);
  return f;
}

Figure WeightFigure(const ShaftAnalysis& a) {
  Grid grid;
  grid.rows = 3;
  grid.titles = {"deflection", "shear", "bending moment"};
  Figure f = MakeFigure(
      "The shaft under its own weight along -y, supports as at the highest operating speed. Shear "
      "is the sum of the upward forces to the left, the moment its integral.",
      grid);
  SetAxes(f, 0, "z [m]", "[µm]");
  SetAxes(f, 1, "z [m]", "[N]");
  SetAxes(f, 2, "z [m]", "[N m]");
  AddLine(f, 0, "y", a.weight.z, Scaled(a.weight.y, 1e6), ShaftLine("@blue", true));
  AddLine(f, 0, "x", a.weight.z, Scaled(a.weight.x, 1e6), ShaftLine("@orange", true));
  AddLine(f, 1, "shear", a.weight.at, a.weight.shear, ShaftLine("@blue"));
  AddLine(f, 2, "moment", a.weight.at, a.weight.moment, ShaftLine("@blue"));
  return f;
}

Figure RodFigure(const ShaftAnalysis& a) {
  Grid grid;
  grid.columns = 2;
  grid.shared_x = false;
  grid.titles = {"axial", "torsional"};
  Figure f = MakeFigure("Axial and torsional modes: displacement, rotation along the shaft.", grid);
  int panel = 0;
  for (const auto* modes : {&a.axial, &a.torsional}) {
    SetAxes(f, panel, "z [m]", "", {}, std::array<double, 2>{-1.15, 1.15});
    for (std::size_t k = 0; k < modes->size() && k < 4; ++k)
      AddLine(f, panel, fmt::format("{:.1f} Hz", (*modes)[k].omega / (2 * kPi)), a.beam.z,
              (*modes)[k].shape, SeriesStyle(static_cast<int>(k) + 4 * panel));
    ++panel;
  }
  return f;
}

Figure ShaftResponseFigure(const ShaftAnalysis& a, const ShaftSweep& sweep) {
  Grid grid;
  grid.rows = 3;
  grid.panel_height = 200;
  grid.titles = {"orbit, long half axis", "phase of x against the unbalance",
                 "force of the supports, long half axis"};
  std::string planes;
  for (const PlaneUnbalance& p : sweep.unbalance.planes)
    planes += fmt::format("{}{:.4g} g mm at z = {:.4g} m, {:.0f}°", planes.empty() ? "" : "; ",
                          p.magnitude * 1e6, p.z, p.phase * 180 / kPi);
  Figure f =
      MakeFigure(fmt::format("Unbalance, case **{}**: {}.", sweep.unbalance.name, planes), grid);
  SetAxes(f, 0, "speed [rpm]", "[µm]");
  SetAxes(f, 1, "speed [rpm]", "[deg]");
  SetAxes(f, 2, "speed [rpm]", "[N]");
  const std::vector<double> rpm = Scaled(sweep.speed, 1 / kRpm);
  for (std::size_t k = 0; k < sweep.probes.size(); ++k) {
    const ProbeOrbit& p = sweep.probes[k];
    Style style = SeriesStyle(static_cast<int>(k));
    AddLine(f, 0, p.probe.name, rpm, Scaled(MajorAxes(p.x, p.y), 1e6), style);
    style.legend = false;
    AddLine(f, 1, p.probe.name, rpm, PhaseOf(p.x), style);
  }
  for (std::size_t k = 0; k < sweep.forces.size(); ++k)
    AddLine(f, 2, "force " + sweep.forces[k].support, rpm,
            MajorAxes(sweep.forces[k].x, sweep.forces[k].y), SeriesStyle(static_cast<int>(k)));
  MarkOperatingSpeeds(f, a.options.lowest, a.options.highest, sweep.speed.back());
  return f;
}

Figure ShaftOrbitFigure(const ShaftAnalysis& a, const ShaftSweep& sweep) {
  const std::size_t at = OrbitIndex(a, sweep);
  Figure f =
      MakeFigure(fmt::format("Orbits of the shaft centre at {}, case **{}**; the dot is where "
                             "the shaft is when the unbalance's reference points along x.",
                             Rpm(sweep.speed[at]), sweep.unbalance.name));
  f.narrow = 560;
  f.height = 460;
  SetAxes(f, 0, "x [µm]", "y [µm]");
  EqualAspect(f, 0);
  for (std::size_t p = 0; p < sweep.probes.size(); ++p) {
    std::vector<double> x, y;
    for (int k = 0; k <= 180; ++k) {
      const std::complex<double> turn = std::polar(1e6, 2 * kPi * k / 180);
      x.push_back((sweep.probes[p].x[at] * turn).real());
      y.push_back((sweep.probes[p].y[at] * turn).real());
    }
    Style style = SeriesStyle(static_cast<int>(p));
    AddOrbit(f, 0, sweep.probes[p].probe.name, x, y, style);
    style.legend = false;
    style.markers = true;
    AddLine(f, 0, sweep.probes[p].probe.name, std::vector<double>{x[0]}, std::vector<double>{y[0]},
            style);
  }
  return f;
}

Figure ScatterFigure(const ShaftAnalysis& a, const std::string& unbalance) {
  constexpr std::size_t kMost = 4;  // probes
  std::vector<const ScatteredResponse*> shown;
  for (const ScatteredResponse& r : a.scatter->responses)
    if (r.unbalance == unbalance && shown.size() < kMost) shown.push_back(&r);
  Grid grid;
  grid.rows = static_cast<int>(shown.size());
  grid.panel_height = 180;
  for (const ScatteredResponse* r : shown) grid.titles.push_back(r->probe);
  Figure f = MakeFigure(
      fmt::format(
          "Unbalance, case **{}**, over {} rotors: nine of ten lie within the band, half of "
          "them below its middle line; blue is the rotor as it stands in the file. Long "
          "half axis of the orbit{}.",
          unbalance, a.scatter->rotors,
          shown.size() < kMost ? "" : ", the first four planes (all in the JSON)"),
      grid);
  const std::vector<double> rpm = Scaled(a.scatter->speeds, 1 / kRpm);
  for (std::size_t p = 0; p < shown.size(); ++p) {
    std::vector<double> low, middle, high;
    for (const ScatterBand& b : shown[p]->amplitude) {
      low.push_back(1e6 * b.low);
      middle.push_back(1e6 * b.middle);
      high.push_back(1e6 * b.high);
    }
    const int panel = static_cast<int>(p);
    SetAxes(f, panel, "speed [rpm]", "[µm]");
    AddBand(f, panel, "5 to 95 %", rpm, low, high, "@orange");
    if (p > 0) f.traces.back()["showlegend"] = false;
    AddLine(f, panel, "50 %", rpm, middle, ShaftLine("@orange", p == 0));
    AddLine(f, panel, "file", rpm, Scaled(shown[p]->nominal, 1e6), ShaftLine("@blue", p == 0));
  }
  return f;
}

Figure HarmonicFigure(const HarmonicSweep& sweep) {
  Grid grid;
  grid.rows = 2;
  grid.panel_height = 220;
  grid.titles = {"orbit, long half axis", "phase of x against the load"};
  Figure f = MakeFigure(
      fmt::format("Response to the harmonic load over its frequency, the shaft at {}, supports as "
                  "they are at that speed.",
                  Rpm(sweep.speed)),
      grid);
  SetAxes(f, 0, "frequency [Hz]", "[µm]");
  SetAxes(f, 1, "frequency [Hz]", "[deg]");
  const std::vector<double> hz = Scaled(sweep.frequency, 1 / (2 * kPi));
  for (std::size_t k = 0; k < sweep.probes.size(); ++k) {
    const ProbeOrbit& p = sweep.probes[k];
    Style style = SeriesStyle(static_cast<int>(k));
    AddLine(f, 0, p.probe.name, hz, Scaled(MajorAxes(p.x, p.y), 1e6), style);
    style.legend = false;
    AddLine(f, 1, p.probe.name, hz, PhaseOf(p.x), style);
  }
  return f;
}

Figure CouplingFigure(const Level1& l) {
  Figure f = MakeFigure(
      fmt::format("Log decrement of the first forward mode over the cross-coupled stiffness at z = "
                  "{:.4g} m, {}.",
                  l.given.z, Rpm(l.speed)));
  SetAxes(f, 0, "cross-coupled stiffness [N/m]", "log decrement [-]");
  AddLine(f, 0, "log decrement", l.q, l.log_decrement, ShaftLine("@blue"));
  AddLevel(f, 0, 0.1, "0.1", "@red");
  return f;
}

}  // namespace ambrig
