/// The coils of all bearings through one period: voltage patterns, where the gaps will be, the
/// samples of the circuits (side by side, or in lockstep where something ties them together), what
/// is measured of them.
#include <algorithm>
#include <utility>

#include "simulation/sampled/instants.h"
#include "simulation/switching/bearing_run.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {

void SwitchingEngine::SetPatterns(BearingRun& b) {
  const BearingControl& c = loop_.control[b.side->index];
  if (b.only_edge_moves && !c.AnyDisabled()) {
    for (int j = 0; j < c.coils; ++j)
      b.pattern.t2[j] = LateEnd(c.duty[j] * T_, b.side->late_edge[j], 0, T_);
    return;
  }
  b.only_edge_moves = loop_.rig.amplifier.modulation == Modulation::kBiState;
  for (int j = 0; j < c.coils; ++j) {
    const auto lane = static_cast<std::size_t>(j);
    const BridgeImperfection& bridge = b.plant->bridge[lane];
    b.only_edge_moves = b.only_edge_moves && bridge.dead_time == 0 && bridge.dead_duty == 0 &&
                        !bridge.off && !bridge.stuck_on && !c.disabled[lane] &&
                        b.plant->voltage[lane].empty();
    SetPattern(b, j);
  }
}

void SwitchingEngine::SetPattern(BearingRun& b, int j) const {
  const CoilVoltage v = loop_.PatternOf(*b.side, j, b.plant->lanes.i[j]);
  b.plant->lanes.released[static_cast<std::size_t>(j)] = v.released;
  b.pattern.t1[j] = v.t1;
  b.pattern.t2[j] = v.t2;
  for (int q = 0; q < 3; ++q) {
    b.pattern.gain[q][j] = v.gain[q];
    b.pattern.drop[q][j] = v.drop[q];
  }
}

void SwitchingEngine::PredictPositions() {
  // Where the planes will be at the end of the period: constant acceleration.
  MotionState& ahead = ahead_;  // kept: only what moves is written
  ahead.t = motion_.t + T_;
  ahead.theta = motion_.theta + T_ * motion_.Omega;
  ahead.Omega = motion_.Omega;
  ahead.Omega_dot = motion_.Omega_dot;
  for (std::size_t d = 0; d < static_cast<std::size_t>(plant_.rotor.dof()); ++d) {
    ahead.q[d] = motion_.q[d] + T_ * (motion_.v[d] + 0.5 * T_ * acceleration_[d]);
    ahead.v[d] = motion_.v[d];
  }
  for (BearingRun& b : bearings_) {
    const PlanePoint p = plant_.rotor.Position(ahead, b.plant->plane);
    b.x_next = p.x - b.plant->offset_x;
    b.y_next = p.y - b.plant->offset_y;
  }
}

void SwitchingEngine::RunMagnetics(long long n) {
  if (!loop_.clamped) PredictPositions();
  for (BearingRun& b : bearings_) {
    if (options_.forced) {
      ForcedPosition(*b.side, motion_.t + T_, &b.x_next, &b.y_next);
      b.x_next -= b.plant->offset_x;
      b.y_next -= b.plant->offset_y;
    } else if (loop_.clamped) {
      b.x_next = b.x;
      b.y_next = b.y;
    }
  }
  const double end = motion_.t + T_;
  std::vector<const FaultSpec*>& due = due_faults_;
  due.clear();
  while (n >= 0 && next_fault_ < scenario_.faults.size() &&
         scenario_.faults[next_fault_].time < end - kSameTime)
    due.push_back(&scenario_.faults[next_fault_++]);
  while (n >= 0 && next_added_ < added_faults_.size() &&
         added_faults_[next_added_].time < end - kSameTime)
    due.push_back(&added_faults_[next_added_++]);
  std::ranges::stable_sort(due, {}, &FaultSpec::time);
  // Faults and a moving bus tie the bearings together sample by sample; an iron law or a late edge
  // concerns its own bearing only.
  const bool lockstep = options_.force_general_path || !due.empty() || !plant_.bus.stiff() ||
                        fault_ends_.next() < end;
  if (lockstep) {
    RunSamplesInLockstep(n, due);
  } else {
    RunBearings();
  }
  for (BearingRun& b : bearings_) {
    b.side->fx_before = std::exchange(b.side->fx, b.plant->lanes.fx);
    b.side->fy_before = std::exchange(b.side->fy, b.plant->lanes.fy);
  }
}

void SwitchingEngine::RunBearings() {
  const int steps = loop_.samples * options_.substeps;
  together_.clear();
  for (BearingRun& b : bearings_) {
    StatorLanes& lanes = b.plant->lanes;
    bool late_edge = false;
    for (std::size_t j = 0; j < kLanes && !b.only_edge_moves; ++j)
      late_edge = late_edge || b.plant->bridge[j].dead_time > 0;
    if (!lanes.NeedsGeneralPath() && !late_edge) {
      together_.push_back({&lanes, &b.pattern, b.x, b.y, b.x_next, b.y_next});
      continue;
    }
    lanes.RunGeneralPeriod(b.pattern, plant_.bus.voltage, b.x, b.y, b.x_next, b.y_next, steps);
  }
  StatorLanes::RunPeriods(together_.data(), static_cast<int>(together_.size()), plant_.bus.voltage,
                          steps);
}

void SwitchingEngine::RunSamplesInLockstep(long long n, const std::vector<const FaultSpec*>& due) {
  const int steps = loop_.samples * options_.substeps;
  const double h = T_ / steps, start = static_cast<double>(n) * T_;
  for (BearingRun& b : bearings_) b.plant->lanes.BeginPeriod(b.x, b.y, b.x_next, b.y_next, steps);
  std::size_t done = 0;
  for (int k = 0; k < steps; ++k) {
    const double t = start + k * h;
    while (done < due.size() && due[done]->time < t + 0.5 * h) {
      Inject(*due[done]);
      ++done;
    }
    if (!plant_.bus.stiff() && k % options_.substeps == 0)
      loop_.bus_samples[static_cast<std::size_t>(k / options_.substeps)] = plant_.bus.voltage;
    double drawn = 0;
    for (BearingRun& b : bearings_) {
      b.plant->lanes.StepSample(b.pattern, plant_.bus.voltage, k);
      if (!plant_.bus.stiff()) drawn += b.plant->lanes.BusCurrent(b.pattern, k);
    }
    if (!plant_.bus.stiff()) plant_.bus.Advance(drawn, h);
    EndFaultsBefore(t + h);
  }
  for (; done < due.size(); ++done) Inject(*due[done]);
  for (BearingRun& b : bearings_) b.plant->lanes.EndPeriod();
}

void SwitchingEngine::Measure(long long n) {
  for (BearingRun& b : bearings_) {
    Lane* samples = b.plant->lanes.samples;
    if (options_.substeps > 1)
      for (int k = 1; k < loop_.samples; ++k) samples[k] = samples[k * options_.substeps];
    loop_.Measure(n, *b.side, samples);
  }
  loop_.EndMeasurement(n);
}

}  // namespace ambrig
