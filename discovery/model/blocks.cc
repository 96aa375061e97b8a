#include "discovery/model/blocks.h"

#include <algorithm>
#include <cmath>

#include "actuators/magnetics/radial_stator.h"
#include "core/record/missing_samples.h"
#include "discovery/model/controller_block.h"
#include "discovery/model/record_rows.h"
#include "discovery/model/record_traits.h"
#include "discovery/model/residual_force.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_assembly.h"
#include "rig/rig_channels.h"
#include "simulation/switching/switching_engine.h"

namespace ambrig {

namespace {

struct Mean {
  double sum = 0, n = 0;
  void Add(double error) {
    if (!std::isfinite(error)) return;
    sum += error * error;
    n += 1;
  }
  double Rms() const { return n > 0 ? std::sqrt(sum / n) : 0; }
};

void Put(BlockErrors& out, const std::string& block, const Mean& mean) {
  if (mean.n > 0) out[block] = mean.Rms();
}

/// What drives a block: readings, set-points, currents; not a load cell or a thermometer.
bool Drives(const std::string& channel) {
  const auto id = ParseChannel(channel);
  return id && (id->kind == ChannelKind::kReading || id->kind == ChannelKind::kSetPoint ||
                id->kind == ChannelKind::kCoilCurrent);
}

void ControllerBlock(const RigParameters& nominal, const Scenario& scenario,
                     const BridgedRecord& data, BlockErrors& out) {
  Mean error;
  for (const ControllerAxis& axis : ControllerAxes(nominal, scenario, data))
    for (std::size_t k = 0; k < axis.error.size(); ++k)
      if (axis.counts[k]) error.Add(axis.error[k]);
  Put(out, "controller", error);
}

void CoilBlock(const RigParameters& rig, const RigParameters& nominal, const Scenario& scenario,
               const BridgedRecord& data, BlockErrors& out) {
  const Record& d = data.record;
  bool readings = true, set_points = false;
  for (const BearingParameters& b : rig.bearings) {
    for (const auto& axis : b.Axes()) readings = readings && d.Find(axis);
    set_points = set_points || Find(d, {ChannelKind::kSetPoint, b.name, 0});
  }
  if (!set_points || (!readings && scenario.start != StartState::kClamped)) return;
  Record forced = d;
  if (!readings)
    for (const BearingParameters& b : rig.bearings) {
      const auto it = scenario.clamp.find(b.name);
      const auto at = it == scenario.clamp.end() ? std::array<double, 2>{0, 0} : it->second;
      for (std::size_t side = 0; side < b.Axes().size(); ++side)
        if (!forced.Find(b.Axes()[side]))
          forced.channels.push_back({b.Axes()[side], "m", std::vector<double>(d.rows(), at[side])});
    }
  Scenario quiet = scenario;
  quiet.noise = false;
  EngineOptions options;
  options.coil_spread = false;
  options.forced = &forced;
  const NominalRig known(nominal);
  options.nominal = &known;
  options.watch = false;
  options.record_rate = SimulationRateFor(rig, d);
  const Record simulated = SwitchingEngine(rig, quiet, options).Run().record;
  const std::size_t settle =
      std::min<std::size_t>(d.rows() / 4, static_cast<std::size_t>(kLoopsSettle * d.rate));
  Mean error;
  for (const BearingParameters& b : rig.bearings)
    for (const ChannelId& current : ChannelsOf(b, ChannelKind::kCoilCurrent)) {
      const Channel *m = Find(d, current), *p = Find(simulated, current);
      if (!m || !p) continue;
      for (std::size_t k = settle; k < d.rows(); ++k) {
        const BetweenRows row = PlaceOfRow(simulated.rate, d, k);
        if (row.low >= p->samples.size()) break;
        if (data.Sound(k)) error.Add(m->samples[k] - Between(p->samples, row));
      }
    }
  Put(out, "coil", error);
}

void ForceAndSensorBlocks(const RigParameters& rig, const Scenario& scenario, const Record& d,
                          BlockErrors& out) {
  if (scenario.start != StartState::kClamped) return;
  Mean force, sensor;
  for (const BearingParameters& b : rig.bearings) {
    const auto it = scenario.clamp.find(b.name);
    const std::array<double, 2> at =
        it == scenario.clamp.end() ? std::array<double, 2>{0, 0} : it->second;
    if (!b.kind->eight_poles) continue;
    const auto cell = ChannelsIn(d, b, ChannelKind::kLoadCell),
               current = ChannelsIn(d, b, ChannelKind::kCoilCurrent);
    if (!cell.empty() && !current.empty()) {
      const RadialStator stator(b.radial);
      for (std::size_t k = 0; k < d.rows(); ++k) {
        CoilVector i;
        for (std::size_t j = 0; j < current.size(); ++j)
          i[static_cast<Eigen::Index>(j)] = current[j]->samples[k];
        const Eigen::Vector2d f = stator.Force({at[0], at[1]}, i);
        force.Add(cell[0]->samples[k] - f.x());
        force.Add(cell[1]->samples[k] - f.y());
      }
    }
    // The reading of a rigid, held shaft at the sensor's own plane.
    const BearingParameters* other = nullptr;
    for (const auto& o : rig.bearings)
      if (o.kind->two_axes && o.name != b.name) other = &o;
    if (!other) continue;
    const auto ot = scenario.clamp.find(other->name);
    const std::array<double, 2> far =
        ot == scenario.clamp.end() ? std::array<double, 2>{0, 0} : ot->second;
    for (std::size_t side = 0; side < 2; ++side) {
      const Channel* y = d.Find(b.Axes()[side]);
      if (!y) continue;
      const double held = at[side] + (far[side] - at[side]) * (b.sensor.z - b.z) / (other->z - b.z);
      for (double v : y->samples) sensor.Add(v - held);
    }
  }
  Put(out, "force", force);
  Put(out, "sensor", sensor);
}

void RotorBlock(const RigParameters& rig, const Scenario& scenario, const BridgedRecord& data,
                BlockErrors& out) {
  const Record& d = data.record;
  const auto f = EstimateResidualForce(rig, scenario, d, 400);
  if (!f) return;
  Mean error;
  const std::size_t edge = static_cast<std::size_t>(kLoopsSettle * d.rate);
  for (const auto& p : f->planes)
    for (std::size_t k = edge; k + edge < p.fx.size(); ++k) {
      if (!data.Sound(k) || !data.Sound(k + edge)) continue;  // smoothing reaches both ways
      error.Add(p.fx[k]);
      error.Add(p.fy[k]);
    }
  Put(out, "rotor", error);
}

}  // namespace

BlockErrors BlockRms(const RigParameters& rig, const RigParameters& nominal,
                     const Scenario& scenario, const Record& d) {
  BlockErrors out;
  const BridgedRecord bridged = BridgeMissing(d, kLoopsSettle, Drives);
  ControllerBlock(nominal, scenario, bridged, out);
  CoilBlock(rig, nominal, scenario, bridged, out);
  // row by row: a missing sample leaves out its own row
  ForceAndSensorBlocks(rig, scenario, d, out);
  RotorBlock(rig, scenario, bridged, out);
  return out;
}

}  // namespace ambrig
