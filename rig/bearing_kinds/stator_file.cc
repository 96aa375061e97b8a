#include "rig/bearing_kinds/stator_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "control/current/bias_linearisation.h"
#include "core/base/toml_checked.h"

namespace ambrig {

namespace {

constexpr Range kTurns{"-", -1e4, 1e4, "signed turns of the coil on this pole"};
constexpr Range kBias{"A", 0, 1e3, "of every coil"};
constexpr double kBalanced = 1e-6;   // of a coil's pull: net force of the bias
constexpr double kLeastGain = 0.02;  // of the force per current of the weakest direction

/// "coil3" or "3" -> 2.
int CoilNumber(const TomlTable& turns, const std::string& key) {
  const std::string digits = key.starts_with("coil") ? key.substr(4) : key;
  int n = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), n);
  if (error != std::errc() || end != digits.data() + digits.size() || n < 1 || n > kLanes)
    turns.Fail(key,
               fmt::format("names no coil, allowed: coil1 to coil{} (or 1 to {})", kLanes, kLanes));
  return n - 1;
}

BiasMagnet ReadMagnet(const TomlTable& t) {
  BiasMagnet m;
  t.Read(m, kBiasMagnetFields);
  t.RejectUnknownKeys();
  return m;
}

StatorPole ReadPole(const TomlTable& t, bool axial) {
  StatorPole pole;
  if (!axial && !t.Has("angle_deg")) t.Fail("angle_deg", "is missing, allowed: -720 to 720 deg");
  if (axial && !t.Has("side")) t.Fail("side", "is missing, allowed: 1 (pulls towards +z) or -1");
  t.Read(pole, kStatorPoleFields);
  if (axial && (std::abs(pole.side) != 1 || t.Has("angle_deg") || t.Has("cone_deg")))
    t.Fail("side", "of an axial stator's pole, allowed: 1 or -1, without angle_deg and cone_deg");
  if (!axial && t.Has("side")) t.Fail("side", "is of kind = \"axial-stator\" only");
  if (pole.plane != std::floor(pole.plane))
    t.Fail("plane", fmt::format("= {}, allowed: an integer", pole.plane));
  if (const auto turns = t.Table("turns")) {
    for (const std::string& key : turns->Keys())
      pole.turns[CoilNumber(*turns, key)] = Within(*turns, key, kRequired, kTurns);
    turns->RejectUnknownKeys();
  }
  if (const auto magnet = t.Table("bias")) pole.magnet = ReadMagnet(*magnet);
  t.RejectUnknownKeys();
  return pole;
}

void ReadTemplate(const TomlTable& t, StatorParameters& p, std::vector<Tolerance>* tolerances) {
  p.pattern = t.Choice("template", p.pattern, StatorTemplateNames(p.axial));
  const StatorTemplate& pattern = *FindStatorTemplate(p.pattern);
  t.Read(p, kStatorTemplateFields, tolerances);
  const auto count = static_cast<int>(
      t.Integer("poles", static_cast<long long>(p.pole_count > 0 ? p.pole_count : pattern.poles)));
  if (t.Has("poles") && (pattern.poles == 0 || count < pattern.least || count > pattern.most ||
                         count % pattern.multiple != 0))
    t.Fail("poles", pattern.poles == 0
                        ? fmt::format("= {}, allowed: none, template {} has {}", count,
                                      pattern.name, pattern.least)
                        : fmt::format("= {}, allowed: {} to {} in steps of {}", count,
                                      pattern.least, pattern.most, pattern.multiple));
  p.pole_count = pattern.poles == 0 ? 0 : count;
  p.winding = t.String("winding", p.winding);
  if (p.winding.find_first_not_of("NS") != std::string::npos)
    t.Fail("winding",
           fmt::format("= \"{}\", allowed: letters N and S, repeated over the poles", p.winding));
  const std::string words = pattern.connections;
  if (words.empty() && t.Has("coils"))
    t.Fail("coils", fmt::format("is not a key of template {}", pattern.name));
  if (!words.empty())
    p.connection = t.Choice(
        "coils", p.connection.empty() ? words.substr(0, words.find(',')) : p.connection, words);
  p.bias_in_poles = p.pattern == "heteropolar-pm";
  constexpr Range kAngle{"deg", -360, 360, "of pole 1 from the x axis"};
  if (t.Has("first_pole_angle_deg"))
    p.first_pole_angle_deg = Within(t, "first_pole_angle_deg", kRequired, kAngle);
  if (p.pattern == "conical") {
    constexpr Range kCone{"deg", -80, 80, "of the gap's normal out of the plane"};
    p.cone_deg = Within(t, "cone_deg", p.cone_deg != 0 ? p.cone_deg : kRequired, kCone);
  }
  if (const auto bias = t.Table("bias"); pattern.magnet && bias && p.bias.mmf == 0)
    t.Fail("bias", bias->Has("mmf") ? "has mmf = 0 A, allowed: any but 0"
                                    : "has no mmf, allowed: { mmf = A, length = m, area = m2 }");
  if (pattern.magnet && p.bias.mmf == 0)
    t.Fail("bias", "is missing, allowed: { mmf = A, length = m, area = m2, mu_r = 1.05 }");
}

void CheckPlanes(const TomlTable& t, const std::vector<StatorPole>& poles) {
  int planes = 0;
  for (const StatorPole& p : poles) planes = std::max(planes, static_cast<int>(p.plane));
  for (int k = 1; k <= planes; ++k)
    if (std::none_of(poles.begin(), poles.end(), [&](const auto& p) { return p.plane == k; }))
      t.Fail("poles",
             fmt::format("have no plane {} but a plane {}, allowed: numbers from 1 without "
                         "a hole",
                         k, planes));
}

void ReadPoles(const TomlTable& t, StatorParameters& p) {
  for (const char* key : {"turns", "pole_area", "gap", "winding", "coils", "first_pole_angle_deg"})
    if (t.Has(key)) t.Fail(key, "is a key of a template, allowed here: poles, each with its own");
  p.poles.clear();
  p.pattern.clear();
  for (const TomlTable& pole : t.Tables("poles")) p.poles.push_back(ReadPole(pole, p.axial));
  if (p.poles.empty() || p.poles.size() > kMostPoles)
    t.Fail("poles", fmt::format("has {} poles, allowed: 1 to {}", p.poles.size(), kMostPoles));
  CheckPlanes(t, p.poles);
}

}  // namespace

double BiasOf(const StatorParameters& p, double bias) {
  if (!std::isnan(p.bias_current)) return p.bias_current;
  return NetworkOf(p)->has_magnets() ? 0 : bias;
}

std::string StatorTemplateNames(bool axial) {
  std::string names;
  for (const StatorTemplate& s : StatorTemplates())
    if (s.axial == axial) names += (names.empty() ? "" : ", ") + std::string(s.name);
  return names;
}

void ReadStator(const TomlTable& t, bool axial, StatorParameters& p,
                std::vector<Tolerance>* tolerances) {
  p.axial = axial;
  if (const auto magnet = t.Table("bias")) {
    p.bias = ReadMagnet(*magnet);
  }
  const bool listed = t.Has("poles") && t.IsArray("poles");
  if (listed && t.Has("template"))
    t.Fail("template", "stands beside poles = [...], allowed: one of the two");
  if (listed)
    ReadPoles(t, p);
  else if (t.Has("template") || !p.pattern.empty())
    ReadTemplate(t, p, tolerances);
  else if (p.poles.empty())
    t.Fail("poles", fmt::format("is missing, allowed: poles = [{{ {}, area, gap, turns = {{ coil1 "
                                "= n }} }}, ...] or template = {}",
                                axial ? "side" : "angle_deg", StatorTemplateNames(axial)));
  t.Read(p, kStatorFields, tolerances);
  if (t.Has("bias_current")) p.bias_current = Within(t, "bias_current", kRequired, kBias);
  const std::vector<StatorPole> poles = PolesOf(p);
  const int coils = ambrig::CoilsOf(poles);
  if (coils < 1 || coils > kLanes)
    t.Fail("poles",
           fmt::format("have {} coils, allowed: 1 to {} of a bearing that runs", coils, kLanes));
  const auto network = NetworkOf(p);
  for (int j = 0; j < coils; ++j)
    if (network->TurnsOf(j) == 0)
      t.Fail("poles", fmt::format("have no turns of coil {}, allowed: coils 1 to {} without a hole",
                                  j + 1, coils));
}

void CheckStator(const TomlTable& t, const StatorParameters& p, double bias, bool unipolar) {
  const auto network = NetworkOf(p);
  const double own = BiasOf(p, bias);
  const int axes = p.axial ? 1 : 2;
  const BiasLinearisation at = LineariseAtBias(*network, own, axes);
  if (unipolar && !(own > 0))
    t.Fail("bias_current",
           "= 0 A with bridges that drive one direction of the current, allowed: "
           "quadrants = 4 in [amplifier], or a bias current");
  if (!(at.condition > kLeastGain))
    t.Fail("bias_current",
           fmt::format("= {} A: the currents do not move the force in all directions about it, "
                       "allowed: coils and a bias (current or magnet) that do",
                       own));
  double scale = 0;
  const auto J = network->ForceOfCurrent(Eigen::Vector3d::Zero(),
                                         Eigen::VectorXd::Constant(network->coils(), own));
  for (int j = 0; j < network->coils(); ++j) scale += J.col(j).head(axes).norm() * at.c0;
  if (at.bias_force.head(axes).norm() > kBalanced * scale)
    t.Fail("poles", fmt::format("pull the centred rotor with ({:.4g}, {:.4g}) N by their bias "
                                "alone, allowed: angles, turns and magnets that balance",
                                at.bias_force.x(), axes > 1 ? at.bias_force.y() : 0.0));
}

}  // namespace ambrig
