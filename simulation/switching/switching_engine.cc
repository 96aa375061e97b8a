#include "simulation/switching/switching_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/copper.h"
#include "simulation/switching/bearing_run.h"
#include "simulation/switching/lost_rotor.h"

namespace ambrig {

SwitchingEngine::SwitchingEngine(const RigParameters& rig, const Scenario& scenario,
                                 const EngineOptions& options)
    : options_(options), loop_(rig, scenario, options), watch_(loop_, result_) {
  Require(options_.substeps >= 1 && loop_.samples * options_.substeps <= 160,
          "at most 160 steps in a period");
  for (const LoadSpec& l : scenario_.loads)
    plant_.rotor.AddLoad(l.z + (loop_.rig.nominal_com_z - loop_.rig.z_origin), l.fx, l.fy, l.fz,
                         l.start, l.stop);
  for (SampledBearing& side : loop_.bearings) {
    BearingRun b;
    b.side = &side;
    b.plant = side.plant;
    b.plant->lanes.SetStep(loop_.h / options_.substeps);
    bearings_.push_back(b);
  }
  if (options_.stepper) stepper_ = options_.stepper(plant_.rotor);
}

SwitchingEngine::~SwitchingEngine() = default;

RunResult SwitchingEngine::Run() {
  Begin();
  loop_.ForEachPeriod(options_, 256, [this](long long n) { Period(n); });
  return Finish();
}

void SwitchingEngine::Begin() {
  Start();
  if (options_.record) loop_.StartRecord();
}

RunResult SwitchingEngine::Finish() {
  watch_.Finish();
  if (options_.snapshots) Snapshot("end of the run");
  result_.record = loop_.TakeRecord();
  AddSummary(options_.supervisor, result_);
  return std::move(result_);
}

void SwitchingEngine::Start() {
  if (options_.forced)
    StartForced();
  else
    loop_.Start();
  for (BearingRun& b : bearings_) {
    SampledBearing& side = *b.side;
    b.MoveTo(plant_.rotor.Position(motion_, b.plant->plane));
    b.plant->lanes.Settle(loop_.control[side.index].set_point, b.x, b.y);
    b.plant->lanes.Force(b.x, b.y, &side.fx, &side.fy);
  }
}

void SwitchingEngine::Period(long long n) {
  if (options_.forced) FollowData(n);
  loop_.AtPeriodStart(n);
  if (CurrentsAreForced()) {
    Observe();
    RunForcedCurrents(n);
  } else {
    for (BearingRun& b : bearings_) SetPatterns(b);
    RunMagnetics(n);
  }
  Measure(n);
  MoveRotor(n);
  if (n >= 0 && options_.watch) Watch(n);
}

void SwitchingEngine::MoveRotor(long long n) {
  HeatCopper();
  for (BearingRun& b : bearings_) {
    b.x = b.x_next;
    b.y = b.y_next;
  }
  if (loop_.clamped) return;
  const auto dof = static_cast<std::size_t>(plant_.rotor.dof());
  DofVector& Q = magnetic_force_;  // kept: only what moves is written
  std::fill_n(Q.begin(), dof, 0.0);
  double sx = 0, sy = 0;
  for (const BearingRun& b : bearings_) {
    b.plant->plane.AddForce(b.side->fx, b.side->fy, Q);
    if (b.plant->thrust) continue;
    sx += b.side->fx;
    sy += b.side->fy;
  }
  std::copy_n(motion_.v.begin(), dof, acceleration_.begin());
  if (stepper_)
    stepper_->Step(motion_, Q, sx, sy, T_);
  else
    plant_.rotor.Step(motion_, Q, sx, sy, T_);
  motion_.t = static_cast<double>(n + 1) * T_;
  if (options_.lost_after < kInfinity && plant_.rotor.NearContact(motion_, 0)) {
    touching_ += T_;
    if (touching_ > options_.lost_after)
      throw LostRotor(scenario_.name + ": the rotor is lost", motion_.t);
  }
  const double per_period = 1 / T_;
  for (std::size_t d = 0; d < dof; ++d)
    acceleration_[d] = (motion_.v[d] - acceleration_[d]) * per_period;
  MoveBearings();
}

void SwitchingEngine::MoveBearings() {
  for (BearingRun& b : bearings_) {
    b.MoveTo(plant_.rotor.Position(motion_, b.plant->plane));
    if (!std::isfinite(b.x) || !std::isfinite(b.y))
      throw LostRotor(
          fmt::format("{}: the motion diverged at t = {:.4g} s{}; allowed: forces, "
                      "voltages and formulas that leave the rotor near its bearings",
                      scenario_.file.empty() ? scenario_.name : scenario_.file, motion_.t,
                      motion_.t < 0 ? ", while the loop settled before the start" : ""),
          motion_.t);
  }
}

void SwitchingEngine::HeatCopper() {
  for (BearingRun& b : bearings_) {
    CoilHeating& heat = b.plant->heating;
    if (heat.rise_per_watt <= 0 || motion_.t < 0) continue;
    StatorLanes& lanes = b.plant->lanes;
    Lane power{};
    double mean = 0;
    for (int j = 0; j < lanes.coils; ++j) {
      power[j] = lanes.resistance[j] * b.side->current.mean_square[j];
      mean += power[j] / lanes.coils;
    }
    for (int j = 0; j < lanes.coils; ++j) {
      double& dT = heat.dT[static_cast<std::size_t>(j)];
      const double loss = heat.shared == 0 ? power[j] : power[j] + heat.shared * (mean - power[j]);
      dT += T_ / heat.time_constant * (heat.rise_per_watt * loss - dT);
      lanes.resistance[j] = b.plant->base_resistance[j] * (1 + kCopperPerKelvin * dT);
    }
    lanes.SetStep(T_ / loop_.samples / options_.substeps);
  }
}

}  // namespace ambrig
