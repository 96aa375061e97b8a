#include "rotor/shaft/ross_magnets.h"

#include <algorithm>

#include "core/math/constants.h"
#include "rotor/shaft/shaft_file.h"

namespace ambrig {

namespace {

constexpr double kMagneticConstant = 4e-7 * kPi;
// What ROSS does not say.
constexpr double kAssumedSwitching = 25000, kAssumedRate = 12500;         // [Hz]
constexpr double kCopper = 1.72e-8, kAssumedDensity = 5e6;                // [ohm m], [A/m2]
constexpr double kAssumedLeakage = 0.1, kAssumedSlew = 2 * kPi * 1000.0;  // of L; bias in 1/this

double RossAxisValue(const RossElement& e, const char* key, double fallback,
                     std::vector<std::string>& lost) {
  if (!e.Has(key)) return fallback;
  const std::vector<double>& both = e.numbers.at(key);
  if (both.size() > 1 && both[1] != both[0])
    lost.push_back(fmt::format("{}: {} of y = {:g}, taken as that of x", e.Label(), key, both[1]));
  return both[0];
}

/// What a coil of it is taken to be.
struct AssumedCoil {
  double inductance = 0, resistance = 0;  // [H], [ohm]
};

AssumedCoil CoilOf(const RossMagnet& m) {
  const double pole = m.turns / 2;
  return {kMagneticConstant * pole * pole * m.area / m.gap,
          kCopper * 4 * std::sqrt(m.area) * pole * kAssumedDensity / m.bias};
}

std::string MagnetText(const RossMagnet& m, double first_bias) {
  const AssumedCoil coil = CoilOf(m);
  const double gain = m.current_gain();
  const double lag = m.cutoff > 0 ? 1 / m.cutoff : 1e-4;
  return fmt::format(
      "\n[bearings.{}]\nkind = \"radial\"\nz = {}\nwinding = \"NSNSNSNS\"\nturns = {}\n"
      "pole_area = {}\ngap = {}\nleakage_inductance = {:.3g}   # assumed: a tenth of a pole's own\n"
      "resistance = {:.3g}           # assumed: copper at 5 A/mm2\n"
      "sensor = {{ z = {}, noise = {:.3g} }}   # assumed: at the bearing, 5e-4 of the gap\n"
      "auxiliary = {{ clearance = {:.3g}, stiffness = 1.0e7, damping = 0.5, friction = 0.15 }}   # "
      "assumed\n[bearings.{}.controller]\nkp = {}\nki = {}\nkd = {}\n"
      "derivative_time_constant = {}\nf_max = {:.4g}   # assumed: the bias, once more\n{}",
      m.name, m.z, m.turns / 2, m.area, m.gap, kAssumedLeakage * coil.inductance, coil.resistance,
      m.z, 5e-4 * m.gap, 0.5 * m.gap, m.name, gain * m.kp, gain * m.ki, gain * m.kd, lag,
      gain * m.bias,
      m.bias != first_bias ? fmt::format("bias_current = {}\n", m.bias) : std::string());
}

std::string DrivesText(const std::vector<RossMagnet>& magnets) {
  double volts = 12, most = 0, gain = 0, integral = 0;
  for (const RossMagnet& m : magnets) {
    const AssumedCoil coil = CoilOf(m);
    volts = std::max(volts, m.bias * (coil.inductance * kAssumedSlew + coil.resistance));
    most = std::max(most, 2 * m.bias);
    gain = std::max(gain, 1.2 * kAssumedLeakage * coil.inductance * kAssumedSwitching);
    integral = std::max(integral, 0.1 * gain * coil.resistance / coil.inductance);
  }
  const RossMagnet& m = magnets.front();
  return fmt::format(
      "\n# ROSS says nothing of amplifiers and sampling: assumed.\n[amplifier]\n"
      "modulation = \"bi-state\"\nbus_voltage = {:.3g}\nswitching_frequency = {:.1f}\n"
      "kp = {:.4g}\nki = {:.4g}\nadc_samples_per_period = 18\nadc_bits = 12\nadc_range = {:.4g}\n"
      "current_noise = {:.3g}\ni_max = {:.4g}   # twice the bias\n\n"
      "[controller]\nkind = \"pid\"\nrate = {:.1f}\nbias_current = {}\nkp = {}\nki = {}\nkd = {}\n"
      "derivative_time_constant = {}\nf_max = {:.4g}\n",
      std::ceil(volts), kAssumedSwitching, gain, integral, 1.5 * most, 1e-3 * most, most,
      kAssumedRate, m.bias, m.current_gain() * m.kp, m.current_gain() * m.ki,
      m.current_gain() * m.kd, m.cutoff > 0 ? 1 / m.cutoff : 1e-4, m.current_gain() * m.bias);
}

}  // namespace

double RossMagnet::current_gain() const {
  return kMagneticConstant * turns * turns * area * bias * std::cos(alpha) / (gap * gap);
}

bool IsRossMagneticBearing(const RossElement& e) {
  return e.kind.find("MagneticBearing") == 0 || (e.Has("g0") && e.Has("nw"));
}

RossMagnet ReadRossMagnet(const RossElement& e, std::vector<std::string>& lost) {
  RossMagnet m;
  m.name = e.name;
  for (char& c : m.name)
    if (c == ' ' || c == '.' || c == '\t') c = '_';
  const auto value = [&](const char* key, double fallback) {
    return RossAxisValue(e, key, fallback, lost);
  };
  m.gap = value("g0", 0);
  m.bias = value("i0", 0);
  m.area = value("ag", 0);
  m.turns = value("nw", 0);
  m.alpha = value("alpha", kPi / 8);
  const double both = value("k_amp", 1) * value("k_sense", 1);
  m.kp = both * value("kp_pid", 0);
  m.kd = both * value("kd_pid", 0);
  m.ki = both * value("ki_pid", 0);
  m.cutoff = value("n_f", 10000);
  if (!(m.gap > 0 && m.bias > 0 && m.area > 0 && m.turns > 0))
    e.Fail(fmt::format("g0 = {:g} m, i0 = {:g} A, ag = {:g} m2, nw = {:g}, allowed: above 0", m.gap,
                       m.bias, m.area, m.turns));
  if (std::abs(m.alpha - kPi / 8) > 2e-3)
    lost.push_back(
        fmt::format("{}: alpha = {:g} rad, poles stand every 45 degrees here", e.Label(), m.alpha));
  if (m.kp == 0 && m.kd == 0 && m.ki == 0)
    lost.push_back(e.Label() + ": its controller (a transfer function is not in ROSS's file)");
  return m;
}

std::string NoRigShaft(const BeamDefinition& d) {
  if (!d.shafts.empty()) return "several shafts";
  if (!d.housings.empty()) return "housings";
  for (const SpringSupport& s : d.supports)
    if (s.has_mass()) return "added masses of supports";
  for (const ShaftSection& s : d.sections)
    if (s.axial_force != 0 || s.torque != 0) return "axial forces or torque";
  return "";
}

std::string MagneticRigText(const BeamFile& shaft, std::vector<RossMagnet> magnets) {
  double journal = 0;
  for (RossMagnet& m : magnets) m.alpha = kPi / 8;  // as the rig's own poles stand
  for (const ShaftSection& s : shaft.definition.sections)
    if (s.stiff && s.z0 <= magnets.front().z && magnets.front().z <= s.z0 + s.length)
      journal = std::max(journal, s.od / 2);
  std::string text = BeamText(shaft);
  const std::string kind = "kind = \"beam\"\n";
  text.insert(text.find(kind) + kind.size(),
              fmt::format("journal_radius = {}   # the shaft's own\n", journal));
  text =
      "# From a ROSS file: shaft, magnets and gains are its own.\ngravity = [0.0, -9.81, 0.0]\n\n" +
      text + DrivesText(magnets);
  for (const RossMagnet& m : magnets) text += MagnetText(m, magnets.front().bias);
  return text;
}

std::vector<RossMagnet> MagnetsOfRig(const std::string& rig_file, std::vector<std::string>& lost) {
  std::vector<RossMagnet> out;
  const TomlTable root = TomlTable::FromFile(rig_file);
  if (!root.IsTable("bearings")) return out;
  const TomlTable bearings = *root.Table("bearings");
  for (const std::string& name : bearings.Keys()) {
    if (!bearings.IsTable(name)) continue;
    const TomlTable t = *bearings.Table(name);
    std::vector<TomlTable> control;  // its own first
    if (t.IsTable("controller")) control.push_back(*t.Table("controller"));
    if (root.IsTable("controller")) control.push_back(*root.Table("controller"));
    const auto gain = [&](const char* key) {
      for (const TomlTable& c : control)
        if (c.IsNumber(key)) return c.Number(key);
      return 0.0;
    };
    bool horseshoes = !t.IsString("kind") || t.String("kind") == "radial";
    if (t.IsString("winding")) horseshoes = horseshoes && t.String("winding") == "NSNSNSNS";
    for (const char* key : {"z", "turns", "pole_area", "gap"})
      horseshoes = horseshoes && t.IsNumber(key);
    if (!horseshoes || !(gain("bias_current") > 0)) {
      lost.push_back(
          fmt::format("bearings.{}: no magnetic bearing of ROSS's kind (eight poles NSNSNSNS "
                      "of one area, bias current)",
                      name));
      continue;
    }
    RossMagnet m;
    m.name = name;
    m.z = t.Number("z");
    m.gap = t.Number("gap");
    m.area = t.Number("pole_area");
    m.turns = 2 * t.Number("turns");
    m.alpha = kPi / 8;
    m.bias = gain("bias_current");
    m.kp = gain("kp") / m.current_gain();
    m.ki = gain("ki") / m.current_gain();
    m.kd = gain("kd") / m.current_gain();
    if (const double lag = gain("derivative_time_constant"); lag > 0) m.cutoff = 1 / lag;
    out.push_back(m);
  }
  if (!out.empty())
    lost.push_back(
        "amplifiers, sampling, sensors, auxiliary bearings and limits of the magnetic bearings");
  return out;
}

}  // namespace ambrig
