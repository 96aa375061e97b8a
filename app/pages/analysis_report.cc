// The report of `ambrig analyze`: verdict, margins, rotor dynamics, standards.
#include "app/pages/analysis_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/figures/loop_figures.h"
#include "app/figures/rotor_figures.h"
#include "app/json/analysis_json.h"
#include "app/pages/html.h"
#include "app/text/format.h"
#include "core/math/constants.h"

namespace ambrig {
namespace {

Cell ZoneCell(char zone) {
  return {std::string(1, zone), zone == 'A' ? "ok" : zone == 'B' ? "warn" : "fail"};
}
std::string Factor(double x) { return std::isfinite(x) ? fmt::format("{:.3f}", x) : "∞"; }

void AddAnalysisVerdict(HtmlReport& report, const RigAnalysis& a) {
  char worst = 'A';
  double peak = 0;
  for (const Sensitivity& s : a.sensitivity)
    for (const AxisSensitivity& x : s.axes) {
      worst = std::max(worst, x.zone);
      peak = std::max(peak, x.peak);
    }
  if (!a.stable()) {
    report.Verdict(Verdict::kFail, "**The closed loop is unstable** at some speed up to " +
                                       fmt::format("{:.0f} rpm.", a.options.fastest / kRpm));
    return;
  }
  report.Verdict(
      worst == 'A'   ? Verdict::kOk
      : worst == 'B' ? Verdict::kWarn
                     : Verdict::kFail,
      fmt::format(
          "**Stable up to {:.0f} rpm; sensitivity zone {}** of ISO 14839-3 (largest peak {:.2f}).",
          a.options.fastest / kRpm, worst, peak));
}

void AddCapacity(HtmlReport& report, const RigAnalysis& a) {
  report.Heading("Bearings");
  std::vector<std::vector<Cell>> rows;
  for (const AxisCapacity& c : a.capacity)
    rows.push_back({c.axis, FormatSi(c.k_i, "N/A"), FormatSi(c.k_s, "N/m"),
                    FormatSi(c.usable(), "N"), FormatSi(c.linear, "N"), FormatSi(c.commanded, "N"),
                    FormatSi(c.largest, "N"), FormatSi(c.weight, "N"), FormatSi(c.slew, "N/s"),
                    FormatSi(c.knee, "Hz")});
  report.Table({"axis", "k_i", "k_s", "static capacity", "until a coil clips", "controller's limit",
                "largest force", "carries", "slew limit", "knee"},
               rows,
               "At the levitated operating point. k_i: force per ampere of the control current; "
               "k_s: negative stiffness (pulls away from the "
               "centre). Static capacity: the smaller of the next two. Largest force: exact "
               "circuit, set-points clamped. Slew: what the bus "
               "voltage allows; above the knee a sine of the static capacity is cut.");
}

void AddJoint(HtmlReport& report, const RigAnalysis& a) {
  std::vector<std::vector<Cell>> rows;
  for (const Sensitivity& s : a.sensitivity)
    for (const JointMargin& m : s.joint) {
      std::string axes, worst;
      double least = kInfinity;  // of those axes alone
      for (std::size_t k = 0; k < m.axes.size(); ++k) {
        const AxisSensitivity& x = s.axes[m.axes[k]];
        least = std::min(least, x.disk_margin);
        axes += (k ? " " : "") + x.axis;
        if (k < m.factor.size())
          worst += fmt::format("{}{} × {:.2f} {:+.0f}°", k ? ", " : "", x.axis,
                               std::abs(m.factor[k]), std::arg(m.factor[k]) * 180 / kPi);
      }
      rows.push_back({fmt::format("{:.0f}", s.speed / kRpm), axes, fmt::format("{:.3f}", m.alpha),
                      fmt::format("{:.3f}", least), Factor(DiskGainDown(m.alpha)),
                      Factor(DiskGainUp(m.alpha)),
                      fmt::format("{:.1f}", DiskPhase(m.alpha) * 180 / kPi),
                      FormatSi(m.frequency, "Hz"), worst});
    }
  if (rows.empty()) return;
  report.Table(
      {"speed [rpm]", "axes together", "joint disk margin", "least of one alone", "gain down to",
       "gain up to", "phase [deg]", "at", "a perturbation at the limit"},
      rows,
      "Every loop of the group is multiplied by a complex factor of its own, all at once: it stays "
      "stable while no factor leaves the disk whose real diameter is the two gains (or, at "
      "unchanged gain, no phase the one shown). From an upper bound of the structured singular "
      "value of S - 1/2 with diagonal scaling. Axes without coupling form groups of one.");
}

void AddSensitivity(HtmlReport& report, const RigAnalysis& a) {
  report.Heading("Stability margins");
  report.Text(
      "S is the command after an injection point over the force injected there, every other loop "
      "closed: 1/(1 + loop gain). The peak counts "
      "up to three times the highest operating speed or 2 kHz, whichever is higher.");
  std::vector<std::vector<Cell>> rows;
  for (const Sensitivity& s : a.sensitivity)
    for (const AxisSensitivity& x : s.axes) {
      if (!s.stable) {
        rows.push_back({fmt::format("{:.0f}", s.speed / kRpm), x.axis, "-", "-",
                        Cell("unstable", "fail"), "-", "-", "-", "-", "-"});
        continue;
      }
      rows.push_back({fmt::format("{:.0f}", s.speed / kRpm), x.axis, fmt::format("{:.3f}", x.peak),
                      FormatSi(x.peak_frequency, "Hz"), ZoneCell(x.zone), Factor(x.gain_down),
                      Factor(x.gain_up), fmt::format("{:.1f}", x.phase_margin * 180 / kPi),
                      FormatSi(x.phase_frequency, "Hz"), FormatSi(x.delay_margin, "s")});
    }
  report.Table({"speed [rpm]", "axis", "peak |S|", "at", "zone", "gain down to", "gain up to",
                "phase margin [deg]", "at", "delay margin"},
               rows,
               "The loop stays stable while its gain is multiplied by anything between the two "
               "factors, or delayed by less than the last column, at this axis alone: "
               "simultaneous-loop margins are smaller.");
  AddJoint(report, a);
  report.AddFigure(SensitivityFigure(a));
  if (!a.measured.empty()) {
    std::vector<std::vector<Cell>> points;
    for (const MeasuredPoint& p : a.measured) {
      const double off = 100 * (std::abs(p.measured) / std::abs(p.computed) - 1);
      points.push_back({a.capacity[p.axis].axis, fmt::format("{:.1f}", p.frequency),
                        fmt::format("{:.4f}", std::abs(p.measured)),
                        fmt::format("{:.4f}", std::abs(p.computed)),
                        Cell(fmt::format("{:+.2f}", off), std::abs(off) < 2 ? "ok" : "warn")});
    }
    report.BeginDetails("Measured in the switching rig, in numbers");
    report.Table({"axis", "frequency [Hz]", "measured |S|", "computed |S|", "difference [%]"},
                 points);
    report.EndDetails();
  }
  report.AddFigure(NyquistFigure(a));
}

void AddRotorTable(HtmlReport& report, const RigAnalysis& a) {
  report.Heading("Rotor dynamics");
  report.AddFigure(CampbellFigure(a));
  std::vector<std::vector<Cell>> rows;
  for (const DampedCritical& c : a.criticals) {
    if (!c.IsResonance()) continue;
    rows.push_back({fmt::format("{:.0f}", c.speed / kRpm), SenseName(c.mode.sense()),
                    fmt::format("{:.3f}", c.mode.zeta),
                    Cell(fmt::format("{:.3f}", c.mode.log_decrement),
                         c.mode.log_decrement > kLeastLogDecrement ? "ok" : "fail")});
  }
  if (rows.empty() && !a.criticals.empty())
    report.Text(
        "Modes meet the speed in this range, each with a damping ratio above 0.7: no resonance, so "
        "no critical speed.");
  else if (rows.empty())
    report.Text("No mode of the rotor meets the speed in this range.");
  else
    report.Table({"critical speed [rpm]", "whirl", "damping ratio", "log decrement"}, rows,
                 "Where a damped frequency equals the speed.");
  report.AddFigure(ModeShapeFigure(a));
  report.AddFigure(RootLocusFigure(a));
  report.Heading("Rotor without magnetic bearings", 3);
  if (!a.supports.free.empty() || !a.supports.supported.empty())
    report.AddFigure(RotorModeFigure(a));
  if (!a.supports.map.empty()) report.AddFigure(CriticalMapFigure(a));
}

/// Whether every axis has a PID with an integral part.
bool Integrates(const RigParameters& rig) {
  if (rig.controller.kind != "pid") return false;
  return std::all_of(rig.bearings.begin(), rig.bearings.end(), [&](const BearingParameters& b) {
    return (b.controller ? *b.controller : rig.controller.pid).ki > 0;
  });
}

void AddUnbalance(HtmlReport& report, const RigAnalysis& a) {
  if (a.unbalance.empty()) return;
  report.Heading("Unbalance");
  report.Text(
      "Residual unbalance of API 617, 6350 W/N g mm in every plane (W: load in kg, N: highest "
      "operating speed in rpm).");
  std::vector<std::vector<Cell>> rows;
  for (const DisplacementRow& d : a.displacement)
    rows.push_back({d.unbalance, d.bearing, FormatSi(d.largest, "m"), FormatSi(d.clearance, "m"),
                    fmt::format("{:.4f}", d.largest / d.clearance), ZoneCell(d.zone)});
  report.Table({"unbalance", "bearing", "largest orbit", "clearance", "ratio", "zone"}, rows,
               "ISO 14839-2 over the operating speeds: A up to 0.3, B up to 0.4, C up to 0.5 of "
               "the least clearance (the auxiliary bearing's)." +
                   std::string(Integrates(a.point.rig())
                                   ? " Static offset is zero: the controller integrates."
                                   : ""));
  rows.clear();
  for (const SeparationRow& s : a.separation)
    rows.push_back({s.unbalance, s.bearing, fmt::format("{:.0f}", s.peak.speed / kRpm),
                    FormatSi(s.peak.amplitude, "m"),
                    fmt::format("{}{:.2f}", s.peak.bound ? "< " : "", s.peak.amplification),
                    fmt::format("{:.1f}", s.margin.required),
                    fmt::format("{:.1f}", s.margin.actual),
                    Cell(s.margin.met ? "met" : "not met", s.margin.met ? "ok" : "fail")});
  if (rows.empty())
    report.Text("The response has no peak in this range: no separation margin is needed.");
  else
    report.Table(
        {"unbalance", "bearing", "peak at [rpm]", "amplitude", "AF", "margin required [%]",
         "actual [%]", ""},
        rows,
        "Separation margins of API 617 (API 684 2nd ed., SP6.8.2.10; AF: SP6.8.2.1). AF < 2.5: "
        "critically damped, none required. AF < x: a half-power point lies beyond the "
        "sweep or another peak.");
  for (const UnbalanceSweep& s : a.unbalance) report.AddFigure(UnbalanceFigure(a, s));
}

}  // namespace

void WriteAnalysisReport(const RigAnalysis& a, const std::string& rig_file,
                         const std::filesystem::path& path) {
  HtmlReport report("Analysis of " + a.point.rig().name,
                    fmt::format("rig {}, operating {}", rig_file,
                                SpeedRange(a.options.lowest, a.options.highest)));
  report.Heading("Verdict");
  AddAnalysisVerdict(report, a);
  report.Text(
      "The rig linearised exactly where it levitates: rotor, magnets, current loops with the moved "
      "switching edge, sampled controller and its "
      "delays.");
  for (const std::string& note : a.point.notes) report.Text("- " + note);
  AddCapacity(report, a);
  AddSensitivity(report, a);
  AddRotorTable(report, a);
  AddUnbalance(report, a);
  report.Heading("Dynamic stiffness");
  report.AddFigure(StiffnessFigure(a));
  if (!a.responses.empty()) report.Heading("Frequency responses");
  for (const ResponseCurve& c : a.responses) report.AddFigure(BodeFigure(c));
  report.Write(path);
}

}  // namespace ambrig
