/// ambrig analyze: rotor dynamics and control margins of a rig.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "analysis/iso14839.h"
#include "app/commands/commands.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/commands/screen.h"
#include "app/json/analysis_json.h"
#include "app/pages/analysis_report.h"
#include "core/base/atomic_file.h"
#include "core/math/constants.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

struct AnalyzeCommand {
  CommonOptions common;
  std::string rig, speed = "6000", out;
  std::vector<std::string> responses;
  double fastest = 0, sine = 0;  // [rpm], [N]
  int measured = 0;
};

double RpmOption(const std::string& option, const std::string& text) {
  std::size_t used = 0;
  double value = -1;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = std::string::npos;
  }
  if (used != text.size() || !(value >= 0 && value <= 1e7))
    throw InputError(
        fmt::format("--{} = {}, allowed: rpm from 0 to 1e7, e.g. 6000 or 3000:9000", option, text));
  return value;
}

AnalysisOptions OptionsOf(const AnalyzeCommand& c) {
  AnalysisOptions o;
  const std::size_t colon = c.speed.find(':');
  o.lowest = RpmOption("speed", c.speed.substr(0, colon)) * kRpm;
  o.highest =
      colon == std::string::npos ? o.lowest : RpmOption("speed", c.speed.substr(colon + 1)) * kRpm;
  if (o.highest < o.lowest)
    throw InputError(fmt::format("--speed = {}, allowed: the lower speed first", c.speed));
  o.fastest = c.fastest > 0 ? c.fastest * kRpm : o.highest > 0 ? 1.5 * o.highest : 9000 * kRpm;
  if (o.fastest < o.highest)
    throw InputError(
        fmt::format("--max-speed = {}, allowed: at least the highest operating speed, {:g} rpm",
                    c.fastest, o.highest / kRpm));
  for (const std::string& pair : c.responses) {
    const std::size_t comma = pair.find(':');
    if (comma == std::string::npos)
      throw InputError(
          fmt::format("--response = {}, allowed: INPUT:OUTPUT, e.g. A.x.force:B.x", pair));
    o.responses.emplace_back(pair.substr(0, comma), pair.substr(comma + 1));
  }
  o.measured = c.measured;
  o.sine = c.sine;
  o.stop = &interrupted;
  return o;
}

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

/// Above this damping a response has no peak: no critical speed to a reader.
bool HasResonance(double zeta) { return zeta < std::sqrt(0.5); }

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
    if (HasResonance(c.mode.zeta))
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
    fmt::print("  {:<7} {:<3} peak at {:.0f} rpm, AF {}: margin {:.1f} % of {:.1f} % {}\n",
               s.unbalance, s.bearing, s.peak.speed / kRpm,
               fmt::format("{}{:.2f}", s.peak.bound ? "< " : "", s.peak.amplification),
               s.margin.actual, s.margin.required,
               s.margin.met ? Coloured("met", "green") : Coloured("NOT MET", "red"));
}

void PrintAnalysis(const RigAnalysis& a) {
  const RigParameters& rig = a.point.rig();
  fmt::print(
      "{}: {} axes, {} coils, controller {:g} Hz,\noperating {:.0f} to {:.0f} rpm, analysed up "
      "to {:.0f} rpm\n",
      Coloured(rig.name, "bold"), a.capacity.size(),
      [&] {
        int n = 0;
        for (const auto& b : rig.bearings) n += b.coils();
        return n;
      }(),
      rig.controller.rate, a.options.lowest / kRpm, a.options.highest / kRpm,
      a.options.fastest / kRpm);
  PrintVerdict(a);
  for (const std::string& note : a.point.notes) fmt::print("{}\n", Wrapped("  note: " + note, 8));
  PrintCapacity(a);
  PrintSensitivity(a);
  PrintModes(a);
  PrintStandards(a);
}

/// Most rigs are called rig.toml: their folder tells them apart.
std::string OutputBase(const AnalyzeCommand& c) {
  const std::filesystem::path rig = std::filesystem::absolute(c.rig).lexically_normal();
  std::string name = rig.stem().string();
  if (name == "rig") name = rig.parent_path().filename().string() + ".rig";
  return (std::filesystem::path(c.out) / (name + ".analysis")).string();
}

int RunAnalyze(const AnalyzeCommand& c) {
  AnalysisOptions options = OptionsOf(c);
  const RigParameters rig = ReadRig(c.rig);
  const std::string base = OutputBase(c);
  std::vector<std::string> files;
  if (!c.out.empty()) files = {base + ".json", base + ".html"};
  c.common.CheckOutputs({c.rig}, files);
  if (!c.out.empty()) PrepareFolder(c.out);
  RigAnalysis analysis;
  {
    Progress progress("analyze");
    options.progress = [&](double f, const std::string& text) { progress.Update(f, text); };
    analysis = Analyse(rig, options);
  }
  analysis.options.progress = nullptr;
  PrintAnalysis(analysis);
  const nlohmann::ordered_json json = AnalysisJson(analysis);
  c.common.WriteJson(json);
  if (!c.common.html.empty()) WriteAnalysisReport(analysis, c.rig, c.common.html);
  if (c.out.empty()) return analysis.stable() ? 0 : 1;
  WriteFileAtomically(base + ".json", MarkedJson(json));
  WriteAnalysisReport(analysis, c.rig, base + ".html");
  fmt::print("written: {0}.json, {0}.html\n", base);
  return analysis.stable() ? 0 : 1;
}

}  // namespace

void AddAnalyze(CLI::App& app, Work& work) {
  auto c = std::make_shared<AnalyzeCommand>();
  CLI::App* command = app.add_subcommand(
      "analyze", "rotor dynamics and control margins: modes, Campbell, sensitivity, unbalance");
  command->add_option("rig", c->rig, "rig file (TOML)")->required();
  command->add_option("--speed", c->speed, "operating speed, or lowest:highest [rpm]")
      ->capture_default_str();
  command
      ->add_option("--max-speed", c->fastest,
                   "end of the Campbell diagram [rpm] (default: 1.5 operating speeds)")
      ->check(NumberIn(1, 1e7, "rpm"));
  command->add_option("--response", c->responses,
                      "frequency response INPUT:OUTPUT, e.g. A.x.force:B.x; may be repeated");
  command
      ->add_option("--measure", c->measured,
                   "inject sines of this many frequencies per axis into the switching rig")
      ->check(CLI::Range(1, 200));
  command
      ->add_option("--sine", c->sine,
                   "amplitude of those sines [N] (default: a hundredth of the capacity)")
      ->check(NumberIn(1e-9, 1e6, "N"));
  command->add_option(
      "-o,--out", c->out,
      "folder for NAME.analysis.json and .html; of a rig.toml NAME is its folder.rig");
  c->common.AddTo(*command);
  command->footer(
      "Examples:\n"
      "  ambrig analyze examples/reference/rig.toml --speed 3000:9000 -o out\n"
      "  ambrig analyze examples/reference/rig.toml --measure 3 --html rig.html\n"
      "  ambrig analyze examples/reference/rig.toml --response A.x.load:A.x\n"
      "Inputs: AXIS.force, .reference, .sensor, .load; outputs: AXIS, AXIS.command, .shaft,\n"
      ".magnet, or a coil A.i1; of a named plane of a beam rotor: disk.x.load, disk.x.\n"
      "Exit code 1 when the closed loop is unstable.");
  command->callback([c, &work] { work = [c] { return RunAnalyze(*c); }; });
}

}  // namespace ambrig
