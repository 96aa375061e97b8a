#include "analysis/shaft/shaft_scatter.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "core/math/constants.h"
#include "core/math/noise.h"

namespace ambrig {

namespace {

/// Of one rotor: every mode, every critical speed (nan: lost), every case, probe and speed.
struct ScatterSample {
  std::vector<double> frequency, decrement;
  std::vector<double> critical, critical_decrement;
  std::vector<double> amplitude;
};

double Drawn(const ShaftParameter& p, double sd, std::uint64_t seed, std::size_t parameter,
             std::size_t rotor) {
  constexpr std::uint64_t kTries = 1000;
  const auto stream = static_cast<std::uint32_t>(parameter);
  for (std::uint64_t t = 0; t < kTries; ++t) {
    const double value = p.value + sd * Normal(seed, stream, rotor * kTries + t);
    if (value >= p.lo && value <= p.hi) return value;
  }
  return p.value;
}

/// What every rotor starts from.
struct ScatterStart {
  std::vector<WhirlMode> modes;
  Eigen::MatrixXd shapes;
};

/// Two of one value in the file's rotor (a pair at rest, or of an isotropic shaft) come apart in
/// any order: the lower one first.
void OrderPairs(const std::vector<double>& nominal, std::vector<double>& value,
                std::vector<double>& other) {
  for (std::size_t k = 0; k + 1 < nominal.size(); ++k)
    if (std::abs(nominal[k + 1] - nominal[k]) < 1e-6 * nominal[k] && value[k + 1] < value[k]) {
      std::swap(value[k], value[k + 1]);
      std::swap(other[k], other[k + 1]);
    }
}

bool SameCritical(const DampedCritical& a, const DampedCritical& b) {
  return std::abs(a.speed - b.speed) < 1e-7 * b.speed &&
         std::norm(a.mode.q.dot(b.mode.q)) > 0.9 * a.mode.q.squaredNorm() * b.mode.q.squaredNorm();
}

/// Two critical speeds of one pole may come apart, and both starts end at the one that stays: the
/// critical speed of the nearest mode that is none of those found.
std::optional<DampedCritical> OtherCritical(const BeamRotor& beam, const ScatterStart& start,
                                            const ScatterPlan& plan, double speed,
                                            const std::vector<DampedCritical>& found) {
  const ClosedLoopModes row =
      RowOf(speed, FindWhirlModes(Assemble(beam, speed), start.shapes, speed, plan.modes));
  std::vector<DampedCritical> others;
  for (const ClosedLoopMode& m : row.modes) others.push_back({m.s.imag(), m});
  std::sort(others.begin(), others.end(), [&](const auto& a, const auto& b) {
    return std::abs(a.speed - speed) < std::abs(b.speed - speed);
  });
  for (const DampedCritical& from : others) {
    if (std::abs(from.speed - speed) > 0.3 * speed) break;
    const auto at = SolveCritical(beam, start.shapes, plan.modes, from);
    const auto same = [&](const DampedCritical& f) { return SameCritical(*at, f); };
    if (at && std::none_of(found.begin(), found.end(), same)) return at;
  }
  return std::nullopt;
}

void TakeCriticals(const BeamRotor& beam, const ScatterStart& start, const ScatterPlan& plan,
                   ScatterSample& out) {
  std::vector<DampedCritical> all;
  for (const DampedCritical& c : plan.criticals) {
    auto found = SolveCritical(beam, start.shapes, plan.modes, c);
    if (found && std::any_of(all.begin(), all.end(),
                             [&](const auto& other) { return SameCritical(*found, other); }))
      found = OtherCritical(beam, start, plan, c.speed, all);
    if (found) all.push_back(*found);
    out.critical.push_back(found ? found->speed : kRequired);
    out.critical_decrement.push_back(found ? found->mode.log_decrement : kRequired);
  }
  std::vector<double> nominal;
  for (const DampedCritical& c : plan.criticals) nominal.push_back(c.speed);
  OrderPairs(nominal, out.critical, out.critical_decrement);
}

std::vector<double> AmplitudesOf(const BeamRotor& beam, const ScatterPlan& plan) {
  std::vector<double> out;
  for (const ShaftSweep& s : SweepShaft(beam, plan.unbalance, plan.probes, plan.speeds))
    for (const ProbeOrbit& p : s.probes)
      for (std::size_t k = 0; k < p.x.size(); ++k) out.push_back(AxesOfOrbit(p.x[k], p.y[k]).major);
  return out;
}

ScatterSample Sampled(const BeamRotor& beam, double speed, std::vector<WhirlMode> modes) {
  std::vector<double> nominal;
  for (const WhirlMode& m : modes) nominal.push_back(m.omega_d / (2 * kPi));
  const LinearRotor rotor = Assemble(beam, speed);
  if (!ContinueModes(rotor, speed, modes)) {
    // Far from the nominal rotor: all its modes, paired by the nearest pole.
    const int count = static_cast<int>(modes.size());
    const auto all =
        FindWhirlModes(rotor, ShapesOfBeam(beam, speed, count), speed, 2 * count).oscillatory;
    std::vector<bool> used(all.size(), false);  // a pair of one pole may have come apart
    for (WhirlMode& m : modes) {
      std::size_t best = all.size();
      for (std::size_t k = 0; k < all.size(); ++k)
        if (!used[k] &&
            (best == all.size() || std::abs(all[k].s - m.s) < std::abs(all[best].s - m.s)))
          best = k;
      if (best == all.size()) continue;
      used[best] = true;
      m = all[best];
    }
  }
  ScatterSample out;
  for (const WhirlMode& m : modes) {
    out.frequency.push_back(m.omega_d / (2 * kPi));
    out.decrement.push_back(m.log_decrement);
  }
  OrderPairs(nominal, out.frequency, out.decrement);
  return out;
}

/// Between order statistics, as (k - 1/2)/n.
double Quantile(std::vector<double>& v, double p) {
  std::sort(v.begin(), v.end());
  const double at =
      std::clamp(p * static_cast<double>(v.size()) - 0.5, 0.0, static_cast<double>(v.size() - 1));
  const auto k = static_cast<std::size_t>(at);
  return k + 1 < v.size() ? std::lerp(v[k], v[k + 1], at - static_cast<double>(k)) : v[k];
}

ScatterBand BandOf(std::vector<double> v) {
  if (v.empty()) return {kRequired, kRequired, kRequired};
  return {Quantile(v, 0.05), Quantile(v, 0.5), Quantile(v, 0.95)};
}

/// The k-th number of every rotor that has one.
template <typename List>
std::vector<double> Column(const std::vector<ScatterSample>& samples, List list, std::size_t k) {
  std::vector<double> out;
  for (const ScatterSample& s : samples)
    if (const double v = (s.*list)[k]; std::isfinite(v)) out.push_back(v);
  return out;
}

void TakeBands(const std::vector<ScatterSample>& samples, const ScatterStart& start,
               const ScatterPlan& plan, const std::vector<double>& nominal, ShaftScatter& out) {
  for (std::size_t m = 0; m < start.modes.size(); ++m)
    out.modes.push_back({start.modes[m].omega_d / (2 * kPi), start.modes[m].log_decrement,
                         BandOf(Column(samples, &ScatterSample::frequency, m)),
                         BandOf(Column(samples, &ScatterSample::decrement, m))});
  for (std::size_t c = 0; c < plan.criticals.size(); ++c) {
    const std::vector<double> speeds = Column(samples, &ScatterSample::critical, c);
    out.criticals.push_back({plan.criticals[c], BandOf(speeds),
                             BandOf(Column(samples, &ScatterSample::critical_decrement, c)),
                             static_cast<int>(speeds.size())});
  }
  std::size_t at = 0;
  for (const UnbalanceCase& u : plan.unbalance)
    for (const ShaftProbe& p : plan.probes) {
      ScatteredResponse r{u.name, p.name, {}, {}};
      for (std::size_t k = 0; k < plan.speeds.size(); ++k, ++at) {
        r.nominal.push_back(nominal[at]);
        r.amplitude.push_back(BandOf(Column(samples, &ScatterSample::amplitude, at)));
      }
      out.responses.push_back(std::move(r));
    }
}

}  // namespace

ShaftScatter ScatterShaft(const BeamFile& file, const std::vector<Tolerance>& tolerances,
                          const ScatterPlan& plan, const std::function<bool(double)>& go_on) {
  if (tolerances.empty())
    throw InputError(
        "--scatter: no number of the shaft has an sd, allowed: numbers written { value = ..., sd = "
        "... }");
  ShaftScatter out;
  out.rotors = plan.rotors;
  out.speed = plan.speed;
  out.speeds = plan.unbalance.empty() ? std::vector<double>{} : plan.speeds;
  for (const Tolerance& t : tolerances) out.parameters.push_back(t.path);
  const BeamRotor nominal = BuildBeam(file.definition);
  ScatterStart start;
  start.shapes = ShapesOfBeam(nominal, plan.speed, plan.modes);
  start.modes = FindWhirlModes(Assemble(nominal, plan.speed), start.shapes, plan.speed, plan.modes)
                    .oscillatory;
  std::vector<ScatterSample> samples(static_cast<std::size_t>(plan.rotors));
  std::atomic<std::size_t> done{0};
  std::atomic<bool> stopped{false};
  tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t k) {
    if (stopped) return;
    BeamFile drawn = file;
    for (std::size_t p = 0; p < file.parameters.size(); ++p)
      for (const auto& set : file.parameters[p].set)
        set(drawn, Drawn(file.parameters[p], tolerances[p].sd, plan.seed, p, k));
    const BeamRotor beam = BuildBeam(drawn.definition);
    samples[k] = Sampled(beam, plan.speed, start.modes);
    TakeCriticals(beam, start, plan, samples[k]);
    samples[k].amplitude = AmplitudesOf(beam, plan);
    const double part = static_cast<double>(++done) / static_cast<double>(samples.size());
    if (go_on && !go_on(part)) stopped = true;
  });
  if (!stopped) TakeBands(samples, start, plan, AmplitudesOf(nominal, plan), out);
  return out;
}

}  // namespace ambrig
