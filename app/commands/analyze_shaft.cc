#include "app/commands/analyze_shaft.h"

#include <fmt/format.h>

#include <cmath>

#include "app/commands/leave_when_stopped.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/json/analysis_json.h"
#include "app/json/shaft_json.h"
#include "app/pages/shaft_report.h"
#include "app/text/format.h"
#include "app/text/screen.h"
#include "core/base/atomic_file.h"
#include "core/base/counted.h"
#include "core/math/constants.h"
#include "rotor/shaft/shaft_file.h"

namespace ambrig {

namespace {

/// Without the sign that rounding gives to nothing.
double Shown(double v) { return std::abs(v) < 5e-5 ? 0 : v; }

void PrintShaftModes(const ShaftAnalysis& a) {
  const double hz = 1 / (2 * kPi);
  std::string text = "  free bending [Hz]";
  for (const double w : a.free) text += fmt::format(" {:.2f}", w * hz);
  fmt::print("{}\n", Wrapped(text, 4));
  for (const auto& [name, modes] : {std::pair{"axial", &a.axial}, {"torsional", &a.torsional}}) {
    if (a.options.campbell_alone) break;
    text = fmt::format("  {} [Hz]", name);
    for (const RodMode& m : *modes) text += fmt::format(" {:.2f}", m.omega * hz);
    fmt::print("{}\n", Wrapped(text, 4));
  }
  fmt::print("\n{}\n{:>9} {:>10} {:>8} {:>9} {:<9}\n", Coloured("damped modes", "bold"), "rpm",
             "f [Hz]", "zeta", "log dec", "whirl");
  for (const ClosedLoopModes& r : a.campbell.rows) {
    if (r.speed != 0 && r.speed != a.options.lowest && r.speed != a.options.highest) continue;
    for (const ClosedLoopMode& m : r.modes)
      fmt::print("{:>9.0f} {:>10.3f} {:>8.4f} {:>9.4f} {:<9}\n", r.speed / kRpm, m.frequency,
                 Shown(m.zeta), Shown(m.log_decrement), SenseName(r, m));
  }
  fmt::print("\n{}\n", Coloured("critical speeds", "bold"));
  text = "  undamped [rpm]";
  if (a.options.campbell_alone) text.clear();
  for (const CriticalSpeed& c : a.undamped)
    text += fmt::format(" {:.1f}{}", c.speed / kRpm, c.whirl > 0 ? "F" : "B");
  if (!text.empty())
    fmt::print("{}\n", a.undamped.empty() ? "  undamped: the supports do not hold the shaft"
                                          : Wrapped(text, 4));
  for (const DampedCritical& c : a.campbell.criticals)
    if (c.IsResonance())
      fmt::print("  damped {:.1f} rpm, {}, log decrement {:.4f}\n", c.speed / kRpm,
                 SenseName(c.mode.sense()), Shown(c.mode.log_decrement));
}

void PrintShaftLoads(const ShaftAnalysis& a) {
  if (a.weight.held) {
    double lowest = 0, moment = 0;
    for (const double y : a.weight.y) lowest = std::min(lowest, y);
    for (const double m : a.weight.moment)
      if (std::abs(m) > std::abs(moment)) moment = m;
    fmt::print(
        "\n{}\n  weight {:.2f} N, lowest point {:.4g} um, largest bending moment {:.4g} N m\n",
        Coloured("under its weight", "bold"), a.weight.weight, lowest * 1e6, moment);
    for (const SupportReaction& r : a.weight.reactions)
      fmt::print(
          "  {:<12} holds {:.2f} N{}\n", r.name.empty() ? fmt::format("z = {:g} m", r.z) : r.name,
          r.fy, std::abs(r.fx) > 1e-6 * std::abs(r.fy) ? fmt::format(", {:.2f} N in x", r.fx) : "");
  }
  for (const ShaftSweep& s : a.unbalance) {
    fmt::print("\n{}\n", Coloured(fmt::format("unbalance, {}", s.unbalance.name), "bold"));
    for (const PlaneUnbalance& u : s.unbalance.planes)
      fmt::print("  {:.4g} g mm at z = {:g} m, {:.0f} deg\n", u.magnitude * 1e6, u.z,
                 u.phase * 180 / kPi);
    for (const ProbeOrbit& p : s.probes) {
      if (p.peaks.empty()) fmt::print("  {:<12} no peak\n", p.probe.name);
      for (const ResponsePeak& k : p.peaks)
        if (k.amplitude > 0.1 * (a.beam.z.back() - a.beam.z.front()))
          fmt::print("  {:<12} unbounded at {:.1f} rpm: no damping\n", p.probe.name,
                     k.speed / kRpm);
        else
          fmt::print("  {:<12} {:.4g} um at {:.1f} rpm, AF {}{:.2f}\n", p.probe.name,
                     k.amplitude * 1e6, k.speed / kRpm, k.bound ? "< " : "", k.amplification);
    }
  }
}

void PrintHarmonic(const ShaftAnalysis& a) {
  if (!a.harmonic) return;
  fmt::print(
      "\n{}\n",
      Coloured(fmt::format("harmonic load at {:.0f} rpm", a.harmonic->speed / kRpm), "bold"));
  for (const ProbeOrbit& p : a.harmonic->probes) {
    if (p.peaks.empty()) fmt::print("  {:<12} no peak\n", p.probe.name);
    for (const ResponsePeak& k : p.peaks)
      fmt::print("  {:<12} {:.4g} um at {:.2f} Hz, AF {}{:.2f}\n", p.probe.name, k.amplitude * 1e6,
                 k.speed / (2 * kPi), k.bound ? "< " : "", k.amplification);
  }
}

void PrintShaftExtras(const ShaftAnalysis& a) {
  if (a.level1) {
    const Level1& l = *a.level1;
    fmt::print("\n{}\n", Coloured("cross-coupled stiffness (API 684 level 1, SP6.8.5)", "bold"));
    if (!l.found)
      fmt::print("  no forward mode\n");
    else
      fmt::print(
          "  first forward mode {:.2f} Hz: log decrement {:.4f} at Q_A = {:.4g} N/m, zero at\n  "
          "Q_0 = {:.4g} N/m, Q_0/Q_A = {:.2f}: {}\n",
          l.frequency / (2 * kPi), l.at_expected, l.given.expected, l.limit, l.ratio(),
          l.passed() ? Coloured("passed", "green") : Coloured("level 2 is needed", "red"));
  }
  if (!a.scatter) return;
  fmt::print("\n{}\n{:>10} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10}\n",
             Coloured(fmt::format("{}, {} with an sd, {:.0f} rpm: 5, 50, 95 %",
                                  Counted(a.scatter->rotors, "rotor"),
                                  Counted(a.scatter->parameters.size(), "number"),
                                  a.scatter->speed / kRpm),
                      "bold"),
             "f [Hz]", "5 %", "50 %", "95 %", "dec 5 %", "50 %", "95 %");
  for (const ScatteredMode& m : a.scatter->modes)
    fmt::print("{:>10.3f} {:>10.3f} {:>10.3f} {:>10.3f} {:>10.4f} {:>10.4f} {:>10.4f}\n",
               m.nominal_frequency, m.frequency.low, m.frequency.middle, m.frequency.high,
               m.decrement.low, m.decrement.middle, m.decrement.high);
  for (const ScatteredCritical& c : a.scatter->criticals)
    fmt::print("  critical {:.1f} rpm, {}: {:.1f} to {:.1f} rpm, log decrement {:.4f} to {:.4f}\n",
               c.nominal.speed / kRpm, SenseName(c.nominal.mode.sense()), c.speed.low / kRpm,
               c.speed.high / kRpm, c.decrement.low, c.decrement.high);
  for (const ScatteredResponse& r : a.scatter->responses) {
    std::size_t at = 0;
    for (std::size_t k = 0; k < r.amplitude.size(); ++k)
      if (r.amplitude[k].high > r.amplitude[at].high) at = k;
    fmt::print("  unbalance {}, {}: 95 % stay below {:.4g} um (at {:.0f} rpm)\n", r.unbalance,
               r.probe, r.amplitude[at].high * 1e6, a.scatter->speeds[at] / kRpm);
  }
}

void PrintShaft(const ShaftAnalysis& a) {
  fmt::print(
      "{}: {:.6g} kg, centre of mass z = {:.6g} m, {} nodes,\noperating {}, "
      "analysed up to {:.0f} rpm\n",
      Coloured(a.name, "bold"), a.totals.mass, a.totals.z_com, a.beam.z.size(),
      SpeedRange(a.options.lowest, a.options.highest), a.options.fastest / kRpm);
  for (const std::string& note : a.notes) fmt::print("{}\n", Wrapped("  note: " + note, 8));
  if (!a.campbell.stable()) fmt::print("{}\n", Coloured("UNSTABLE at a speed analysed", "red"));
  PrintShaftModes(a);
  PrintShaftLoads(a);
  PrintHarmonic(a);
  PrintShaftExtras(a);
}

}  // namespace

bool IsShaftFile(const std::string& file) {
  if (file.ends_with(".json")) return true;
  if (!file.ends_with(".toml") || !std::filesystem::is_regular_file(file)) return false;
  const TomlTable root = TomlTable::FromFile(file);
  if (root.Has("bearing") || root.Has("bearings") || root.Has("controller")) return false;
  for (const std::string& key : root.Keys())
    if (key.starts_with("ShaftElement")) return true;
  const auto rotor = root.Table("rotor");
  return rotor && !root.Has("amplifier") && rotor->String("kind", "beam") == "beam";
}

int AnalyseShaftFile(const ShaftRequest& r, const ShaftCommand& c, const CommonOptions& common) {
  ShaftOptions options = ReadShaftOptions(r, c);
  const std::string name = std::filesystem::path(r.file).stem().string();
  const std::string base = (std::filesystem::path(r.out) / (name + ".analysis")).string();
  std::vector<std::string> files;
  if (!r.out.empty()) files = {base + ".json", base + ".html"};
  common.CheckOutputs({r.file}, files);
  if (!r.out.empty()) PrepareFolder(r.out);
  bool ross = false;
  std::vector<std::string> left_out;
  std::vector<Tolerance> tolerances;
  const BeamFile file = ReadShaft(r.file, &ross, &left_out, &tolerances);
  ShaftAnalysis a;
  {
    const LeaveWhenStopped leave;
    Progress progress("analyze");
    options.progress = [&](double f, const std::string& text) { progress.Update(f, text); };
    a = AnalyseShaft(name, file, tolerances, options);
  }
  a.options.progress = nullptr;
  for (const std::string& l : left_out) a.notes.push_back("not taken from ROSS's file: " + l);
  PrintShaft(a);
  const nlohmann::ordered_json json = ShaftJson(a);
  common.WriteJson(json);
  if (!common.html.empty()) WriteShaftReport(a, r.file, common.html);
  if (!r.out.empty()) {
    WriteFileAtomically(base + ".json", MarkedJson(json));
    WriteShaftReport(a, r.file, base + ".html");
    fmt::print("written: {0}.json, {0}.html\n", base);
  }
  return a.campbell.stable() ? 0 : 1;
}

}  // namespace ambrig
