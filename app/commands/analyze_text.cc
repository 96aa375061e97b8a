#include "app/commands/analyze_text.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "analysis/iso14839.h"
#include "app/commands/commands.h"
#include "app/json/analysis_json.h"
#include "app/text/format.h"
#include "app/text/screen.h"
#include "core/base/counted.h"
#include "core/math/constants.h"

namespace ambrig {

namespace {

/// Speeds [rpm] at which the loop is unstable, neighbours as a range: "0 to 3000, 9000".
std::string UnstableSpeeds(const RigAnalysis& a) {
  std::string text;
  for (std::size_t k = 0; k < a.rows.size(); ++k) {
    if (a.rows[k].stable() || (k > 0 && !a.rows[k - 1].stable())) continue;
    std::size_t last = k;
    while (last + 1 < a.rows.size() && !a.rows[last + 1].stable()) ++last;
    text += fmt::format("{}{:.0f}", text.empty() ? "" : ", ", a.rows[k].speed / kRpm);
    if (last > k) text += fmt::format(" to {:.0f}", a.rows[last].speed / kRpm);
  }
  return text;
}

/// Axes in zones C and D of a stable loop: "z (D)".
std::string PoorAxes(const RigAnalysis& a) {
  std::map<std::string, char> worst;
  for (const Sensitivity& s : a.sensitivity)
    for (const AxisSensitivity& x : s.axes) worst[x.axis] = std::max(worst[x.axis], x.zone);
  std::string text;
  for (const auto& [axis, zone] : worst)
    if (zone > 'B') text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", axis, zone);
  return text;
}

void PrintVerdict(const RigAnalysis& a) {
  if (!a.stable()) {
    fmt::print("{}\n",
               Coloured(fmt::format("closed loop UNSTABLE at {} rpm", UnstableSpeeds(a)), "red"));
    return;
  }
  const std::string poor = PoorAxes(a);
  fmt::print("{}\n", Coloured("closed loop stable at every speed analysed", "green"));
  if (!poor.empty())
    fmt::print("{}\n", Coloured("sensitivity outside zones A and B: " + poor, "red"));
}

std::string Zone(char zone) {
  return Coloured(std::string(1, zone), zone == 'A' ? "green" : zone == 'B' ? "yellow" : "red");
}

void PrintCapacity(const RigAnalysis& a) {
  fmt::print("\n{}\n", Coloured("bearings at the operating point: force per current, negative "
                                "stiffness, forces",
                                "bold"));
  fmt::print("{:<5} {:>9} {:>10} {:>10} {:>10} {:>9} {:>10} {:>9}\n", "axis", "k_i [N/A]",
             "k_s [N/m]", "static [N]", "weight [N]", "peak [N]", "slew [N/s]", "knee [Hz]");
  for (const AxisCapacity& c : a.capacity)
    fmt::print("{:<5} {:>9.4g} {:>10.5g} {:>10.4g} {:>10.4g} {:>9.4g} {:>10.4g} {:>9.4g}\n", c.axis,
               c.k_i, c.k_s, c.usable(), c.weight, c.largest, c.slew, c.knee);
  fmt::print(
      "static: until a coil or the controller clips; slew: what the bus voltage allows;\n"
      "knee: above it a sine of the static force is cut\n");
}

void PrintSensitivity(const RigAnalysis& a) {
  fmt::print("\n{}\n",
             Coloured("sensitivity (ISO 14839-3), all other loops closed; margins of gain, phase, "
                      "delay",
                      "bold"));
  fmt::print("{:>7} {:<5} {:>8} {:>8} {:>4} {:>17} {:>11} {:>10}\n", "rpm", "axis", "peak |S|",
             "at [Hz]", "zone", "gain x from..to", "phase [deg]", "delay [us]");
  for (const Sensitivity& s : a.sensitivity)
    for (const AxisSensitivity& x : s.axes)
      if (!s.stable)
        fmt::print("{:>7.0f} {:<5} {:>8} {:>8} {:>4} {:>17} {:>11} {:>10}\n", s.speed / kRpm,
                   x.axis, "-", "-", "-", "-", "-", "-");
      else
        fmt::print("{:>7.0f} {:<5} {:>8.3f} {:>8.1f} {:>4} {:>17} {:>11.1f} {:>10.1f}\n",
                   s.speed / kRpm, x.axis, x.peak, x.peak_frequency, Zone(x.zone),
                   fmt::format("{:.3f}..{:.3f}", x.gain_down, x.gain_up),
                   x.phase_margin * 180 / kPi, x.delay_margin * 1e6);
  fmt::print(
      "\n{}\n{:>7} {:>8} {:>17} {:>11} {:>8}  {}\n",
      Coloured("simultaneous-loop disk margin: independent perturbations of all loops at once",
               "bold"),
      "rpm", "disk [-]", "gain x from..to", "phase [deg]", "at [Hz]", "axes");
  for (const Sensitivity& s : a.sensitivity)
    for (const JointMargin& m : s.joint) {
      std::vector<std::string> axes;
      for (std::size_t k : m.axes) axes.push_back(s.axes[k].axis);
      fmt::print("{:>7.0f} {:>8.3f} {:>17} {:>11.1f} {:>8.1f}  {}\n", s.speed / kRpm, m.alpha,
                 fmt::format("{:.3f}..{:.3f}", DiskGainDown(m.alpha), DiskGainUp(m.alpha)),
                 DiskPhase(m.alpha) * 180 / kPi, m.frequency, fmt::join(axes, " "));
    }
  for (const MeasuredPoint& p : a.measured)
    fmt::print("  measured {:<5} {:>8.1f} Hz: |S| {:.4f}, computed {:.4f}, difference {:+.2f} %\n",
               a.capacity[p.axis].axis, p.frequency, std::abs(p.measured), std::abs(p.computed),
               100 * (std::abs(p.measured) / std::abs(p.computed) - 1));
}

void PrintModes(const RigAnalysis& a) {
  const auto line = [](const std::string& name, const std::vector<RotorMode>& modes) {
    std::string text = fmt::format("  {:<22}", name);
    for (const RotorMode& m : modes) text += fmt::format(" {:.2f}", m.frequency);
    fmt::print("{}\n", Wrapped(text + (modes.empty() ? " none" : " Hz"), 25));
  };
  fmt::print("\n{}\n", Coloured("rotor at rest", "bold"));
  line("free", a.supports.free);
  line("on springs k_p - k_s", a.supports.supported);
  fmt::print("\n{}\n", Coloured("rotor modes of the closed loop", "bold"));
  fmt::print("{:>9} {:>10} {:>8} {:>9} {:<9}\n", "rpm", "f [Hz]", "zeta", "log dec", "whirl");
  for (const ClosedLoopModes& r : a.rows) {
    if (r.speed != 0 && r.speed != a.options.lowest && r.speed != a.options.highest) continue;
    for (const ClosedLoopMode& m : r.modes)
      if (m.of_rotor() && m.zeta < 0.95)
        fmt::print("{:>9.0f} {:>10.2f} {:>8.4f} {:>9.3f} {:<9}\n", r.speed / kRpm, m.frequency,
                   m.zeta, m.log_decrement, SenseName(m.sense()));
  }
  for (const DampedCritical& c : a.criticals)
    if (c.IsResonance())
      fmt::print("  critical speed {:.0f} rpm, {}, log decrement {:.3f}\n", c.speed / kRpm,
                 SenseName(c.mode.sense()), c.mode.log_decrement);
}

void PrintStandards(const RigAnalysis& a) {
  if (a.displacement.empty()) return;
  fmt::print("\n{}\n",
             Coloured("unbalance of API 617 (6350 W/N g mm a plane), operating speeds", "bold"));
  for (const DisplacementRow& d : a.displacement)
    fmt::print("  {:<7} {:<3} largest {:>8.3f} um of {:.0f} um: ISO 14839-2 zone {}\n", d.unbalance,
               d.bearing, d.largest * 1e6, d.clearance * 1e6, Zone(d.zone));
  for (const SeparationRow& s : a.separation)
    fmt::print("  {:<7} {:<3} peak at {:.0f} rpm, AF {}: margin {:.1f} % ({:.1f} % wanted) {}\n",
               s.unbalance, s.bearing, s.peak.speed / kRpm,
               fmt::format("{}{:.2f}", s.peak.bound ? "< " : "", s.peak.amplification),
               s.margin.actual, s.margin.required,
               s.margin.met ? Coloured("met", "green") : Coloured("NOT MET", "red"));
  if (!a.separation.empty())
    fmt::print("  AF: amplification factor; margin: from the peak to the operating speeds\n");
}

}  // namespace

void PrintAnalysis(const RigAnalysis& a) {
  const RigParameters& rig = a.point.rig();
  int coils = 0;
  for (const auto& b : rig.bearings) coils += b.coils();
  fmt::print("{}: {}, {}, controller {:g} Hz,\noperating {}, analysed up to {:.0f} rpm\n",
             Coloured(rig.name, "bold"),
             a.capacity.size() == 1 ? "1 axis" : fmt::format("{} axes", a.capacity.size()),
             Counted(coils, "coil"), rig.controller.rate,
             SpeedRange(a.options.lowest, a.options.highest), a.options.fastest / kRpm);
  PrintVerdict(a);
  for (const std::string& note : a.point.notes) fmt::print("{}\n", Wrapped("  note: " + note, 8));
  PrintCapacity(a);
  PrintSensitivity(a);
  PrintModes(a);
  PrintStandards(a);
}

}  // namespace ambrig
