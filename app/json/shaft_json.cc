#include "app/json/shaft_json.h"

#include "app/json/analysis_json.h"
#include "app/json/json_number.h"
#include "core/math/constants.h"

namespace ambrig {

namespace {

using Json = nlohmann::ordered_json;

Json DampedModeJson(const ClosedLoopMode& m) {
  return {{"re", m.s.real()},
          {"im", m.s.imag()},
          {"frequency", m.frequency},
          {"zeta", m.zeta},
          {"log_decrement", m.log_decrement},
          {"whirl", SenseName(m.sense())},
          {"whirl_index", m.whirl}};
}

Json ShaftCampbellJson(const ShaftCampbell& c) {
  Json rows = Json::array();
  for (std::size_t k = 0; k < c.rows.size(); ++k) {
    Json modes = Json::array();
    for (const ClosedLoopMode& m : c.rows[k].modes) modes.push_back(DampedModeJson(m));
    rows.push_back({{"speed", c.rows[k].speed}, {"modes", modes}, {"real_poles", c.real[k]}});
  }
  return rows;
}

Json UndampedJson(const std::vector<CriticalSpeed>& speeds) {
  Json out = Json::array();
  for (const CriticalSpeed& c : speeds) out.push_back({{"speed", c.speed}, {"whirl", c.whirl}});
  return out;
}

Json ProbeJson(const ProbeOrbit& p) {
  Json ax = Json::array(), px = ax, ay = ax, py = ax, major = ax, minor = ax, angle = ax,
       peaks = ax;
  for (std::size_t k = 0; k < p.x.size(); ++k) {
    const OrbitAxes axes = AxesOfOrbit(p.x[k], p.y[k]);
    ax.push_back(std::abs(p.x[k]));
    px.push_back(std::arg(p.x[k]));
    ay.push_back(std::abs(p.y[k]));
    py.push_back(std::arg(p.y[k]));
    major.push_back(axes.major);
    minor.push_back(axes.minor);
    angle.push_back(NodalAngle(p.x[k], p.y[k]));
  }
  for (const ResponsePeak& k : p.peaks)
    peaks.push_back({{"speed", k.speed},
                     {"amplitude", k.amplitude},
                     {"amplification", FiniteOrNull(k.amplification)},
                     {"bound", k.bound}});
  Json out = {{"name", p.probe.name}};
  if (p.probe.housing.empty()) out["z"] = p.probe.z;
  out.update({{"x", ax}, {"x_phase", px}, {"y", ay}, {"y_phase", py}});
  out.update({{"major", major}, {"minor", minor}, {"angle", angle}, {"peaks", peaks}});
  return out;
}

Json SweepJson(const ShaftSweep& s) {
  Json planes = Json::array(), probes = Json::array(), forces = Json::array();
  for (const PlaneUnbalance& u : s.unbalance.planes)
    planes.push_back({{"z", u.z}, {"magnitude", u.magnitude}, {"phase", u.phase}});
  for (const ProbeOrbit& p : s.probes) probes.push_back(ProbeJson(p));
  for (const SupportForce& f : s.forces) {
    Json major = Json::array();
    for (std::size_t k = 0; k < f.x.size(); ++k) major.push_back(AxesOfOrbit(f.x[k], f.y[k]).major);
    forces.push_back({{"support", f.support}, {"major", major}});
  }
  return {{"case", s.unbalance.name},
          {"planes", planes},
          {"speed", s.speed},
          {"probes", probes},
          {"forces", forces}};
}

Json WeightJson(const StaticDeflection& w) {
  Json reactions = Json::array();
  for (const SupportReaction& r : w.reactions)
    reactions.push_back(
        {{"support", r.name}, {"z", FiniteOrNull(r.z)}, {"fx", r.fx}, {"fy", r.fy}});
  return {{"held", w.held},   {"weight", w.weight}, {"z", w.z},
          {"x", w.x},         {"y", w.y},           {"at", w.at},
          {"shear", w.shear}, {"moment", w.moment}, {"reactions", reactions}};
}

Json RodsJson(const std::vector<RodMode>& modes) {
  Json out = Json::array();
  for (const RodMode& m : modes)
    out.push_back({{"frequency", m.omega / (2 * kPi)}, {"shape", m.shape}});
  return out;
}

Json BandJson(const ScatterBand& b) {
  return {FiniteOrNull(b.low), FiniteOrNull(b.middle), FiniteOrNull(b.high)};
}

Json ShaftScatterJson(const ShaftScatter& s) {
  Json modes = Json::array();
  for (const ScatteredMode& m : s.modes)
    modes.push_back({{"frequency", m.nominal_frequency},
                     {"frequency_5_50_95", BandJson(m.frequency)},
                     {"log_decrement", m.nominal_decrement},
                     {"log_decrement_5_50_95", BandJson(m.decrement)}});
  Json criticals = Json::array(), responses = Json::array();
  for (const ScatteredCritical& c : s.criticals)
    criticals.push_back({{"speed", c.nominal.speed},
                         {"whirl", SenseName(c.nominal.mode.sense())},
                         {"speed_5_50_95", BandJson(c.speed)},
                         {"log_decrement", c.nominal.mode.log_decrement},
                         {"log_decrement_5_50_95", BandJson(c.decrement)},
                         {"found", c.found}});
  for (const ScatteredResponse& r : s.responses) {
    Json bands = Json::array();
    for (const ScatterBand& b : r.amplitude) bands.push_back(BandJson(b));
    responses.push_back({{"case", r.unbalance},
                         {"probe", r.probe},
                         {"amplitude", r.nominal},
                         {"amplitude_5_50_95", bands}});
  }
  return {{"rotors", s.rotors},    {"parameters", s.parameters},   {"speed", s.speed},
          {"modes", modes},        {"critical_speeds", criticals}, {"speeds", s.speeds},
          {"unbalance", responses}};
}

}  // namespace

Json ShaftJson(const ShaftAnalysis& a) {
  Json out = {{"shaft", a.name}, {"mass", a.totals.mass}, {"z_com", a.totals.z_com}};
  out["inertia_transverse"] = a.totals.inertia_transverse;
  out["inertia_polar"] = a.totals.inertia_polar;
  out["speed"] = {
      {"lowest", a.options.lowest}, {"highest", a.options.highest}, {"fastest", a.options.fastest}};
  out["stable"] = a.campbell.stable();
  out["notes"] = a.notes;
  Json free = Json::array();
  for (const double w : a.free) free.push_back(w / (2 * kPi));
  out["free_bending"] = free;
  out["campbell"] = ShaftCampbellJson(a.campbell);
  Json criticals = Json::array(), map = Json::array(), sweeps = Json::array();
  for (const DampedCritical& c : a.campbell.criticals)
    criticals.push_back({{"speed", c.speed},
                         {"log_decrement", c.mode.log_decrement},
                         {"whirl", SenseName(c.mode.sense())}});
  out["critical_speeds"] = criticals;
  out["undamped_critical_speeds"] = UndampedJson(a.undamped);
  for (const CriticalMapRow& row : a.map)
    map.push_back({{"stiffness", row.stiffness}, {"speeds", UndampedJson(row.speeds)}});
  out["map"] = map;
  for (const ShaftSweep& s : a.unbalance) sweeps.push_back(SweepJson(s));
  out["unbalance"] = sweeps;
  if (a.harmonic) {
    Json probes = Json::array();
    for (const ProbeOrbit& p : a.harmonic->probes) probes.push_back(ProbeJson(p));
    out["harmonic"] = {
        {"speed", a.harmonic->speed}, {"omega", a.harmonic->frequency}, {"probes", probes}};
  }
  out["weight"] = WeightJson(a.weight);
  out["axial"] = RodsJson(a.axial);
  out["torsional"] = RodsJson(a.torsional);
  if (a.level1)
    out["level_1"] = {{"z", a.level1->given.z},
                      {"expected", a.level1->given.expected},
                      {"frequency", a.level1->frequency / (2 * kPi)},
                      {"log_decrement_at_expected", a.level1->at_expected},
                      {"limit", FiniteOrNull(a.level1->limit)},
                      {"passed", a.level1->passed()},
                      {"q", a.level1->q},
                      {"log_decrement", a.level1->log_decrement}};
  if (a.scatter) out["scatter"] = ShaftScatterJson(*a.scatter);
  return out;
}

}  // namespace ambrig
