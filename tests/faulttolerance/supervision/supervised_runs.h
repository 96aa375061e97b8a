#pragma once
/// Whole runs of the reference rig under the supervisor: noise, gravity, 20 coils.
#include "faulttolerance/supervision/fault_supervisor.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "fdd/detectors/coil_detector.h"
#include "rig/rig_file.h"
#include "simulation/simulate.h"
#include "simulation/switching/switching_engine.h"
#include "simulation/verdict/detection_score.h"

namespace ambrig {

// examples/reference/rig.toml.
inline constexpr const char* kRig = R"(
name = "reference"
gravity = [0.0, -9.81, 0.0]
[rotor]
kind = "rigid"
mass = { value = 4.2, sd = 0.01 }
inertia_transverse = { value = 0.036, sd = 0.0003 }
inertia_polar = { value = 0.0042, sd = 0.00005 }
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
pole_area = { value = 2.0372e-4, sd = 1.0e-6 }
gap = { value = 4.0e-4, sd = 4.0e-6 }
leakage_inductance = { value = 3.5e-4, sd = 2.0e-5 }
resistance = { value = 0.5, sd = 0.01 }
sensor = { z = -0.135, noise = 2.0e-7 }
auxiliary = { clearance = 2.0e-4, stiffness = 2.0e7, exponent = 1.0, damping = 0.5, friction = 0.15 }
[bearings.B]
like = "A"
z = 0.130
sensor = { z = 0.145, noise = 2.0e-7 }
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
auxiliary = { clearance = 2.5e-4, stiffness = 2.0e7, exponent = 1.0, damping = 0.5, friction = 0.15 }
[detection]
kind = "coupled"
)";

inline const RigParameters& Rig() {
  static const RigParameters rig = ReadRigText(kRig, "rig.toml");
  return rig;
}

/// Maker's drawing plus one draw of its tolerances, times `sigmas`.
inline RigParameters Drawn(unsigned seed, double sigmas) {
  RigParameters truth = Rig();
  std::mt19937 g(seed);
  std::normal_distribution<double> normal;
  for (const Tolerance& t : Rig().tolerances)
    if (const double* value = ParameterAt(truth, t.path))
      SetParameter(truth, t.path, *value + sigmas * t.sd * normal(g));
  return truth;
}

struct Outcome {
  Scenario scenario;
  RunResult result;
  double coil_periods = 0;
  std::string Class(const std::string& target) const {
    for (const RunEvent& e : result.events)
      if (e.kind == "classified" && e.target == target) return e.fault_class;
    return "";
  }
  double Fraction(const std::string& target) const {
    for (const RunEvent& e : result.events)
      if (e.kind == "classified" && e.target == target) return e.fraction;
    return -1;
  }
  double When(const std::string& kind) const {
    for (const RunEvent& e : result.events)
      if (e.kind == kind) return e.t;
    return kInfinity;
  }
};

inline Outcome Simulated(const std::string& scenario, const RigParameters& truth,
                         bool redistribute = true, bool slopes = false) {
  Outcome o;
  o.scenario = ReadScenarioText("name = \"t\"\n" + scenario, "t.toml", Rig());
  FaultSupervisorOptions options;
  options.redistribute = redistribute;
  options.slopes = slopes;
  options.cache_dir = ::testing::TempDir() + "ambrig_fdd_tables";  // solved once, then read
  RigParameters nominal = Rig();
  nominal.detection = truth.detection;
  FaultSupervisor supervisor(NominalRig(nominal), options);
  EngineOptions engine;
  engine.record = false;
  engine.supervisor = &supervisor;
  o.result = SwitchingEngine(truth, o.scenario, engine).Run();
  ScoreDetection(o.scenario, o.result);
  o.coil_periods = supervisor.coil_periods();
  return o;
}

inline std::string FaultTable(double t, const std::string& target, const std::string& kind,
                              const std::string& parameters = "") {
  return fmt::format("[[fault]]\ntime = {:.9f}\ntarget = \"{}\"\nkind = \"{}\"\n{}\n", t, target,
                     kind, parameters.empty() ? "" : "parameters = { " + parameters + " }");
}
inline std::string Spin(double seconds, double Omega, unsigned seed) {
  return fmt::format("duration = {}\nseed = {}\n[speed]\nprofile = [[0.0, {}], [10.0, {}]]\n",
                     seconds, seed, Omega, Omega);
}

}  // namespace ambrig
