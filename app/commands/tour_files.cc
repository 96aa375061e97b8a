#include "app/commands/tour_files.h"

namespace ambrig {

namespace {

constexpr std::string_view kRig = R"(# made by ambrig tour
# Reference rig. Any number may be written as { value = ..., sd = ... }: sd is how well the maker knows it.
name = "reference"
gravity = [0.0, -9.81, 0.0]                  # m/s2

[rotor]
kind = "rigid"
mass = { value = 4.2, sd = 0.01 }            # kg
inertia_transverse = { value = 0.036, sd = 0.0003 }   # kg m2 about the centre of mass
inertia_polar = { value = 0.0042, sd = 0.00005 }      # kg m2
journal_radius = 0.030                       # m

[amplifier]
modulation = "bi-state"
bus_voltage = 30.0                           # V
switch_drop = 0.125                          # V per switch
diode_drop = 0.70                            # V per diode
switching_frequency = 25000.0                # Hz
duty_limits = [0.02, 0.98]
kp = 4.0                                     # V/A
ki = 2000.0                                  # V/(A s)
adc_samples_per_period = 18
adc_bits = 12
adc_range = 10.0                             # A
current_noise = 0.004                        # A rms per ADC sample
bus_noise = 0.02                             # V rms per reading
adc_jitter = 2.0e-8                          # s rms, one clock for all samples
edge_jitter = 2.0e-8                         # s rms, of the instants at which a bridge switches
edge_spread = 5.0e-8                         # s, sd over the coils: dead times known to 50 ns
current_gain_spread = 0.005                  # sd over the coils
i_max = 6.0                                  # A

[controller]
kind = "pid"
rate = 12500.0                               # Hz
kp = 4.0e5                                   # N/m   per radial axis
kd = 900.0                                   # N s/m
ki = 6.0e6                                   # N/(m s)
derivative_time_constant = 1.5e-4            # s
f_max = 60.0                                 # N
bias_current = 2.0                           # A (c0)

[detection]
computing_time = 4.0e-5                      # s, one period: from a measurement to the actions that follow from it

[bearings.A]
kind = "radial"
z = -0.120                                   # m, bearing plane
poles = 8
first_pole_angle_deg = 22.5
winding = "NSNSNSNS"
turns = 50
pole_area = { value = 2.0372e-4, sd = 1.0e-6 }        # m2
gap = { value = 4.0e-4, sd = 4.0e-6 }                 # m
leakage_inductance = { value = 3.5e-4, sd = 2.0e-5 }  # H
resistance = { value = 0.5, sd = 0.01 }               # ohm
sensor = { z = -0.135, noise = 2.0e-7 }               # m, m rms
auxiliary = { clearance = 2.0e-4, stiffness = 2.0e7, exponent = 1.0, damping = 0.5, friction = 0.15 }  # m, N/m^n, -, s/m, -

[bearings.B]
like = "A"                                   # same values, other places
z = 0.130
sensor = { z = 0.145, noise = 2.0e-7 }

# Omit [bearings.Z] for a radial-only rig (z is then fixed).
[bearings.Z]
kind = "thrust"
turns = 80
pole_area = 4.0e-4                           # m2 per ring
gap = 5.0e-4
leakage_inductance = 3.0e-4
resistance = 0.6
bias_current = 1.5
sensor = { noise = 2.0e-7 }
controller = { kp = 3.0e5, kd = 900.0, ki = 4.0e6, derivative_time_constant = 1.5e-4, f_max = 120.0 }
auxiliary = { clearance = 2.5e-4, stiffness = 2.0e7, exponent = 1.0, damping = 0.5, friction = 0.15 }
)";

constexpr std::string_view kCoilOpens = R"(# made by ambrig tour: coil A3 breaks at 1500 rpm
name = "coil A3 opens at 1500 rpm"
rig = "rig.toml"
duration = 0.2            # s
record_rate = 12500.0     # Hz

[speed]
profile = [[0.0, 157.08]] # s, rad/s

[[fault]]
time = 0.05               # s
target = "A.coil3"
kind = "open"

[expect]
detected_within = 2.0e-3  # s
classified = "open"
drop = false
)";

constexpr std::string_view kMyFault = R"(# made by ambrig tour: a fault of your own
name = "half of the turns of coil B6 are shorted"
rig = "rig.toml"
duration = 0.2            # s
record_rate = 12500.0     # Hz
fault_tolerance = true    # false: nobody watches the coils

[speed]
profile = [[0.0, 157.08]] # s, rad/s

[[fault]]
time = 0.05               # s
target = "B.coil6"        # A or B, coil 1 to 8
kind = "partial-short"    # open, partial-short, amplifier-off, switch-stuck-on
parameters = { fraction = 0.5 }
)";

}  // namespace

const std::vector<TourFile>& TourFiles() {
  static const std::vector<TourFile> files{
      {"rig.toml", kRig}, {"coil_opens.toml", kCoilOpens}, {"my_fault.toml", kMyFault}};
  return files;
}

}  // namespace ambrig
