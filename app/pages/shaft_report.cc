#include "app/pages/shaft_report.h"

#include <fmt/format.h>

#include "app/figures/rotor_figures.h"
#include "app/figures/shaft_figures.h"
#include "app/json/analysis_json.h"
#include "app/pages/html.h"
#include "app/text/format.h"
#include "core/base/counted.h"
#include "core/math/constants.h"

namespace ambrig {

namespace {

void AddShaftVerdict(HtmlReport& report, const ShaftAnalysis& a) {
  report.Heading("Verdict");
  if (a.campbell.stable())
    report.Verdict(Verdict::kOk,
                   fmt::format("**Stable up to {:.0f} rpm.**", a.options.fastest / kRpm));
  else
    report.Verdict(Verdict::kFail,
                   fmt::format("**A motion does not decay** at some speed up to {:.0f} rpm.",
                               a.options.fastest / kRpm));
  for (const std::string& note : a.notes) report.Text("- " + note);
  report.KeyValues(
      {{"mass", fmt::format("{:.6g} kg", a.totals.mass)},
       {"centre of mass", fmt::format("z = {:.6g} m", a.totals.z_com)},
       {"transverse inertia", fmt::format("{:.6g} kg m²", a.totals.inertia_transverse)},
       {"polar inertia", fmt::format("{:.6g} kg m²", a.totals.inertia_polar)},
       {"nodes", std::to_string(a.beam.z.size())}});
  report.AddFigure(ShaftFigure(a));
}

void AddDampedModes(HtmlReport& report, const ShaftAnalysis& a) {
  report.Heading("Damped modes");
  std::vector<std::vector<Cell>> rows;
  for (const ClosedLoopModes& r : a.campbell.rows) {
    if (r.speed != 0 && r.speed != a.options.lowest && r.speed != a.options.highest) continue;
    for (const ClosedLoopMode& m : r.modes)
      rows.push_back(
          {fmt::format("{:.0f}", r.speed / kRpm), fmt::format("{:.4f}", m.frequency),
           fmt::format("{:.5f}", m.zeta),
           Cell(fmt::format("{:.4f}", m.log_decrement), m.log_decrement < 0 ? "fail" : ""),
           SenseName(r, m)});
  }
  report.Table(
      {"speed [rpm]", "frequency [Hz]", "damping ratio", "log decrement", "whirl"}, rows,
      "Poles without a frequency have no log decrement and are not listed. Whirl either: two "
      "modes of one pole at rest.");
  report.AddFigure(CampbellFigure(
      a.campbell.tracks, a.campbell.criticals, a.options.fastest,
      "Campbell diagram: damped modes of the whole beam on its supports, coefficients as they are "
      "at each speed. Blue turns forward, orange backward, grey neither; a critical speed is where "
      "a line meets 1X. Below: the log decrement of the same modes."));
  report.AddFigure(ShaftModesFigure(a));
}

void AddCriticals(HtmlReport& report, const ShaftAnalysis& a) {
  report.Heading("Critical speeds");
  std::vector<std::vector<Cell>> rows;
  for (const DampedCritical& c : a.campbell.criticals)
    rows.push_back({fmt::format("{:.2f}", c.speed / kRpm), SenseName(c.mode.sense()),
                    fmt::format("{:.4f}", c.mode.log_decrement)});
  report.Table({"damped [rpm]", "whirl", "log decrement"}, rows);
  rows.clear();
  for (const CriticalSpeed& c : a.undamped)
    rows.push_back({fmt::format("{:.2f}", c.speed / kRpm), c.whirl > 0 ? "forward" : "backward"});
  report.Table({"undamped [rpm]", "whirl"}, rows,
               "Stiffnesses of the supports as at the highest operating speed, their symmetric "
               "part.");
  if (a.map.empty()) return;
  std::vector<std::pair<std::string, double>> lines;
  for (const SpringSupport& s : a.beam.supports) {
    if (!s.on_shaft() || s.between_shafts()) continue;
    const SupportCoefficients c = s.At(a.options.highest);
    const std::string name = s.name.empty() ? fmt::format("z = {:g} m", s.z) : s.name;
    lines.emplace_back(name + " kxx", c.kxx);
    if (c.kyy != c.kxx) lines.emplace_back(name + " kyy", c.kyy);
  }
  report.AddFigure(CriticalMapFigure(
      a.map, lines,
      "Undamped critical speed map: the whole beam with every support of the shaft at one "
      "stiffness; housings and what joins shafts stay as they are. Vertical lines: the file's "
      "supports at the highest "
      "operating speed."));
}

void AddResponses(HtmlReport& report, const ShaftAnalysis& a) {
  if (a.unbalance.empty()) return;
  report.Heading("Unbalance");
  std::vector<std::vector<Cell>> rows;
  for (const ShaftSweep& s : a.unbalance)
    for (const ProbeOrbit& p : s.probes)
      for (const ResponsePeak& k : p.peaks)
        rows.push_back({s.unbalance.name, p.probe.name, fmt::format("{:.1f}", k.speed / kRpm),
                        FormatSi(k.amplitude, "m"),
                        fmt::format("{}{:.2f}", k.bound ? "< " : "", k.amplification)});
  report.Table({"unbalance", "at", "peak [rpm]", "long half axis", "AF"}, rows,
               "AF is the peak's speed over the width at 0.707 of it; AF < x: a half-power point "
               "lies beyond the sweep or another peak.");
  for (const ShaftSweep& s : a.unbalance) {
    report.AddFigure(ShaftResponseFigure(a, s));
    report.AddFigure(ShaftOrbitFigure(a, s));
  }
}

void AddWeight(HtmlReport& report, const ShaftAnalysis& a) {
  if (!a.weight.held) return;
  report.Heading("Under its weight");
  std::vector<std::vector<Cell>> rows;
  for (const SupportReaction& r : a.weight.reactions)
    rows.push_back({r.name.empty() ? "-" : r.name,
                    std::isfinite(r.z) ? fmt::format("{:.6g}", r.z) : "housing",
                    FormatSi(r.fy, "N"), FormatSi(r.fx, "N")});
  report.Table({"support", "z [m]", "holds in y", "in x"}, rows);
  report.AddFigure(WeightFigure(a));
}

void AddExtras(HtmlReport& report, const ShaftAnalysis& a) {
  report.Heading("Axial and torsional modes");
  report.AddFigure(RodFigure(a));
  if (a.level1) {
    const Level1& l = *a.level1;
    report.Heading("Cross-coupled stiffness");
    report.Verdict(l.passed() ? Verdict::kOk : Verdict::kWarn,
                   fmt::format("**Q_0/Q_A = {:.3g}, log decrement {:.4f} at Q_A = {}**: level 1 of "
                               "API 684 (2nd ed., SP6.8.5.10) asks for at least 2 and 0.1.",
                               l.ratio(), l.at_expected, FormatSi(l.given.expected, "N/m")));
    if (l.found) report.AddFigure(CouplingFigure(l));
  }
}

void AddScatter(HtmlReport& report, const ShaftAnalysis& a) {
  if (!a.scatter) return;
  report.Heading("Scatter");
  std::vector<std::vector<Cell>> rows;
  for (const ScatteredMode& m : a.scatter->modes)
    rows.push_back(
        {fmt::format("{:.3f}", m.nominal_frequency), fmt::format("{:.3f}", m.frequency.low),
         fmt::format("{:.3f}", m.frequency.middle), fmt::format("{:.3f}", m.frequency.high),
         fmt::format("{:.4f}", m.decrement.low), fmt::format("{:.4f}", m.decrement.middle),
         fmt::format("{:.4f}", m.decrement.high)});
  report.Table(
      {"file [Hz]", "5 %", "50 %", "95 %", "log dec 5 %", "50 %", "95 %"}, rows,
      fmt::format("Quantiles over {}, drawn from {} with an sd, at {:.0f} rpm.",
                  Counted(a.scatter->rotors, "rotor"),
                  Counted(a.scatter->parameters.size(), "number"), a.scatter->speed / kRpm));
  rows.clear();
  for (const ScatteredCritical& c : a.scatter->criticals)
    rows.push_back({fmt::format("{:.1f}", c.nominal.speed / kRpm),
                    SenseName(c.nominal.mode.sense()), fmt::format("{:.1f}", c.speed.low / kRpm),
                    fmt::format("{:.1f}", c.speed.middle / kRpm),
                    fmt::format("{:.1f}", c.speed.high / kRpm),
                    fmt::format("{:.4f}", c.decrement.low), fmt::format("{:.4f}", c.decrement.high),
                    fmt::format("{:.1f} %", 100.0 * c.found / a.scatter->rotors)});
  report.Table({"critical speed of the file [rpm]", "whirl", "5 %", "50 %", "95 %", "log dec 5 %",
                "95 %", "rotors that have it"},
               rows);
  for (std::size_t k = 0; k < a.unbalance.size(); ++k)
    report.AddFigure(ScatterFigure(a, a.unbalance[k].unbalance.name));
}

}  // namespace

void WriteShaftReport(const ShaftAnalysis& a, const std::string& file,
                      const std::filesystem::path& path) {
  HtmlReport report(
      "Analysis of " + a.name,
      fmt::format("shaft {}, operating {}", file, SpeedRange(a.options.lowest, a.options.highest)));
  AddShaftVerdict(report, a);
  AddDampedModes(report, a);
  if (a.options.campbell_alone) {
    report.Write(path);
    return;
  }
  AddCriticals(report, a);
  AddResponses(report, a);
  if (a.harmonic) {
    report.Heading("Harmonic load");
    report.AddFigure(HarmonicFigure(*a.harmonic));
  }
  AddWeight(report, a);
  AddExtras(report, a);
  AddScatter(report, a);
  report.Write(path);
}

}  // namespace ambrig
