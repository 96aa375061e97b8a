#include "app/json/analysis_json.h"

#include <cmath>

#include "analysis/iso14839.h"
#include "app/json/json_number.h"
#include "core/math/constants.h"

namespace ambrig {
namespace {

using Json = nlohmann::ordered_json;

Json Parts(const std::vector<std::complex<double>>& values) {
  Json re = Json::array(), im = Json::array();
  for (const auto& v : values) {
    re.push_back(v.real());
    im.push_back(v.imag());
  }
  return {{"re", re}, {"im", im}};
}

Json CapacityJson(const AxisCapacity& c) {
  return {{"axis", c.axis},
          {"k_i", c.k_i},
          {"k_s", c.k_s},
          {"static", c.usable()},
          {"linear", c.linear},
          {"largest", c.largest},
          {"f_max", c.commanded},
          {"weight", c.weight},
          {"slew", FiniteOrNull(c.slew)},
          {"knee", FiniteOrNull(c.knee)}};
}

Json JointJson(const JointMargin& m, const Sensitivity& s) {
  Json axes = Json::array(), gain = Json::array(), phase = Json::array();
  for (std::size_t k = 0; k < m.axes.size(); ++k) {
    axes.push_back(s.axes[m.axes[k]].axis);
    if (k >= m.factor.size()) continue;
    gain.push_back(FiniteOrNull(std::abs(m.factor[k])));
    phase.push_back(FiniteOrNull(std::arg(m.factor[k])));
  }
  return {{"axes", axes},
          {"disk_margin", FiniteOrNull(m.alpha)},
          {"gain_down", DiskGainDown(m.alpha)},
          {"gain_up", FiniteOrNull(DiskGainUp(m.alpha))},
          {"phase", DiskPhase(m.alpha)},
          {"frequency", m.frequency},
          {"reached", FiniteOrNull(m.reached)},
          {"worst_gain", gain},
          {"worst_phase", phase}};
}

Json SensitivityJson(const Sensitivity& s) {
  Json axes = Json::array();
  const auto of_stable = [&](double x) { return s.stable ? FiniteOrNull(x) : Json(nullptr); };
  for (const AxisSensitivity& a : s.axes)
    axes.push_back({{"axis", a.axis},
                    {"peak", of_stable(a.peak)},
                    {"frequency", of_stable(a.peak_frequency)},
                    {"zone", std::string(1, a.zone)},
                    {"gain_up", of_stable(a.gain_up)},
                    {"gain_down", of_stable(a.gain_down)},
                    {"phase_margin", of_stable(a.phase_margin)},
                    {"delay_margin", of_stable(a.delay_margin)},
                    {"disk_margin", of_stable(a.disk_margin)},
                    {"S", Parts(a.S)}});
  Json joint = Json::array();
  for (const JointMargin& m : s.joint) joint.push_back(JointJson(m, s));
  return {{"speed", s.speed},
          {"stable", s.stable},
          {"frequency", s.frequency},
          {"axes", axes},
          {"joint", joint}};
}

Json ModeJson(const ClosedLoopMode& m) {
  return {{"re", m.s.real()},
          {"im", m.s.imag()},
          {"frequency", m.frequency},
          {"zeta", m.zeta},
          {"log_decrement", m.log_decrement},
          {"whirl", SenseName(m.sense())},
          {"rotor_share", m.rotor_share}};
}

Json CampbellJson(const RigAnalysis& a) {
  Json rows = Json::array();
  for (const ClosedLoopModes& r : a.rows) {
    Json modes = Json::array();
    for (const ClosedLoopMode& m : r.modes)
      if (m.of_rotor()) modes.push_back(ModeJson(m));
    rows.push_back({{"speed", r.speed}, {"spectral_radius", r.spectral_radius}, {"modes", modes}});
  }
  return rows;
}

/// z as in the rig file: a beam's own axis; the model's counts from `origin`, its centre of mass.
Json RotorModesJson(const std::vector<RotorMode>& modes, double origin) {
  Json out = Json::array();
  for (const RotorMode& m : modes) {
    std::vector<double> z = m.z;
    for (double& v : z) v += origin;
    out.push_back({{"frequency", m.frequency}, {"z", z}, {"x", m.x}});
  }
  return out;
}

Json SupportsJson(const RotorOnSupports& s, double origin) {
  Json supports = Json::array(), critical = Json::array(), map = Json::array();
  for (const SupportStiffness& k : s.supports)
    supports.push_back({{"bearing", k.bearing},
                        {"proportional", k.proportional},
                        {"negative", k.negative},
                        {"net", k.net()}});
  for (const CriticalSpeed& c : s.critical)
    critical.push_back({{"speed", c.speed}, {"whirl", c.whirl}});
  for (const CriticalMapRow& row : s.map) {
    Json speeds = Json::array();
    for (const CriticalSpeed& c : row.speeds) speeds.push_back(c.speed);
    map.push_back({{"stiffness", row.stiffness}, {"speeds", speeds}});
  }
  return {{"supports", supports},
          {"free", RotorModesJson(s.free, origin)},
          {"supported", RotorModesJson(s.supported, origin)},
          {"critical", critical},
          {"map", map}};
}

Json UnbalanceJson(const UnbalanceSweep& s, double origin) {
  Json planes = Json::array(), tracks = Json::array();
  for (const PlaneUnbalance& p : s.unbalance.planes)
    planes.push_back({{"z", p.z + origin}, {"magnitude", p.magnitude}, {"phase", p.phase}});
  for (const OrderTrack& t : s.tracks) {
    Json peaks = Json::array();
    for (const ResponsePeak& p : t.peaks)
      peaks.push_back({{"speed", p.speed},
                       {"amplitude", p.amplitude},
                       {"amplification", p.amplification},
                       {"bound", p.bound}});
    tracks.push_back({{"bearing", t.bearing},
                      {"amplitude", t.amplitude},
                      {"phase", t.phase},
                      {"force", t.force},
                      {"peaks", peaks}});
  }
  return {{"case", s.unbalance.name}, {"planes", planes}, {"speed", s.speed}, {"tracks", tracks}};
}

template <class Items, class Make>
Json ListJson(const Items& items, Make&& make) {
  Json out = Json::array();
  for (const auto& item : items) out.push_back(make(item));
  return out;
}

Json StandardsJson(const RigAnalysis& a) {
  return {{"displacement", ListJson(a.displacement,
                                    [](const DisplacementRow& d) {
                                      return Json{{"bearing", d.bearing},
                                                  {"unbalance", d.unbalance},
                                                  {"largest", d.largest},
                                                  {"clearance", d.clearance},
                                                  {"zone", std::string(1, d.zone)}};
                                    })},
          {"separation", ListJson(a.separation, [](const SeparationRow& s) {
             return Json{{"bearing", s.bearing},
                         {"unbalance", s.unbalance},
                         {"critical", s.peak.speed},
                         {"amplification", s.peak.amplification},
                         {"required", s.margin.required},
                         {"actual", s.margin.actual},
                         {"met", s.margin.met}};
           })}};
}

}  // namespace

const char* SenseName(Whirl whirl) {
  return whirl == Whirl::kForward ? "forward" : whirl == Whirl::kBackward ? "backward" : "mixed";
}

const char* SenseName(const ClosedLoopModes& row, const ClosedLoopMode& mode) {
  if (row.speed == 0)
    for (const ClosedLoopMode& other : row.modes)
      if (&other != &mode && std::abs(other.s - mode.s) < 1e-6 * std::abs(mode.s)) return "either";
  return SenseName(mode.sense());
}

Json AnalysisJson(const RigAnalysis& a) {
  Json out;
  out["rig"] = a.point.rig().name;
  out["speed"] = {
      {"lowest", a.options.lowest}, {"highest", a.options.highest}, {"fastest", a.options.fastest}};
  out["stable"] = a.stable();
  out["notes"] = a.point.notes;
  out["capacity"] = ListJson(a.capacity, CapacityJson);
  out["sensitivity"] = ListJson(a.sensitivity, SensitivityJson);
  out["measured_sensitivity"] = ListJson(a.measured, [&](const MeasuredPoint& p) {
    return Json{{"axis", a.capacity[p.axis].axis},
                {"frequency", p.frequency},
                {"measured", std::abs(p.measured)},
                {"computed", std::abs(p.computed)}};
  });
  const double origin = a.point.rig().z_origin;
  out["rotor"] = SupportsJson(a.supports, origin);
  out["campbell"] = CampbellJson(a);
  out["critical_speeds"] = ListJson(a.criticals, [](const DampedCritical& c) {
    return Json{{"speed", c.speed},
                {"log_decrement", c.mode.log_decrement},
                {"whirl", SenseName(c.mode.sense())}};
  });
  out["unbalance"] =
      ListJson(a.unbalance, [&](const UnbalanceSweep& s) { return UnbalanceJson(s, origin); });
  out["standards"] = StandardsJson(a);
  out["dynamic_stiffness"] = {
      {"frequency", a.stiffness.frequency},
      {"axes", ListJson(a.stiffness.axes, [](const AxisStiffness& s) {
         return Json{{"axis", s.axis}, {"bearing", Parts(s.bearing)}, {"rotor", Parts(s.rotor)}};
       })}};
  out["responses"] = ListJson(a.responses, [](const ResponseCurve& c) {
    Json r = {
        {"input", c.input}, {"output", c.output}, {"unit", c.unit}, {"frequency", c.frequency}};
    r.update(Parts(c.values));
    return r;
  });
  return out;
}

}  // namespace ambrig
