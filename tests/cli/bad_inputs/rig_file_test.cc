// Every number of a rig file and of every effect, wrong in every way that its table row forbids:
// wrong type, below and above the range, nan, inf, a misspelt key, a spread beyond all bounds.
#include <fmt/format.h>

#include "effects/catalogue.h"
#include "rig/rig_assembly.h"
#include "rig/rig_file.h"
#include "tests/cli/bad_inputs/bad_input.h"
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

/// Number of a key as the rows below write it, so that one key can be replaced.
using Keys = std::vector<std::pair<std::string, std::string>>;

template <class P, std::size_t n>
void AddFields(const std::string& path, const Keys& given, const Field<P> (&fields)[n],
               const std::function<std::string(const Keys&)>& file, std::vector<BadInput>& out) {
  for (const Field<P>& f : fields) {
    const std::string key(f.key);
    const auto with = [&](const std::string& value) {
      Keys keys;
      bool found = false;
      for (const auto& [k, v] : given) {
        keys.emplace_back(k, k == key ? value : v);
        found = found || k == key;
      }
      if (!found) keys.emplace_back(key, value);
      return file(keys);
    };
    for (const BadValue& bad : BadValues(f.lo, f.hi))
      out.push_back({path + "." + key + " " + bad.kind,
                     with(bad.toml),
                     {"rig.toml:", path + "." + key, "allowed"}});
    Keys misspelt = given;
    misspelt.emplace_back(key + "x", "1.0");
    out.push_back({path + "." + key + " misspelt",
                   file(misspelt),
                   {"rig.toml:", path + "." + key + "x", "unknown key"}});
  }
}

std::string Table(const std::string& head, const Keys& keys) {
  std::string text = head.empty() ? "" : "[" + head + "]\n";
  for (const auto& [k, v] : keys) text += k + " = " + v + "\n";
  return text + "\n";
}

/// A rig whose every table is written out.
struct RigText {
  Keys rotor{{"mass", "4.2"},
             {"inertia_transverse", "0.036"},
             {"inertia_polar", "0.0042"},
             {"journal_radius", "0.03"}};
  Keys amplifier{{"bus_voltage", "30.0"},
                 {"switch_drop", "0.125"},
                 {"diode_drop", "0.7"},
                 {"switching_frequency", "25000.0"},
                 {"kp", "4.0"},
                 {"ki", "2000.0"},
                 {"adc_samples_per_period", "18"},
                 {"adc_bits", "12"},
                 {"adc_range", "10.0"},
                 {"current_noise", "0.004"},
                 {"i_max", "6.0"},
                 {"adc_jitter", "2e-8"},
                 {"edge_jitter", "2e-8"},
                 {"edge_spread", "5e-8"},
                 {"current_gain_spread", "0.005"},
                 {"unit", "3"}};
  Keys pid{{"kp", "4.0e5"},
           {"kd", "900.0"},
           {"ki", "6.0e6"},
           {"derivative_time_constant", "1.5e-4"},
           {"f_max", "60.0"}};
  Keys controller{{"rate", "12500.0"}, {"bias_current", "2.0"}};
  Keys radial{{"turns", "50"},
              {"pole_area", "2.0372e-4"},
              {"gap", "4.0e-4"},
              {"leakage_inductance", "3.5e-4"},
              {"resistance", "0.5"}};
  Keys sensor{{"z", "-0.135"}, {"noise", "2.0e-7"}};
  Keys auxiliary{{"clearance", "2.0e-4"},
                 {"stiffness", "2.0e7"},
                 {"exponent", "1.0"},
                 {"damping", "0.5"},
                 {"friction", "0.15"}};
  Keys thrust{{"turns", "80"},       {"pole_area", "4.0e-4"},
              {"gap", "5.0e-4"},     {"leakage_inductance", "3.0e-4"},
              {"resistance", "0.6"}, {"bias_current", "1.5"}};

  std::string Text() const {
    Keys both = controller;
    both.insert(both.end(), pid.begin(), pid.end());
    return Table("rotor", rotor) + Table("amplifier", amplifier) + Table("controller", both) +
           "[bearings.A]\nz = -0.12\n" + Table("", radial) + Table("bearings.A.sensor", sensor) +
           Table("bearings.A.auxiliary", auxiliary) +
           "[bearings.B]\nlike = \"A\"\nz = 0.13\nsensor = { z = 0.145, noise = 2e-7 }\n\n"
           "[bearings.Z]\nkind = \"thrust\"\nsensor = { noise = 2e-7 }\n" +
           Table("", thrust) + Table("bearings.Z.controller", pid);
  }
};

void Read(const std::string& text) { ReadRigText(text, "rig.toml"); }

TEST(BadRigInputs, TheRigItselfIsGood) { EXPECT_NO_THROW(Read(RigText().Text())); }

TEST(BadRigInputs, EveryNumberOfEveryTable) {
  std::vector<BadInput> all;
  const RigText good;
  const auto add = [&](const std::string& path, Keys RigText::*member, const auto& fields) {
    AddFields(
        path, good.*member, fields,
        [&](const Keys& keys) {
          RigText rig = good;
          rig.*member = keys;
          return rig.Text();
        },
        all);
  };
  add("rotor", &RigText::rotor, kRotorFields);
  add("amplifier", &RigText::amplifier, kAmplifierFields);
  add("amplifier", &RigText::amplifier, kAmplifierErrorFields);
  add("controller", &RigText::controller, kControllerFields);
  add("controller", &RigText::pid, kPidFields);
  add("bearings.A", &RigText::radial, kRadialStatorFields);
  add("bearings.A.sensor", &RigText::sensor, kSensorFields);
  add("bearings.A.auxiliary", &RigText::auxiliary, kAuxiliaryFields);
  add("bearings.Z", &RigText::thrust, kThrustStatorFields);
  EXPECT_GE(ExpectRefused(all, Read), 400U);
}

TEST(BadRigInputs, EveryParameterOfEveryEffect) {
  const std::string rig = RigText().Text();
  const EffectTargets known = TargetsOfEffects(ReadRigText(rig, "rig.toml"));
  std::vector<BadInput> all;
  for (const EffectDescription& d : Catalogue()) {
    const std::vector<std::string> targets = TargetsOf(d, known);
    if (d.id == "formula" || targets.empty()) continue;
    const std::string head =
        fmt::format("[[effect]]\nname = \"{}\"\ntarget = \"{}\"\n", d.id, targets[0]);
    for (const EffectParameter& p : d.parameters) {
      for (const BadValue& bad : BadValues(p.lo, p.hi)) {
        if (bad.kind.ends_with("inf") && std::isinf(p.null_value)) continue;
        all.push_back({d.id + "." + p.name + " " + bad.kind,
                       fmt::format("{}{}parameters = {{ {} = {} }}\n", rig, head, p.name, bad.toml),
                       {"rig.toml:", "effect[1].parameters." + p.name, "allowed"}});
      }
      all.push_back({d.id + "." + p.name + " misspelt",
                     fmt::format("{}{}parameters = {{ {}x = 1.0 }}\n", rig, head, p.name),
                     {"rig.toml:", "effect[1].parameters." + p.name + "x", "unknown key"}});
    }
    all.push_back({d.id + " target",
                   rig + Replaced(head, targets[0], "Q.q"),
                   {"rig.toml:", "effect[1].target", "allowed"}});
  }
  EXPECT_GE(ExpectRefused(all, Read), 250U);
}

TEST(BadRigInputs, Spreads) {
  std::vector<BadInput> all;
  for (const std::string key : {"mass", "inertia_transverse", "journal_radius"})
    for (const std::string sd : {"1e300", "-1.0", "nan", "inf", "\"one\"", "true"}) {
      RigText rig;
      for (auto& [k, v] : rig.rotor)
        if (k == key) v = "{ value = " + v + ", sd = " + sd + " }";
      all.push_back({"sd of " + key + " " + sd,
                     rig.Text(),
                     {"rig.toml:", "rotor." + key + ".sd", "allowed"}});
    }
  RigText gap;
  gap.radial[2].second = "{ value = 4.0e-4, sd = 4.0e-3 }";  // of ten gaps
  all.push_back({"sd of the gap",
                 gap.Text(),
                 {"rig.toml:", "bearings.A.gap.sd = 0.004 m", "allowed 0 to 0.0004 m"}});
  ExpectRefused(all, Read);
}

/// Values that are each in range and contradict another.
TEST(BadRigInputs, Contradictions) {
  const std::string rig = RigText().Text();
  const std::vector<BadInput> all{
      {"gravity",
       "gravity = [0, -1e308, 0]\n" + rig,
       {"rig.toml:1: gravity", "-1000 to 1000 m/s2"}},
      {"bias",
       Replaced(rig, "bias_current = 2.0", "bias_current = 7.0"),
       {"controller.bias_current = 7 A", "allowed: at most the amplifier's i_max = 6 A"}},
      {"thrust bias",
       Replaced(rig, "bias_current = 1.5", "bias_current = 9.0"),
       {"bearings.Z.bias_current = 9 A", "i_max = 6 A"}},
      {"winding",
       Replaced(rig, "turns = 50", "turns = 50\nwinding = \"NNNNNNNN\""),
       {"bearings.A.winding", "both letters N and S"}},
      {"sensor",
       Replaced(rig, "z = -0.135", "z = 50.0"),
       {"bearings.A.sensor", "50 m", "allowed: on the shaft"}},
      {"force", Replaced(rig, "f_max = 60.0", "f_max = 1e-10"), {"controller.f_max", "allowed"}},
      {"force that moves nothing",
       Replaced(rig, "f_max = 60.0", "f_max = 1e-9"),
       {"controller.f_max = 1e-09 N", "allowed: at least"}},
      {"effect twice",
       rig + "[[effect]]\nname = \"sensor-gain\"\ntarget = \"A.x\"\nparameters = { gain = 1.01 }\n"
             "[[effect]]\nname = \"sensor-gain\"\ntarget = \"A.x\"\nparameters = { gain = 1.02 }\n",
       {"effect[2].name = \"sensor-gain\" on A.x stands twice", "allowed: once"}},
      {"zero byte", "name = \"a\\u0000b\"\n" + rig, {"rig.toml:1: name", "control character 0"}},
      {"formula left",
       rig + "[[effect]]\nname = \"formula\"\ntarget = \"A\"\n"
             "force = { x = \"sqrt(x)\" }\n",
       {"force.x = \"sqrt(x)\"", "at x = y = -1e-5 m", "allowed -100000000 to 100000000 N"}},
      {"formula volts",
       rig + "[[effect]]\nname = \"formula\"\ntarget = \"A.coil1\"\n"
             "voltage = \"1e9\"\n",
       {"voltage = \"1e9\"", "1000000000 V", "allowed -100000 to 100000 V"}},
      {"long formula",
       rig + "[[effect]]\nname = \"formula\"\ntarget = \"A\"\nforce = { x = \"" +
           std::string(5000, '(') + "\" }\n",
       {"force.x"}},
  };
  ExpectRefused(all, [](const std::string& text) {
    try {
      Read(text);
    } catch (const InputError& e) {
      EXPECT_LT(std::string(e.what()).size(), 500U) << e.what();
      throw;
    }
  });
}

}  // namespace
}  // namespace ambrig
