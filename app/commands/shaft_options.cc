/// The options of ambrig analyze that a shaft without magnetic bearings has.
#include <fmt/format.h>

#include "app/commands/analyze_shaft.h"
#include "app/commands/outputs.h"
#include "core/math/constants.h"

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

ForceChoice ReadForce(const std::string& text) {
  constexpr const char* kForm = "PLANE:X_N:Y_N or PLANE:X_N:Y_N@DEG, e.g. disk:10:0";
  const auto parts = SplitOption(text, ':');
  if (parts.size() != 3) throw InputError(fmt::format("--shake = {}, allowed: {}", text, kForm));
  const auto last = SplitOption(parts[2], '@');
  ForceChoice f;
  f.plane.text = parts[0];
  f.x = OptionNumber("shake", text, parts[1], kForm, -1e12, 1e12);
  f.y = OptionNumber("shake", text, last[0], kForm, -1e12, 1e12);
  if (last.size() > 1) f.phase = kPi / 180 * OptionNumber("shake", text, last[1], kForm, -360, 360);
  return f;
}

void ReadGround(const std::string& text, ShaftOptions& o) {
  constexpr const char* kForm = "X_UM:Y_UM, e.g. 10:0";
  if (text.empty()) return;
  const auto parts = SplitOption(text, ':');
  if (parts.size() != 2) throw InputError(fmt::format("--ground = {}, allowed: {}", text, kForm));
  o.ground_x = 1e-6 * OptionNumber("ground", text, parts[0], kForm, -1e9, 1e9);
  o.ground_y = 1e-6 * OptionNumber("ground", text, parts[1], kForm, -1e9, 1e9);
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

}  // namespace

ShaftOptions ReadShaftOptions(const ShaftRequest& r, const ShaftCommand& c) {
  ShaftOptions o;
  o.lowest = r.lowest;
  o.highest = r.highest;
  o.fastest = r.fastest;
  o.modes = c.modes;
  o.campbell_alone = c.campbell;
  for (const std::string& u : c.unbalance) o.unbalance.push_back(ReadUnbalance(u));
  o.grade = 1e-3 * c.grade;
  for (const std::string& p : c.probes) o.probes.push_back({p});
  for (const std::string& f : c.forces) o.forces.push_back(ReadForce(f));
  ReadGround(c.ground, o);
  ReadCoupling(c, r.highest, o);
  o.rotors = c.rotors;
  o.seed = c.seed;
  o.stop = &interrupted;
  if (c.campbell && c.Given() != "campbell")
    throw InputError(
        fmt::format("--{} is given beside --campbell, allowed: one of them", c.Given()));
  if (!c.unbalance.empty() && c.grade > 0)
    throw InputError("--grade is given beside --unbalance, allowed: one of them");
  return o;
}

void ShaftCommand::AddTo(CLI::App& command) {
  const std::string group = "A shaft without magnetic bearings";
  command.add_option("--unbalance", unbalance, "PLANE:G_MM[@DEG] instead of API 617's; repeat")
      ->group(group);
  command.add_option("--grade", grade, "ISO 21940-11 grade G [mm/s] as the unbalance, e.g. 2.5")
      ->check(NumberIn(1e-6, 1e6, "mm/s"))
      ->group(group);
  command.add_option("--probe", probes, "plane or housing where the motion is read; repeat")
      ->group(group);
  command.add_option("--shake", forces, "PLANE:X_N:Y_N[@DEG] harmonic, over the frequency; repeat")
      ->group(group);
  command.add_option("--ground", ground, "X_UM:Y_UM harmonic motion of the ground")->group(group);
  command
      .add_option("--cross-coupling", coupling, "PLANE:N_PER_M expected there (API 684 level 1)")
      ->group(group);
  command
      .add_option("--alford", alford,
                  "PLANE:KW:D_MM:H_MM[:RATIO] of a stage, the same from its power")
      ->group(group);
  command.add_flag("--campbell", campbell, "nothing but the damped modes over the speed")
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
         : !forces.empty()   ? "shake"
         : !ground.empty()   ? "ground"
         : !coupling.empty() ? "cross-coupling"
         : !alford.empty()   ? "alford"
         : rotors > 0        ? "scatter"
         : campbell          ? "campbell"
                             : "";
}

}  // namespace ambrig
