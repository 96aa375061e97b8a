#pragma once
/// A rig with bearing planes at z = -0.12 and +0.12 m, a thrust bearing and no gravity: translation
/// and tilt do not couple, so that closed forms of one coordinate hold.
#include <string>
#include <utility>
#include <vector>

#include "effects/catalogue.h"
#include "rig/rig_assembly.h"
#include "rig/rig_file.h"

namespace ambrig::motion {

inline const char* kRigText = R"(
name = "symmetric"
gravity = [0.0, 0.0, 0.0]
[rotor]
kind = "rigid"
mass = 4.2
inertia_transverse = 0.036
inertia_polar = 0.0042
journal_radius = 0.030
[amplifier]
modulation = "bi-state"
bus_voltage = 30.0
switch_drop = 0.125
diode_drop = 0.70
switching_frequency = 25000.0
duty_limits = [0.02, 0.98]
kp = 4.0
ki = 2000.0
adc_samples_per_period = 18
adc_bits = 12
adc_range = 10.0
current_noise = 0.004
i_max = 6.0
[controller]
kind = "pid"
rate = 12500.0
kp = 4.0e5
kd = 900.0
ki = 6.0e6
derivative_time_constant = 1.5e-4
f_max = 60.0
bias_current = 2.0
[bearings.A]
kind = "radial"
z = -0.120
poles = 8
first_pole_angle_deg = 22.5
winding = "NSNSNSNS"
turns = 50
pole_area = 2.0372e-4
gap = 4.0e-4
leakage_inductance = 3.5e-4
resistance = 0.5
sensor = { z = -0.135, noise = 2.0e-7 }
auxiliary = { clearance = 2.0e-4, stiffness = 2.0e7, damping = 0.5, friction = 0.15 }
[bearings.B]
like = "A"
z = 0.120
sensor = { z = 0.135, noise = 2.0e-7 }
[bearings.Z]
kind = "thrust"
turns = 80
pole_area = 4.0e-4
gap = 5.0e-4
leakage_inductance = 3.0e-4
resistance = 0.6
bias_current = 1.5
sensor = { noise = 2.0e-7 }
controller = { kp = 3.0e5, kd = 900.0, ki = 4.0e6, derivative_time_constant = 1.5e-4, f_max = 120.0 }
auxiliary = { clearance = 2.5e-4, stiffness = 2.0e7, damping = 0.5, friction = 0.15 }
)";

inline RigParameters Rig(const std::string& more = "") {
  return ReadRigText(kRigText + more, "rig.toml");
}

struct Named {
  std::string id, target;
  std::vector<std::pair<std::string, double>> values;
};

inline RigParameters RigWith(const std::vector<Named>& effects) {
  RigParameters rig = Rig();
  for (const Named& n : effects) {
    EffectInstance e = MakeInstance(*FindEffect(n.id), n.target);
    for (const auto& [name, value] : n.values) e.Set(name, value);
    rig.effects.push_back(e);
  }
  return rig;
}

inline Plant PlantOf(const std::vector<Named>& effects) {
  return BuildPlant(TrueRig(RigWith(effects)));
}

/// What the sensors of bearing `k` read.
inline std::pair<double, double> Reading(Plant& plant, std::size_t k, const MotionState& state) {
  PositionSensor& s = plant.bearings[k].sensor;
  auto [x, y] = plant.rotor.Position(state, s.map);
  for (const auto& map : s.maps) map->Map(state, &x, &y);
  return {x, y};
}

/// Sums of all force terms.
inline RotorForces Forces(const Plant& plant, const MotionState& state) {
  RotorForces f;
  for (const auto& term : plant.rotor.terms) term->Add(state, f);
  return f;
}

inline DofVector Accelerations(const Plant& plant, const MotionState& state) {
  DofVector a{};
  double torque;
  plant.rotor.Accelerations(state, DofVector{}, 0, 0, a, &torque);
  return a;
}

}  // namespace ambrig::motion
