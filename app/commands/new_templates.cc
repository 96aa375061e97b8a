#include "app/commands/new_templates.h"

#include <fmt/format.h>

#include "core/base/errors.h"

namespace ambrig {

namespace {

const BenchNumber kMass{"mass", "kg", "of what is levitated", 1e-4, 1e5};
const BenchNumber kBus{"bus_voltage", "V", "supply of the amplifiers", 1e-1, 1e4};
const BenchNumber kMost{"i_max", "A", "largest current of a coil", 1e-3, 1e4};
const BenchNumber kResistance{"resistance", "ohm", "of one coil", 1e-4, 1e4};
const BenchNumber kSwitching{"switching_frequency", "Hz", "of the amplifiers", 100, 1e6, 25000};
const BenchNumber kRate{"controller_rate", "Hz", "of the position loop", 10, 1e6, 12500};
const BenchNumber kSpan{"span", "m", "between the planes of the two bearings", 1e-3, 10};
const BenchNumber kInertia{"inertia_transverse", "kg m2", "about the centre of mass", 1e-9, 1e5};
const BenchNumber kTurns{"turns", "-", "of one pole", 1, 1e4};
const BenchNumber kArea{"pole_area", "m2", "of one pole's face", 1e-8, 1};
const BenchNumber kGapOfBench{"gap", "m", "rotor centred", 1e-6, 1e-1};
const BenchNumber kBiasCurrent{"bias_current", "A", "of every coil", 1e-3, 1e3};

constexpr std::string_view kShaft = R"([rotor]
kind = "rigid"
mass = {mass}                          # kg
inertia_transverse = {inertia_transverse}    # kg m2 about the centre of mass
inertia_polar = {inertia_polar}          # kg m2, taken as a tenth of it
journal_radius = {journal_radius}        # m, taken as a twentieth of the span
)";

constexpr std::string_view kBridges = R"([amplifier]
modulation = "two-level"
quadrants = {quadrants}
bus_voltage = {bus_voltage}              # V
switching_frequency = {switching_frequency}  # Hz
kp = {loop_kp}                       # V/A: 1.2 of the leakage inductance times the switching frequency
ki = {loop_ki}                       # V/(A s): kp times R/L
adc_samples_per_period = 18
adc_bits = 12
adc_range = {adc_range}                # A, taken as 1.5 i_max
current_noise = {current_noise}        # A rms, taken as 1e-3 i_max
bus_noise = {bus_noise}              # V rms, taken as 7e-4 of the bus voltage
adc_jitter = 2.0e-8                  # s rms, one clock for all samples
edge_jitter = 2.0e-8                 # s rms, of the instants at which a bridge switches
edge_spread = 5.0e-8                 # s, sd over the coils: dead times known to 50 ns
current_gain_spread = 0.005          # sd over the coils
i_max = {i_max}                      # A

[detection]
computing_time = {period}              # s, from a measurement to the actions that follow from it
)";

constexpr std::string_view kAround =
    R"(sensor = {{ z = {za}, noise = {sensor_noise} }}  # m, m rms: taken as 5e-4 of the gap
auxiliary = {{ clearance = {clearance}, stiffness = 1.0e7, damping = 0.5, friction = 0.15 }}  # taken as half of the gap

[bearings.B]
like = "A"
z = {zb}                             # m
sensor = {{ z = {zb}, noise = {sensor_noise} }}
)";

/// `head`: kind, template and what else a radial bearing of this bench has.
std::string TwoBearings(const std::string& head) {
  return "[bearings.A]\n" + head + R"(z = {za}                            # m, half of the span
turns = {turns}
pole_area = {pole_area}                # m2
gap = {{ value = {gap}, sd = {gap_sd} }}     # m, known within 2 %
leakage_inductance = {leakage}         # H, taken as a tenth of a pole's inductance
resistance = {{ value = {resistance}, sd = {resistance_sd} }}  # ohm, known within 2 %
)" + std::string(kAround);
}

std::vector<BenchNumber> ShaftNumbers(const std::vector<BenchNumber>& more) {
  std::vector<BenchNumber> all = {kMass, kSpan, kInertia, kTurns, kArea, kGapOfBench, kResistance};
  all.insert(all.end(), more.begin(), more.end());
  for (const BenchNumber& n : {kBus, kMost, kSwitching, kRate}) all.push_back(n);
  return all;
}

BenchTemplate OneAxis() {
  return {"one-axis",
          "a body under one magnet: L(gap) = L_inf + L_0/(1 + gap/g_c)",
          {kMass,
           {"gap", "m", "from the magnet, where the body is to hover", 1e-5, 1},
           kResistance,
           {"inductance_far", "H", "of the coil, body far away (L_inf)", 1e-9, 1e3},
           {"inductance_near", "H", "that the body adds at the magnet (L_0)", 1e-9, 1e3},
           {"gap_constant", "m", "gap at which half of L_0 is left (g_c)", 1e-6, 10},
           kBus,
           kMost,
           {"switching_frequency", "Hz", "of the amplifier", 100, 1e6, 10000},
           {"controller_rate", "Hz", "of the position loop", 10, 1e6, 1000}},
          R"([rotor]
kind = "point"
mass = {mass}                          # kg
)",
          R"([amplifier]
modulation = "chopper"
bus_voltage = {bus_voltage}              # V
switching_frequency = {switching_frequency}  # Hz
duty_limits = [0.0, 1.0]
bandwidth = {bandwidth}                # Hz of the current loop, taken as 5 % of the switching frequency
adc_samples_per_period = 18
adc_bits = 12
adc_range = {adc_range}                # A, taken as 1.5 i_max
current_noise = {current_noise}        # A rms, taken as 1e-3 i_max
i_max = {i_max}                      # A
)",
          R"([bearings.M]
kind = "opposed"
coils = 1
angle_deg = 90.0                       # the magnet stands above: x points up
gap = {gap}                          # m
resistance = {{ value = {resistance}, sd = {resistance_sd} }}  # ohm, known within 2 %
inductance_far = {{ value = {inductance_far}, sd = {far_sd} }}  # H, known within 10 %
inductance_near = {{ value = {inductance_near}, sd = {near_sd} }}
gap_constant = {{ value = {gap_constant}, sd = {constant_sd} }}
sensor = {{ noise = {sensor_noise} }}      # m rms, taken as 5e-4 of the gap
)",
          true};
}

std::vector<BenchTemplate> MakeBenchTemplates() {
  static const std::string pairs =
      TwoBearings("kind = \"stator\"\ntemplate = \"series-pairs\"\npoles = 8\n");
  static const std::string spindle = TwoBearings("kind = \"radial\"\nwinding = \"NSNSNSNS\"\n");
  static const std::string magnet = TwoBearings(
      "kind = \"stator\"\ntemplate = \"homopolar-pm\"\ncoils = \"pair\"\nbias = {{ mmf = "
      "{magnet_mmf}, length = {magnet_length}, area = {magnet_area}, mu_r = 1.05 }}\n");
  static const std::string thrust = spindle + R"(
[bearings.Z]
kind = "thrust"
turns = {thrust_turns}
pole_area = {thrust_area}              # m2 per ring
gap = {thrust_gap}                     # m
leakage_inductance = {thrust_leakage}  # H, taken as a tenth of a side's inductance
resistance = {resistance}              # ohm, as of the radial coils
bias_current = {thrust_bias}           # A
sensor = {{ noise = {sensor_noise} }}
auxiliary = {{ clearance = {thrust_clearance}, stiffness = 1.0e7, damping = 0.5, friction = 0.15 }}
controller = {{ kp = {z.kp}, kd = {z.kd}, ki = {z.ki}, derivative_time_constant = {z.tau}, f_max = {z.f_max} }}
)";
  return {
      OneAxis(),
      {"two-axis", "a shaft in two bearings of eight poles on four amplifiers each",
       ShaftNumbers({kBiasCurrent}), kShaft, kBridges, pairs},
      {"spindle", "a shaft in two bearings of eight poles, each with its amplifier",
       ShaftNumbers({kBiasCurrent}), kShaft, kBridges, spindle},
      {"homopolar", "a shaft in two homopolar bearings biased by magnets",
       ShaftNumbers({{"magnet_mmf", "A", "H_c times length", 1, 1e6},
                     {"magnet_length", "m", "along the flux", 1e-5, 1},
                     {"magnet_area", "m2", "across the flux", 1e-8, 1}}),
       kShaft, kBridges, magnet},
      {"thrust", "the spindle with a thrust bearing",
       ShaftNumbers({kBiasCurrent,
                     {"thrust_turns", "-", "of one of a side's two windings", 1, 1e4},
                     {"thrust_area", "m2", "of one ring", 1e-8, 1},
                     {"thrust_gap", "m", "each side", 1e-6, 1e-1},
                     {"thrust_bias", "A", "of every winding", 1e-3, 1e3}}),
       kShaft, kBridges, thrust},
  };
}

}  // namespace

const std::vector<BenchTemplate>& BenchTemplates() {
  static const std::vector<BenchTemplate> all = MakeBenchTemplates();
  return all;
}

const BenchTemplate& BenchTemplateByName(const std::string& name) {
  std::string names;
  for (const BenchTemplate& t : BenchTemplates()) {
    if (t.name == name) return t;
    names += (names.empty() ? "" : ", ") + std::string(t.name);
  }
  throw InputError(fmt::format("template = \"{}\", allowed: {}", name, names));
}

}  // namespace ambrig
