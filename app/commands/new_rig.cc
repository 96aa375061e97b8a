/// The rig file that `ambrig new` writes: the answers in the template's text, and the numbers that
/// follow.
#include <fmt/args.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/commands/new_templates.h"
#include "core/base/errors.h"
#include "core/base/toml_edit.h"
#include "core/math/constants.h"
#include "rig/nominal_control.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"
#include "rig/rig_file.h"

namespace ambrig {

namespace {

constexpr double kFree = 9.81;  // [m/s2]

struct PositionGains {
  double kp, kd, ki, tau, f_max;
};

/// Three times the negative stiffness, 0.7 of critical damping, the integral a decade below.
PositionGains GainsOf(double stiffness, double mass, double rate, double f_max) {
  const double least = mass * std::pow(2 * kPi * 1, 2);  // as of a suspension of 1 Hz
  const double ks = std::max(stiffness, least);
  PositionGains g{};
  g.kp = 3 * ks;
  const double omega = std::sqrt((g.kp - ks) / mass);
  g.kd = 2 * 0.7 * omega * mass;
  g.ki = 0.1 * omega * g.kp;
  g.tau = std::max(1 / (10 * omega), 1.5 / rate);
  g.f_max = f_max;
  return g;
}

/// Round to four digits: a file for people.
double Rounded(double v) { return v == 0 ? 0 : std::stod(fmt::format("{:.4g}", v)); }

void AddFollowing(const BenchTemplate& bench, BenchAnswers& a) {
  const auto has = [&](const char* key) { return a.contains(key); };
  a["bandwidth"] = 0.05 * a["switching_frequency"];
  a["adc_range"] = 1.5 * a["i_max"];
  a["current_noise"] = 1e-3 * a["i_max"];
  a["bus_noise"] = 7e-4 * a["bus_voltage"];
  a["period"] = 1 / a["switching_frequency"];
  a["sensor_noise"] = 5e-4 * a["gap"];
  a["gap_sd"] = 0.02 * a["gap"];
  a["resistance_sd"] = 0.02 * a["resistance"];
  if (bench.one_axis) {
    a["far_sd"] = 0.1 * a["inductance_far"];
    a["near_sd"] = 0.1 * a["inductance_near"];
    a["constant_sd"] = 0.1 * a["gap_constant"];
    return;
  }
  a["inertia_polar"] = 0.1 * a["inertia_transverse"];
  a["journal_radius"] = 0.05 * a["span"];
  a["za"] = -0.5 * a["span"];
  a["zb"] = 0.5 * a["span"];
  a["clearance"] = 0.5 * a["gap"];
  a["leakage"] = 0.1 * kMu0 * a["turns"] * a["turns"] * a["pole_area"] / a["gap"];
  a["loop_kp"] = 1.2 * a["leakage"] * a["switching_frequency"];
  a["loop_ki"] = a["loop_kp"] * a["resistance"] / (10 * a["leakage"]);
  a["quadrants"] = has("magnet_mmf") ? 4 : 2;
  if (!has("thrust_turns")) return;
  a["thrust_leakage"] =
      0.05 * kMu0 * a["thrust_turns"] * a["thrust_turns"] * a["thrust_area"] / a["thrust_gap"];
  a["thrust_clearance"] = 0.5 * a["thrust_gap"];
}

std::string Filled(std::string_view text, const BenchAnswers& a) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    if (text.substr(at, 2) == "{{" || text.substr(at, 2) == "}}") {
      out += text[at];
      at += 2;
      continue;
    }
    if (text[at] != '{') {
      out += text[at++];
      continue;
    }
    const std::size_t end = text.find('}', at);
    const auto value = a.find(text.substr(at + 1, end - at - 1));
    Require(value != a.end(), "every name of a template has a value");
    const bool whole = value->first == "quadrants";
    out += whole ? fmt::format("{:.0f}", value->second) : TomlNumber(Rounded(value->second));
    at = end + 1;
  }
  return out;
}

std::string Assembled(const BenchTemplate& bench, const BenchAnswers& a, const PositionGains& g,
                      double bias) {
  std::string text = fmt::format(
      "# made by ambrig new: template {}\nname = \"{}\"\ngravity = [0.0, -9.81, 0.0]\n\n",
      bench.name, bench.name);
  text += Filled(bench.rotor, a) + "\n" + Filled(bench.amplifier, a);
  text += fmt::format(
      "\n[controller]                           # gains from the magnets' negative stiffness k_s:\n"
      "kind = \"pid\"                           # kp = 3 k_s, 0.7 of critical damping, ki a decade "
      "below\nrate = {}\nkp = {}\nkd = {}\nki = {}\nderivative_time_constant = {}\nf_max = "
      "{}\nbias_current = {}\n\n",
      TomlNumber(a.find("controller_rate")->second), TomlNumber(Rounded(g.kp)),
      TomlNumber(Rounded(g.kd)), TomlNumber(Rounded(g.ki)), TomlNumber(Rounded(g.tau)),
      TomlNumber(Rounded(g.f_max)), TomlNumber(Rounded(bias)));
  return text + Filled(bench.bearings, a);
}

/// Negative stiffness and largest linear force of bearing k.
std::pair<double, double> MagnetOf(const NominalRig& rig, std::size_t k) {
  const BearingParameters& b = rig->bearings[k];
  const CurrentMap map = MakeBearingControl(rig, k).map;
  const StatorGeometry g = b.kind->stator(b);
  if (g.network) {
    const Eigen::VectorXd bias = map.c0 * map.W.col(0).head(g.coils);
    const double ks =
        g.network->NegativeStiffness(Eigen::Vector3d::Zero(), bias).topLeftCorner<2, 2>().norm() /
        std::sqrt(2.0);
    const double room = map.unipolar ? std::min(map.c0, map.i_max - map.c0) : 0.8 * map.i_max;
    return {ks, map.k * map.c0 * room};
  }
  return {map.k * map.c0 * map.c0 / g.gap_offset[0],
          map.k * map.c0 * std::min(map.c0, map.i_max - map.c0)};
}

void SetAxial(BenchAnswers& a, const PositionGains& g) {
  a["z.kp"] = g.kp;
  a["z.kd"] = g.kd;
  a["z.ki"] = g.ki;
  a["z.tau"] = g.tau;
  a["z.f_max"] = g.f_max;
}

std::string OneAxisText(const BenchTemplate& bench, const BenchAnswers& a) {
  const auto at = [&](const char* key) { return a.find(key)->second; };
  const double gc = at("gap_constant"), g = at("gap"), mass = at("mass");
  // f = i² L0 gc/(2 (gc + g)²) carries the weight; its slope along the gap is 2 f/(gc + g).
  const double bias = (gc + g) * std::sqrt(2 * mass * kFree / (at("inductance_near") * gc));
  if (bias > 0.9 * at("i_max"))
    throw InputError(
        fmt::format("i_max = {} A: the body hovers at {:.3g} A, allowed: more, or "
                    "other inductances and gap",
                    at("i_max"), bias));
  return Assembled(
      bench, a, GainsOf(2 * mass * kFree / (gc + g), mass, at("controller_rate"), 5 * mass * kFree),
      bias);
}

}  // namespace

std::string RigTextOf(const BenchTemplate& bench, const BenchAnswers& answers) {
  BenchAnswers a = answers;
  AddFollowing(bench, a);
  if (bench.one_axis) return OneAxisText(bench, a);
  const bool thrust = a.contains("thrust_turns");
  const double bias = a.contains("bias_current") ? a["bias_current"] : 0.5 * a["i_max"];
  const double mass = a["mass"], rate = a["controller_rate"];
  // First with any gains: the rig itself says how its magnets pull.
  const PositionGains any{1e5, 100, 1e5, 1e-3, mass * kFree};
  SetAxial(a, any);
  const NominalRig rig(ReadRigText(Assembled(bench, a, any, bias), "the new rig"));
  if (thrust) {
    const auto [ks, f] = MagnetOf(rig, rig->bearings.size() - 1);
    SetAxial(a, GainsOf(ks, mass, rate, f));
  }
  const auto [ks, f] = MagnetOf(rig, 0);
  if (f < mass * kFree / 2)
    throw InputError(
        fmt::format("the bearings pull {:.3g} N each and would carry {:.3g} N, allowed: "
                    "more turns, area, bias or i_max, or a smaller gap or mass",
                    f, mass * kFree / 2));
  return Assembled(bench, a, GainsOf(ks, mass / 2, rate, f), bias);
}

}  // namespace ambrig
