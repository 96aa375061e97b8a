#include "campaign/run_plan.h"

#include <algorithm>
#include <cmath>

#include "core/base/coil_name.h"
#include "core/math/constants.h"
#include "faulttolerance/redistribution/redistribution_setup.h"
#include "faulttolerance/supervision/failure_map.h"
#include "rig/nominal_control.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_assembly.h"
#include "scenarios/faults/fault.h"

namespace ambrig {

namespace {

// Static loads and positions are reached in small steps: the loop can hold more than it can step.
constexpr int kLoadSteps = 12;
constexpr double kLoadFirst = -0.23, kLoadLast = -0.07;  // [s], within the warm-up of 0.25 s
constexpr double kPositionReached = 0.75;                // of the time up to the fault

/// Turns of a coil that the controller can still use after the fault. [-]
double TurnsLeft(const CampaignFaultKind& k) {
  const Fault& fault = FaultByKind(k.kind);
  FaultSpec spec;
  spec.parameters = k.parameters;
  return fault.turns_left ? fault.turns_left(spec) : 0;
}

CoilVector TurnsLeft(const FailureSet& set, const CampaignFaultKind& kind) {
  CoilVector turns = CoilVector::Ones();
  for (const int coil : set.coils) turns[coil - 1] = TurnsLeft(kind);
  return turns;
}

std::size_t Place(const RigParameters& rig, const BearingParameters& b) {
  return static_cast<std::size_t>(&b - rig.bearings.data());
}

CurrentMap HealthyMap(const RigParameters& rig, const BearingParameters& b) {
  return MakeBearingControl(NominalRig(rig), Place(rig, b)).map;
}

}  // namespace

RunIndex IndexOf(const Campaign& c, std::size_t run) {
  RunIndex at;
  const auto take = [&run](std::size_t size) {
    const std::size_t k = run % size;
    run /= size;
    return k;
  };
  at.seed = take(c.seeds.size());
  at.draw = take(c.draws.size());
  at.position = take(c.positions.size());
  at.load = take(c.loads.size());
  at.speed = take(std::max<std::size_t>(c.speeds.size(), 1));
  at.phase = take(c.phases.size());
  at.fault = take(c.cases.size());
  at.scenario = take(c.scenarios.size());
  at.plant = take(std::max<std::size_t>(c.plants.size(), 1));
  return at;
}

RunPlan::RunPlan(const Campaign& campaign) : campaign_(campaign) {
  if (!campaign_.plants.empty()) commissioned_ = std::make_unique<CommissionedPlants>(campaign_);
  for (const BearingParameters& b : campaign_.rig.bearings)
    if (b.kind->eight_poles)
      tables_[b.name] = std::make_unique<RedistributionTable>(
          RedistributionProblemOf(NominalRig(campaign_.rig), b), RedistributionCacheDirectory());
}

SetCapacity RunPlan::Theory(const FailureSet& set, const CampaignFaultKind& kind) const {
  const BearingParameters& b = *campaign_.rig.Find(set.bearing);
  const double most = PidOf(campaign_.rig, b).f_max;
  const auto table = tables_.find(set.bearing);
  if (table == tables_.end()) {
    if (set.coils.empty() || !b.kind->redistribute) return {"healthy", most};
    CurrentMap map = HealthyMap(campaign_.rig, b);
    const std::string cls = b.kind->redistribute(b, TurnsLeft(set, kind), map);
    return {cls, cls == "exact" ? most : 0};
  }
  const Distribution d = table->second->Lookup(TurnsLeft(set, kind));
  const double c0 = BiasCurrent(campaign_.rig, b), k = ForceConstant(b);
  SetCapacity out;
  out.cls = set.coils.empty() ? "healthy" : ToText(d.cls);
  out.capacity = d.cls == SolvabilityClass::kNone ? 0 : std::min(most, k * c0 * c0 * d.rho);
  return out;
}

std::optional<double> RunPlan::MarginAt(const PlannedRun& p, double t) const {
  const auto table = tables_.find(p.bearing);
  if (table == tables_.end()) return {};
  const FaultCase& fault = campaign_.cases[p.at.fault];
  FailureSet failed = campaign_.sets[fault.set];
  std::erase_if(failed.coils, [&](int coil) {
    return std::ranges::none_of(p.scenario.faults, [&](const FaultSpec& f) {
      return f.target == CoilName(p.bearing, coil - 1) && f.time < t;
    });
  });
  const BearingParameters& b = *campaign_.rig.Find(p.bearing);
  const auto weight = WeightShares(campaign_.rig)[Place(campaign_.rig, b)];
  const Eigen::Vector2d load(weight[0] - p.load * std::cos(campaign_.load_angle),
                             weight[1] - p.load * std::sin(campaign_.load_angle));
  CurrentMap map = HealthyMap(campaign_.rig, b);
  RedistributionProblem left = table->second->problem();
  left.turns_left = TurnsLeft(failed, campaign_.kinds[fault.kind]);
  MapAfterFailure(*table->second, left.turns_left, load, {}, &map);
  return MarginOfMap(left, map, load, PidOf(campaign_.rig, b).f_max);
}

void RunPlan::AddFaults(const RunIndex& at, Scenario& s) const {
  const FaultCase& fault = campaign_.cases[at.fault];
  const FailureSet& set = campaign_.sets[fault.set];
  const CampaignFaultKind& kind = campaign_.kinds[fault.kind];
  double t = campaign_.fault_time + campaign_.phases[at.phase] / campaign_.rig.controller.rate;
  for (const int coil : set.coils) {
    FaultSpec f;
    f.time = t;
    f.target = CoilName(set.bearing, coil - 1);
    f.kind = kind.kind;
    f.parameters = kind.parameters;
    s.faults.push_back(f);
    if (fault.sequential) t += campaign_.spacing;
  }
}

void RunPlan::AddLoad(PlannedRun& p) const {
  const double given = campaign_.loads[p.at.load];
  const double ux = std::cos(campaign_.load_angle), uy = std::sin(campaign_.load_angle);
  const BearingParameters& b = *p.rig.Find(p.bearing);
  p.load = given;
  if (campaign_.load_unit == LoadUnit::kCapacity) {
    // A share of the capacity is all that the bearing carries: the weight counts.
    const auto up = WeightShares(campaign_.rig)[Place(p.rig, b)];
    const double pulled = b.kind->axial ? up[0] : up[0] * ux + up[1] * uy;
    p.load = given > 0 ? std::max(0.0, given * p.theory.capacity + pulled) : 0;
  }
  if (p.load == 0) return;
  const bool steps = p.scenario.start == StartState::kLevitated;
  const int n = steps ? kLoadSteps : 1;
  for (int k = 0; k < n; ++k) {
    LoadSpec l;
    l.z = b.z;
    l.axial = b.kind->axial;
    (l.axial ? l.fz : l.fx) = p.load * (l.axial ? 1 : ux) / n;
    if (!l.axial) l.fy = p.load * uy / n;
    l.start = steps ? kLoadFirst + (kLoadLast - kLoadFirst) * k / (n - 1) : 0;
    l.stop = p.scenario.duration + 1;
    p.scenario.loads.push_back(l);
  }
}

void RunPlan::AddPosition(PlannedRun& p) const {
  const BearingParameters& b = *p.rig.Find(p.bearing);
  const double share = campaign_.positions[p.at.position];
  if (share == 0) return;
  Require(HoldsPositions(b), "a bearing at which the shaft can be held");
  const double rate = p.rig.controller.rate, reach = kPositionReached * campaign_.fault_time;
  Excitation e;
  e.port = "reference";
  e.kind = "samples";
  e.stop = p.scenario.duration + 1;
  e.sample_rate = rate;
  // Quasi-static, with e = r - x: kp e + ki ∫e dt + ks x = 0 (negative stiffness ks), so that
  // without the lead e the shaft would run past the reference by ks / (kp - ks) until the integral
  // has settled.
  const PidParameters& pid = PidOf(p.rig, b);
  const double ks = tables_.at(b.name)->Lookup(CoilVector(CoilVector::Ones())).stiffness(0, 0);
  const auto samples = static_cast<std::size_t>(std::ceil(p.scenario.duration * rate)) + 1;
  double lead = 0, before = 0;
  for (std::size_t k = 0; k < samples; ++k) {
    const double u = reach > 0 ? std::min(1.0, static_cast<double>(k) / rate / reach) : 1;
    const double x = 0.5 - 0.5 * std::cos(kPi * u);
    lead -= (pid.ki * lead / rate + ks * (x - before)) / pid.kp;
    before = x;
    e.samples.push_back(x + lead);
  }
  const double radius = share * b.auxiliary->clearance;
  const auto axes = b.Axes();
  for (std::size_t a = 0; a < axes.size(); ++a) {
    e.target = axes[a];
    e.amplitude =
        radius * (a == 0 ? std::cos(campaign_.position_angle) : std::sin(campaign_.position_angle));
    p.scenario.excitations.push_back(e);
  }
}

PlannedRun RunPlan::Make(std::size_t run) const {
  Require(run < campaign_.runs(), "a run of the campaign");
  PlannedRun p;
  p.run = run;
  p.at = IndexOf(campaign_, run);
  p.rig = campaign_.rig;
  p.scenario = campaign_.scenarios[p.at.scenario];
  const FaultCase& fault = campaign_.cases[p.at.fault];
  p.bearing = campaign_.sets[fault.set].bearing;
  p.theory = Theory(campaign_.sets[fault.set], campaign_.kinds[fault.kind]);
  // Every run has noise of its own; equal numbers of bits as a TOML integer holds.
  p.scenario.seed = Mixed(campaign_.seeds[p.at.seed] * 0x100000001u + run) >> 11;
  if (!campaign_.speeds.empty()) {
    const double omega = campaign_.speeds[p.at.speed];
    p.scenario.speed = SpeedProfile({{0, omega}});
  }
  p.speed = p.scenario.speed.Speed(campaign_.fault_time);
  DrawTolerances(campaign_.draws[p.at.draw], &p.rig);
  p.rig.amplifier.unit += static_cast<double>(p.at.draw);
  if (!campaign_.plants.empty()) {
    p.plant = &campaign_.plants[p.at.plant];
    ApplyPlant(*p.plant, &p.rig);
    AgePlant(*p.plant, &p.rig);
    p.rig.detection.commissioning =
        p.plant->commissioned ? commissioned_->FileOf(p.at.plant) : "none";
    if (p.rig.detection.commissioning.empty()) p.rig.detection.commissioning = "none";
  }
  AddFaults(p.at, p.scenario);
  AddLoad(p);
  AddPosition(p);
  p.margin = MarginAt(p, kInfinity);
  return p;
}

}  // namespace ambrig
