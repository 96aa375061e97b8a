#include "simulation/sampled/position_loop.h"

#include <algorithm>

#include "core/base/errors.h"
#include "simulation/sampled/controller_setup.h"
#include "simulation/sampled/instants.h"

namespace ambrig {

PositionLoop::PositionLoop(const NominalRig& nominal, Plant& plant, const CommandPlan& commands,
                           MeasurementNoise& noise, bool noisy)
    : plant_(plant),
      commands_(commands),
      noise_(noise),
      noisy_(noisy),
      T_(1 / nominal->amplifier.switching_frequency),
      M_(nominal->periods_per_control()) {
  for (std::size_t k = 0; k < nominal->bearings.size(); ++k) {
    first_axis_.push_back(axes_.size());
    const std::size_t sides = nominal->bearings[k].Axes().size();
    for (std::size_t side = 0; side < sides; ++side) axes_.push_back({k, side});
  }
  first_axis_.push_back(axes_.size());
  if (commands_.switches.empty() && !commands_.retuned) {
    controller_ = MakeController(nominal, nominal->controller);
  } else {
    auto changing = MakeControllerSwitch(nominal);
    switch_ = changing.get();
    controller_ = std::move(changing);
  }
  for (auto* v : {&readings_, &reference_, &excitation_, &force_}) v->assign(axes_.size(), 0.0);
}

void PositionLoop::Hold(const std::vector<double>& force) {
  force_ = force;
  controller_->Hold(force_, readings_, reference_);
}

void PositionLoop::ReadSensors(const MotionState& motion) {
  plant_.speed_sensor.Read(motion);
  ReadPositions(motion);
}

void PositionLoop::ReadPositions(const MotionState& motion) {
  for (BearingPlant& b : plant_.bearings) {
    PositionSensor& s = b.sensor;
    const PlanePoint p = plant_.rotor.Position(motion, s.map);
    s.reading[0] = p.x;
    s.reading[1] = p.y;
    for (const auto& map : s.maps) map->Map(motion, &s.reading[0], &s.reading[1]);
  }
}

double PositionLoop::Reading(std::size_t axis, long long n) {
  const auto [bearing, side] = axes_[axis];
  const PositionSensor& s = plant_.bearings[bearing].sensor;
  double reading = s.reading[side];
  if (noisy_ && s.noise > 0) reading += s.noise * noise_.Reading(axis, n);
  return s.fault[side].Apply(reading);
}

void PositionLoop::Sample(long long n, double t) {
  reading_time_ = t;
  speed_reading_ = plant_.speed_sensor.reading();
  angle_reading_ = plant_.speed_sensor.angle();
  for (std::size_t a = 0; a < axes_.size(); ++a) {
    readings_[a] = Reading(a, n);
    SensorFault& fault = plant_.bearings[axes_[a].bearing].sensor.fault[axes_[a].side];
    if (!fault.stuck) fault.held = readings_[a];
  }
}

void PositionLoop::Tick(long long n, const std::vector<BearingControl>& control) {
  for (auto* v : {&reference_, &excitation_}) std::fill(v->begin(), v->end(), 0.0);
  if (n >= 0) {
    for (const auto& s : commands_.reference)
      reference_[static_cast<std::size_t>(s.index)] += CommandPlan::At(s, n / M_);
    for (const auto& s : commands_.force)
      excitation_[static_cast<std::size_t>(s.index)] += CommandPlan::At(s, n / M_);
  }
  if (switch_)
    for (const CommandPlan::Switch& s : commands_.switches)
      if (s.tick == n / M_ && n >= 0) switch_->SwitchTo(s.controller);
  controller_->Observe(control, reading_time_);
  controller_->Step(readings_, reference_, excitation_, speed_reading_, force_);
  UnderWay next = std::move(spare_);
  next.due = n + M_;
  next.recorded = false;
  next.values.resize(control.size());
  for (std::size_t k = 0; k < control.size(); ++k) {
    if (const Lane* own = controller_->SetPoints(k)) {
      next.values[k] = *own;
      continue;
    }
    const std::size_t a = first_axis_[k];
    const bool planar = first_axis_[k + 1] > a + 1;
    const double fx = force_[a], fy = planar ? force_[a + 1] : 0;
    auto set =
        control[k].map.SetPoints(fx, fy, planar ? readings_[a] : 0, planar ? readings_[a + 1] : 0);
    if (control[k].current_transition) set = control[k].current_transition->Step(set, {fx, fy});
    for (int j = 0; j < kLanes; ++j) next.values[k][j] = set[j];
  }
  under_way_.push_back(std::move(next));
}

void PositionLoop::TakeOver(std::unique_ptr<PositionController> controller) {
  Require(switch_ != nullptr, "a scenario that changes controllers");
  switch_->SwitchTo(switch_->Add(std::move(controller)));
}

void PositionLoop::Apply(long long n, std::vector<BearingControl>& control) {
  std::size_t done = 0;
  for (UnderWay& u : under_way_) {
    if (u.due > n) break;
    if (!u.recorded)
      for (std::size_t k = 0; k < control.size(); ++k) control[k].set_point = u.values[k];
    u.recorded = true;
    if (static_cast<double>(u.due) * T_ + plant_.loop_delay >
        static_cast<double>(n) * T_ + kSameTime)
      continue;
    for (std::size_t k = 0; k < control.size(); ++k) control[k].commanded = u.values[k];
    ++done;
  }
  if (done > 0) spare_ = std::move(under_way_.front());
  under_way_.erase(under_way_.begin(), under_way_.begin() + static_cast<std::ptrdiff_t>(done));
}

}  // namespace ambrig
