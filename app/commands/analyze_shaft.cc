#include "app/commands/analyze_shaft.h"

#include <fmt/format.h>

#include <cmath>

#include "analysis/shaft/shaft_analysis.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "app/commands/screen.h"
#include "app/json/analysis_json.h"
#include "app/json/shaft_json.h"
#include "app/pages/shaft_report.h"
#include "core/base/atomic_file.h"
#include "core/math/constants.h"
#include "rotor/shaft/shaft_file.h"

namespace ambrig {

namespace {

constexpr const char* kUnbalanceForm = "PLANE:G_MM or PLANE:G_MM@DEG, e.g. disk:50@90";

/// The parts of "a:b:c"; the first may hold no colon.
std::vector<std::string> SplitOption(const std::string& text, char at) {
  std::vector<std::string> out(1);
  for (const char c : text)
    if (c == at)
      out.emplace_back();
    else
      out.back() += c;
  return out;
}

double OptionNumber(const char* option, const std::string& whole, const std::string& text,
                    const char* form, double lo, double hi) {
  std::size_t used = 0;
  double value = kRequired;
  try {
    value = std::stod(text, &used);
  } catch (const std::exception&) {
    used = std::string::npos;
  }
  if (used != text.size() || !(value >= lo && value <= hi))
    throw InputError(fmt::format("--{} = {}, allowed: {}", option, whole, form));
  return value;
}

UnbalanceChoice ReadUnbalance(const std::string& text) {
  const auto parts = SplitOption(text, ':');
  if (parts.size() != 2)
    throw InputError(fmt::format("--unbalance = {}, allowed: {}", text, kUnbalanceForm));
  const auto size = SplitOption(parts[1], '@');
  UnbalanceChoice u;
  u.plane.text = parts[0];
  u.magnitude = 1e-6 * OptionNumber("unbalance", text, size[0], kUnbalanceForm, 0, 1e12);
  if (size.size() > 1)
    u.phase = kPi / 180 * OptionNumber("unbalance", text, size[1], kUnbalanceForm, -360, 360);
  return u;
}

/// All cross-couplings act at one plane, as level 1 asks.
void ReadCoupling(const ShaftCommand& c, double speed, ShaftOptions& o) {
  const auto add = [&](const std::string& plane, double q) {
    if (o.coupling > 0 && o.coupled.text != plane)
      throw InputError(fmt::format("--cross-coupling: planes {} and {}, allowed: one plane",
                                   o.coupled.text, plane));
    o.coupled.text = plane;
    o.coupling += q;
  };
  for (const std::string& text : c.coupling) {
    const auto parts = SplitOption(text, ':');
    constexpr const char* kForm = "PLANE:N_PER_M above 0, e.g. middle:5e6";
    if (parts.size() != 2)
      throw InputError(fmt::format("--cross-coupling = {}, allowed: {}", text, kForm));
    add(parts[0], OptionNumber("cross-coupling", text, parts[1], kForm, 1e-6, 1e15));
  }
  for (const std::string& text : c.alford) {
    constexpr const char* kForm =
        "PLANE:KW:D_MM:H_MM or PLANE:KW:D_MM:H_MM:DENSITY_RATIO, e.g. middle:3000:400:20:1.2";
    const auto parts = SplitOption(text, ':');
    if (parts.size() != 4 && parts.size() != 5)
      throw InputError(fmt::format("--alford = {}, allowed: {}", text, kForm));
    if (speed <= 0) throw InputError("--speed = 0, allowed with --alford: above 0");
    const auto value = [&](std::size_t k) {
      return OptionNumber("alford", text, parts[k], kForm, 1e-9, 1e9);
    };
    add(parts[0], AlfordCoupling(1e3 * value(1), speed, 1e-3 * value(2), 1e-3 * value(3),
                                 parts.size() == 5 ? value(4) : 1));
  }
}

void PrintShaftModes(const ShaftAnalysis& a) {
  const double hz = 1 / (2 * kPi);
  std::string text = "  free bending [Hz]";
  for (const double w : a.free) text += fmt::format(" {:.2f}", w * hz);
  fmt::print("{}\n", Wrapped(text, 4));
  for (const auto& [name, modes] : {std::pair{"axial", &a.axial}, {"torsional", &a.torsional}}) {
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
                 m.zeta, m.log_decrement, SenseName(m.sense()));
  }
  fmt::print("\n{}\n", Coloured("critical speeds", "bold"));
  text = "  undamped [rpm]";
  for (const CriticalSpeed& c : a.undamped)
    text += fmt::format(" {:.1f}{}", c.speed / kRpm, c.whirl > 0 ? "F" : "B");
  fmt::print("{}\n", a.undamped.empty() ? "  undamped: the supports do not hold the shaft"
                                        : Wrapped(text, 4));
  for (const DampedCritical& c : a.campbell.criticals)
    if (c.mode.zeta < std::sqrt(0.5))  // else no response has a peak there
      fmt::print("  damped {:.1f} rpm, {}, log decrement {:.4f}\n", c.speed / kRpm,
                 SenseName(c.mode.sense()), c.mode.log_decrement);
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
        fmt::print("  {:<12} {:.4g} um at {:.1f} rpm, AF {}{:.2f}\n", p.probe.name,
                   k.amplitude * 1e6, k.speed / kRpm, k.bound ? "< " : "", k.amplification);
    }
  }
}

void PrintShaftExtras(const ShaftAnalysis& a) {
  if (a.level1) {
    const Level1& l = *a.level1;
    fmt::print("\n{}\n", Coloured("cross-coupled stiffness (API 684 level 1)", "bold"));
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
             Coloured(fmt::format("{} rotors, {} numbers with an sd, {:.0f} rpm: 5, 50, 95 %",
                                  a.scatter->rotors, a.scatter->parameters.size(),
                                  a.scatter->speed / kRpm),
                      "bold"),
             "f [Hz]", "5 %", "50 %", "95 %", "dec 5 %", "50 %", "95 %");
  for (const ScatteredMode& m : a.scatter->modes)
    fmt::print("{:>10.3f} {:>10.3f} {:>10.3f} {:>10.3f} {:>10.4f} {:>10.4f} {:>10.4f}\n",
               m.nominal_frequency, m.frequency.low, m.frequency.middle, m.frequency.high,
               m.decrement.low, m.decrement.middle, m.decrement.high);
}

void PrintShaft(const ShaftAnalysis& a) {
  fmt::print(
      "{}: {:.6g} kg, centre of mass z = {:.6g} m, {} nodes,\noperating {:.0f} to {:.0f} rpm, "
      "analysed up to {:.0f} rpm\n",
      Coloured(a.name, "bold"), a.totals.mass, a.totals.z_com, a.beam.z.size(),
      a.options.lowest / kRpm, a.options.highest / kRpm, a.options.fastest / kRpm);
  for (const std::string& note : a.notes) fmt::print("{}\n", Wrapped("  note: " + note, 8));
  if (!a.campbell.stable()) fmt::print("{}\n", Coloured("UNSTABLE at a speed analysed", "red"));
  PrintShaftModes(a);
  PrintShaftLoads(a);
  PrintShaftExtras(a);
}

ShaftOptions OptionsFor(const ShaftRequest& r, const ShaftCommand& c) {
  ShaftOptions o;
  o.lowest = r.lowest;
  o.highest = r.highest;
  o.fastest = r.fastest;
  o.modes = c.modes;
  for (const std::string& u : c.unbalance) o.unbalance.push_back(ReadUnbalance(u));
  o.grade = 1e-3 * c.grade;
  for (const std::string& p : c.probes) o.probes.push_back({p});
  ReadCoupling(c, r.highest, o);
  o.rotors = c.rotors;
  o.seed = c.seed;
  o.stop = &interrupted;
  if (!c.unbalance.empty() && c.grade > 0)
    throw InputError("--grade is given beside --unbalance, allowed: one of them");
  return o;
}

}  // namespace

void ShaftCommand::AddTo(CLI::App& command) {
  const std::string group = "A shaft without magnetic bearings";
  command.add_option("--unbalance", unbalance, "PLANE:G_MM[@DEG] instead of API 617's; repeat")
      ->group(group);
  command.add_option("--grade", grade, "ISO 21940-11 grade G [mm/s] as the unbalance, e.g. 2.5")
      ->check(NumberIn(1e-6, 1e6, "mm/s"))
      ->group(group);
  command.add_option("--probe", probes, "plane or housing where the motion is read; repeat")
      ->group(group);
  command
      .add_option("--cross-coupling", coupling, "PLANE:N_PER_M expected there (API 684 level 1)")
      ->group(group);
  command
      .add_option("--alford", alford,
                  "PLANE:KW:D_MM:H_MM[:RATIO] of a stage, the same from its power")
      ->group(group);
  command.add_option("--modes", modes, "damped modes (10)")
      ->check(CLI::Range(1, 100))
      ->group(group);
  command.add_option("--scatter", rotors, "rotors drawn from the numbers that have an sd")
      ->check(CLI::Range(2, 10000000))
      ->group(group);
  command.add_option("--seed", seed, "of --scatter (1)")
      ->check(NumberIn(0, 9e15, "(an integer)"))
      ->group(group);
}

std::string ShaftCommand::Given() const {
  return !unbalance.empty()  ? "unbalance"
         : grade > 0         ? "grade"
         : !probes.empty()   ? "probe"
         : !coupling.empty() ? "cross-coupling"
         : !alford.empty()   ? "alford"
         : rotors > 0        ? "scatter"
                             : "";
}

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
  ShaftOptions options = OptionsFor(r, c);
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
