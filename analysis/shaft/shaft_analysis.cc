#include "analysis/shaft/shaft_analysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/shaft/shaft_planes.h"
#include "core/math/constants.h"

namespace ambrig {

namespace {

constexpr int kCampbellSpeeds = 51, kSweepSpeeds = 201, kMapRows = 41, kScatterSpeeds = 61;
constexpr int kRodModes = 6, kUndamped = 8;

std::vector<double> Spread(double from, double to, int count) {
  std::vector<double> out;
  for (int k = 0; k < count; ++k) out.push_back(std::lerp(from, to, k / (count - 1.0)));
  return out;
}

/// Rising, each once: between speeds that agree to 1e-6 (two whirls of one frequency) a response
/// differs by less than its rounding, which would look like peaks.
std::vector<double> Rising(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  const auto same = [](double a, double b) { return b - a <= 1e-6 * b; };
  x.erase(std::unique(x.begin(), x.end(), same), x.end());
  return x;
}

/// A supported shaft, analysed part by part.
class WholeShaft {
 public:
  WholeShaft(const std::string& name, const BeamFile& file, const ShaftOptions& options) {
    out_.name = name;
    out_.file = file;
    out_.options = options;
    out_.beam = BuildBeam(file.definition);
    out_.totals = Totals(out_.beam);
  }

  ShaftAnalysis Run(const std::vector<Tolerance>& tolerances) {
    Say(0, "modes over speed");
    for (const double w : FreeModes(out_.beam, 4).omega) out_.free.push_back(w);
    shapes_ = ShapesOfBeam(out_.beam, out_.options.highest, out_.options.modes);
    out_.campbell = FollowShaft(out_.beam, shapes_, CampbellSpeeds(), out_.options.modes);
    if (!out_.options.campbell_alone) Rest(tolerances);
    Note();
    ToPlaces();
    return std::move(out_);
  }

 private:
  void Rest(const std::vector<Tolerance>& tolerances) {
    Say(0.5, "critical speeds");
    const LinearRotor r = Assemble(out_.beam, out_.options.highest);
    out_.undamped = FindCriticalSpeeds(r, shapes_, kUndamped);
    MapSupports();
    Say(0.7, "weight and unbalance");
    out_.weight = DeflectUnderWeight(out_.beam, out_.options.highest);
    Unbalance();
    Harmonic();
    out_.axial = AxialModes(out_.beam, out_.options.highest, kRodModes);
    out_.torsional = TorsionalModes(out_.beam, out_.options.highest, kRodModes);
    Couple();
    Scatter(tolerances);
  }

  void Say(double fraction, const std::string& text) const {
    if (out_.options.stop && out_.options.stop->load()) throw Interrupted();
    if (out_.options.progress) out_.options.progress(fraction, text);
  }

  std::vector<double> CampbellSpeeds() const {
    std::vector<double> speeds = Spread(0, out_.options.fastest, kCampbellSpeeds);
    speeds.insert(speeds.end(), {out_.options.lowest, out_.options.highest});
    return Rising(speeds);
  }

  /// An even grid, and around every critical speed steps of a quarter of its mode's half width.
  std::vector<double> SweepSpeeds() const {
    const double end = out_.options.fastest;
    std::vector<double> speeds = Spread(end / kSweepSpeeds, end, kSweepSpeeds);
    for (const DampedCritical& c : out_.campbell.criticals)
      for (int k = -16; k <= 16; ++k) {
        const double w = c.speed + 0.25 * k * std::abs(c.mode.s.real());
        if (w > 0 && w < end) speeds.push_back(w);
      }
    return Rising(speeds);
  }

  void MapSupports() {
    double log_k = 0;
    int count = 0;
    for (const SpringSupport& s : out_.beam.supports) {
      const SupportCoefficients c = s.At(out_.options.highest);
      const double k = 0.5 * (c.kxx + c.kyy);
      if (s.on_shaft() && !s.between_shafts() && k > 0) log_k += std::log10(k), ++count;
    }
    if (count == 0) return;
    std::vector<double> stiffnesses;
    for (const double e : Spread(-2, 2, kMapRows))
      stiffnesses.push_back(std::pow(10.0, log_k / count + e));
    out_.map = MapCriticalSpeeds(out_.beam, stiffnesses, kUndamped);
  }

  std::vector<UnbalanceCase> Cases() const {
    const ShaftOptions& o = out_.options;
    if (!o.unbalance.empty()) {
      UnbalanceCase chosen{"chosen", {}};
      for (const UnbalanceChoice& u : o.unbalance) {
        const ShaftProbe p = FindPlane(out_.file, u.plane, "unbalance");
        if (!p.housing.empty())
          throw InputError(fmt::format(
              "--unbalance: plane {} is a housing, allowed: planes of the shaft", p.name));
        chosen.planes.push_back({p.z, u.magnitude, u.phase});
      }
      return {chosen};
    }
    if (o.highest <= 0 || !out_.weight.held) return {};
    if (o.grade > 0) return GradeUnbalance(out_.beam, out_.weight, o.grade, o.highest);
    return ApiUnbalance(out_.beam, out_.weight, o.highest);
  }

  std::vector<ShaftProbe> Probes() const {
    std::vector<ShaftProbe> probes;
    for (const PlaneChoice& p : out_.options.probes)
      probes.push_back(FindPlane(out_.file, p, "probe"));
    return probes.empty() ? NamedPlanes(out_.file, out_.beam) : probes;
  }

  /// Over the frequencies of the speeds that are analysed, finer around the damped modes of this
  /// speed.
  void Harmonic() {
    const ShaftOptions& o = out_.options;
    HarmonicLoad load{{}, o.ground_x, o.ground_y};
    for (const ForceChoice& f : o.forces)
      load.forces.push_back({FindPlane(out_.file, f.plane, "shake"), f.x, f.y, f.phase});
    if (!load.any()) return;
    std::vector<double> at = Spread(o.fastest / kSweepSpeeds, o.fastest, kSweepSpeeds);
    for (const ClosedLoopModes& row : out_.campbell.rows)
      for (const ClosedLoopMode& m : row.modes)
        for (int k = -16; k <= 16 && row.speed == o.highest; ++k)
          if (const double w = m.s.imag() + 0.25 * k * std::abs(m.s.real()); w > 0 && w < o.fastest)
            at.push_back(w);
    out_.harmonic = SweepHarmonic(out_.beam, o.highest, load, Probes(), Rising(at));
  }

  void Unbalance() {
    const std::vector<ShaftProbe> probes = Probes();
    std::vector<UnbalanceCase> cases = Cases();
    std::erase_if(cases, [](const UnbalanceCase& c) { return c.planes.empty(); });
    out_.unbalance = SweepShaft(out_.beam, cases, probes, SweepSpeeds());
  }

  void Couple() {
    const ShaftOptions& o = out_.options;
    if (o.coupling <= 0) return;
    Say(0.9, "cross-coupling");
    const ShaftProbe p = FindPlane(out_.file, o.coupled, "cross-coupling");
    if (!p.housing.empty())
      throw InputError(fmt::format(
          "--cross-coupling: plane {} is a housing, allowed: a plane of the shaft", p.name));
    out_.level1 = AssessCoupling(out_.beam, o.highest, o.modes, {p.z, o.coupling});
  }

  void Scatter(const std::vector<Tolerance>& tolerances) {
    const ShaftOptions& o = out_.options;
    if (o.rotors <= 0) return;
    Say(0, "scattered rotors");
    ScatterPlan plan{o.highest, o.modes, o.rotors, o.seed, {}, {}, Probes(), {}};
    for (const DampedCritical& c : out_.campbell.criticals)
      if (c.IsResonance()) plan.criticals.push_back(c);
    for (const ShaftSweep& s : out_.unbalance) plan.unbalance.push_back(s.unbalance);
    plan.speeds = Spread(o.fastest / kScatterSpeeds, o.fastest, kScatterSpeeds);
    for (const DampedCritical& c : plan.criticals)
      for (const double away : {-0.04, -0.02, -0.01, 0.0, 0.01, 0.02, 0.04})
        if (const double w = c.speed * (1 + away); w < o.fastest) plan.speeds.push_back(w);
    plan.speeds = Rising(plan.speeds);
    out_.scatter = ScatterShaft(out_.file, tolerances, plan,
                                [&](double) { return !(o.stop && o.stop->load()); });
    if (o.stop && o.stop->load()) throw Interrupted();
  }

  /// Results of several shafts on the machine's axis, no longer one after the other.
  void ToPlaces() {
    const std::vector<PlacedShaft>& shafts = out_.beam.shafts;
    const auto place = [&](double& z) { z = PlaceOf(shafts, z); };
    if (shafts.empty()) return;
    for (std::vector<double>* list : {&out_.weight.z, &out_.weight.at, &out_.beam.z})
      for (double& z : *list) place(z);
    for (SupportReaction& r : out_.weight.reactions) place(r.z);
    for (ShaftSweep& s : out_.unbalance) {
      for (PlaneUnbalance& u : s.unbalance.planes) place(u.z);
      for (ProbeOrbit& p : s.probes) place(p.probe.z);
    }
    if (out_.harmonic)
      for (ProbeOrbit& p : out_.harmonic->probes) place(p.probe.z);
    if (out_.level1) place(out_.level1->given.z);
    for (ShaftElement& e : out_.beam.elements) place(e.z0);
    for (Disk& d : out_.beam.disks) place(d.z);
    for (SpringSupport& s : out_.beam.supports) place(s.z);
  }

  void Note() {
    if (out_.beam.supports.empty())
      out_.notes.push_back("the file has no [[rotor.support]]: a free shaft");
    else if (!out_.weight.held && !out_.options.campbell_alone)
      out_.notes.push_back("the supports leave a motion of the shaft free: no static deflection");
    for (const SpringSupport& s : out_.beam.supports)
      if (s.varies() && (out_.options.fastest > s.speed.back() || s.speed.front() > 0))
        out_.notes.push_back(fmt::format(
            "support {}: its table goes from {:.0f} to {:.0f} rpm, its end rows hold beyond",
            s.name.empty() ? fmt::format("at z = {:g} m", s.z) : s.name, s.speed.front() / kRpm,
            s.speed.back() / kRpm));
  }

  ShaftAnalysis out_;
  Eigen::MatrixXd shapes_;
};

}  // namespace

std::vector<CriticalMapRow> MapCriticalSpeeds(const BeamRotor& beam,
                                              const std::vector<double>& stiffnesses, int count) {
  BeamRotor copy = beam;
  const auto at = [&](double k) {
    for (SpringSupport& s : copy.supports) {
      if (!s.on_shaft() || s.between_shafts()) continue;
      SpringSupport same = IsotropicSupport(s.z, k, 0);
      same.name = s.name;
      same.on = s.on;
      s = same;
    }
    return Assemble(copy);
  };
  std::vector<CriticalMapRow> rows;
  const Eigen::MatrixXd shapes =
      ShapesOf(at(stiffnesses[stiffnesses.size() / 2]), 3 * count + 8, SupportColumns(beam));
  for (const double k : stiffnesses) rows.push_back({k, FindCriticalSpeeds(at(k), shapes, count)});
  return rows;
}

ShaftAnalysis AnalyseShaft(const std::string& name, const BeamFile& file,
                           const std::vector<Tolerance>& tolerances, const ShaftOptions& options) {
  return WholeShaft(name, file, options).Run(tolerances);
}

}  // namespace ambrig
