/// Every mistake in a file ends with one line "file:line: key = value, allowed ...", exit code 2 and no
/// file written. One row per mistake; each table of a rig or scenario has rows for a wrong key, type, range
/// and contradiction.
#include "tests/cli/cli_run.h"

namespace ambrig {
namespace {

/// In the reference rig `from` becomes `to`; with an empty `from`, `to` is appended to the scenario.
struct Mistake {
  const char *name, *from, *to;
  std::vector<const char*> said;  // parts of the line, in this order
};

void PrintTo(const Mistake& m, std::ostream* out) { *out << m.name; }

const Mistake kRigMistakes[] = {
    // rotor
    {"RotorKey", "journal_radius = 0.030", "jurnal_radius = 0.030", {"rig.toml:10: rotor.jurnal_radius", "did you mean journal_radius?", "allowed"}},
    {"RotorUnknownKey", "journal_radius = 0.030", "journal_radius = 0.030\ncolour = 1", {"rig.toml:11: rotor.colour", "unknown key", "allowed"}},
    {"RotorType", "mass = { value = 4.2, sd = 0.01 }", "mass = \"heavy\"", {"rig.toml:7: rotor.mass = 'heavy'", "allowed: a number"}},
    {"RotorNegativeMass", "value = 4.2", "value = -4.2", {"rig.toml:7: rotor.mass = -4.2 kg", "allowed"}},
    {"RotorNan", "value = 4.2", "value = nan", {"rig.toml:7: rotor.mass = nan", "allowed"}},
    {"RotorInf", "journal_radius = 0.030", "journal_radius = inf", {"rig.toml:10: rotor.journal_radius = inf m", "allowed"}},
    {"RotorHugeInteger", "journal_radius = 0.030", "journal_radius = 9223372036854775807", {"rig.toml:10: rotor.journal_radius = 9.223372036854776e+18 m", "allowed"}},
    {"RotorSd", "sd = 0.01 }            # kg", "sd = -1 }", {"rig.toml:7: rotor.mass.sd", "allowed: a number of 0 or more"}},
    {"RotorSdKey", "sd = 0.01 }            # kg", "sigma = 1 }", {"rig.toml:7: rotor.mass.sigma", "allowed: value, sd"}},
    {"RotorKind", "kind = \"rigid\"", "kind = \"rigit\"", {"rig.toml:6: rotor.kind = \"rigit\"", "allowed", "rigid"}},
    {"RotorPlate", "value = 0.0042", "value = 0.08", {"rig.toml:9: rotor.inertia_polar = 0.08 kg m2", "allowed: at most twice"}},
    {"Gravity", "gravity = [0.0, -9.81, 0.0]", "gravity = [0.0, -9.81]", {"rig.toml:3: gravity", "allowed"}},
    {"RootKey", "name = \"reference\"", "nane = \"reference\"", {"rig.toml:2: nane", "unknown key", "did you mean name?"}},
    // amplifier
    {"AmplifierModulation", "modulation = \"bi-state\"", "modulation = \"bistate\"", {"rig.toml:13: amplifier.modulation = \"bistate\"", "allowed: bi-state", "did you mean bi-state?"}},
    {"AmplifierBus", "bus_voltage = 30.0", "bus_voltage = 0.0", {"rig.toml:14: amplifier.bus_voltage = 0 V", "allowed"}},
    {"AmplifierMissing", "bus_voltage = 30.0", "", {"rig.toml:12: amplifier.bus_voltage", "is missing", "allowed"}},
    {"AmplifierNan", "kp = 4.0 ", "kp = nan ", {"rig.toml:19: amplifier.kp = nan", "allowed"}},
    {"AmplifierDuty", "duty_limits = [0.02, 0.98]", "duty_limits = [0.98, 0.02]", {"rig.toml:18: amplifier.duty_limits", "allowed: [min, max]"}},
    {"AmplifierDutyType", "duty_limits = [0.02, 0.98]", "duty_limits = 0.98", {"rig.toml:18: amplifier.duty_limits = 0.98", "allowed: an array of numbers"}},
    {"AmplifierHalfSample", "adc_samples_per_period = 18", "adc_samples_per_period = 17.5", {"rig.toml:21: amplifier.adc_samples_per_period = 17.5", "allowed: an integer"}},
    {"AmplifierAdcBelowCurrent", "adc_range = 10.0", "adc_range = 5.0", {"rig.toml:25: amplifier.i_max = 6 A", "allowed: at most adc_range = 5 A"}},
    {"AmplifierQuadrants", "i_max = 6.0", "i_max = 6.0\nquadrants = 3", {"rig.toml:26: amplifier.quadrants = 3", "allowed: 2 or 4"}},
    {"AmplifierKey", "adc_bits = 12", "adc_bit = 12", {"rig.toml:22: amplifier.adc_bit", "did you mean adc_bits?"}},
    // controller
    {"ControllerRate", "rate = 12500.0", "rate = 11000.0", {"rig.toml:29: controller.rate = 11000 Hz", "allowed: the switching frequency of 25000 Hz over an integer"}},
    {"ControllerInf", "kd = 900.0 ", "kd = inf ", {"rig.toml:31: controller.kd = inf N s/m", "allowed"}},
    {"ControllerForce", "f_max = 60.0 ", "f_max = -60.0 ", {"rig.toml:34: controller.f_max = -60 N", "allowed"}},
    {"ControllerType", "kp = 4.0e5 ", "kp = true ", {"rig.toml:30: controller.kp = true", "allowed: a number"}},
    {"ControllerKey", "f_max = 60.0 ", "f_max = 60.0\nfmax = 2 ", {"rig.toml:35: controller.fmax", "did you mean f_max?"}},
    // radial bearing
    {"RadialGap", "value = 4.0e-4", "value = -4.0e-4", {"rig.toml:45: bearings.A.gap = -0.0004 m", "allowed"}},
    {"RadialClearance", "clearance = 2.0e-4", "clearance = 5.0e-4", {"rig.toml:49: bearings.A.auxiliary.clearance = 0.0005 m", "allowed: smaller than the gap of 0.0004 m"}},
    {"RadialLeakage", "value = 3.5e-4", "value = 0.0", {"rig.toml:46: bearings.A.leakage_inductance = 0 H", "allowed"}},
    {"RadialWinding", "winding = \"NSNSNSNS\"", "winding = \"NSNSNSN\"", {"rig.toml:42: bearings.A.winding = \"NSNSNSN\"", "allowed: eight letters"}},
    {"RadialPoles", "poles = 8", "poles = 12", {"rig.toml:40: bearings.A.poles = 12", "allowed: 8"}},
    {"RadialKey", "turns = 50", "truns = 50", {"rig.toml:43: bearings.A.truns", "did you mean turns?", "allowed"}},
    {"RadialSensorMissing", "sensor = { z = -0.135, noise = 2.0e-7 }", "", {"rig.toml:37: bearings.A.sensor", "is missing", "allowed"}},
    {"RadialSensorNoise", "noise = 2.0e-7 }               # m, m rms", "noise = -2.0e-7 }", {"rig.toml:48: bearings.A.sensor.noise = -2e-07 m", "allowed"}},
    {"RadialSensorKey", "noise = 2.0e-7 }               # m, m rms", "nois = 2.0e-7 }", {"rig.toml:48: bearings.A.sensor.nois", "did you mean noise?"}},
    {"RadialNoPlace", "z = -0.120", "", {"rig.toml:37: bearings.A.z", "is missing", "allowed"}},
    {"RadialSamePlane", "z = 0.130", "z = -0.120", {"bearings.", ".z = -0.12 m", "allowed: another plane"}},
    {"AuxiliaryExponent", "exponent = 1.0, damping = 0.5, friction = 0.15 }  #", "exponent = 0.5, damping = 0.5, friction = 0.15 }  #", {"rig.toml:49: bearings.A.auxiliary.exponent = 0.5", "allowed 1 to 3"}},
    {"AuxiliaryKey", "damping = 0.5, friction = 0.15 }  #", "dampening = 0.5, friction = 0.15 }  #", {"rig.toml:49: bearings.A.auxiliary.dampening", "did you mean damping?"}},
    {"LikeNobody", "like = \"A\"", "like = \"C\"", {"rig.toml:52: bearings.B.like = \"C\"", "allowed"}},
    {"OneBearing", "[bearings.B]\nlike = \"A\"                                   # same values, other places\nz = 0.130\nsensor = { z = 0.145, noise = 2.0e-7 }", "",
     {"rig.toml:37: bearings", "at least two radial bearings"}},
    // thrust bearing
    {"ThrustTurns", "turns = 80", "turns = 0", {"rig.toml:59: bearings.Z.turns = 0", "allowed"}},
    {"ThrustBias", "bias_current = 1.5", "bias_current = \"1.5 A\"", {"rig.toml:64: bearings.Z.bias_current = '1.5 A'", "allowed: a number"}},
    {"ThrustController", "derivative_time_constant = 1.5e-4, f_max = 120.0", "f_max = 120.0", {"rig.toml:66: bearings.Z.controller.derivative_time_constant", "missing"}},
    {"ThrustStop", "clearance = 2.5e-4", "clearance = 5.5e-4", {"rig.toml:67: bearings.Z.auxiliary.clearance", "allowed: smaller than the gap"}},
    {"BearingKind", "kind = \"thrust\"", "kind = \"axial\"", {"rig.toml:58: bearings.Z.kind = \"axial\"", "allowed: radial, thrust, opposed"}},
    // effects
    {"EffectName", "# Omit", "[[effect]]\nname = \"eddy-curents\"\ntarget = \"A\"\n# Omit", {"rig.toml:57: effect[1].name = \"eddy-curents\"", "did you mean eddy-currents?"}},
    {"EffectTarget", "# Omit", "[[effect]]\nname = \"eddy-currents\"\ntarget = \"C\"\n# Omit", {"rig.toml:58: effect[1].target = \"C\"", "allowed"}},
    {"EffectParameter", "# Omit", "[[effect]]\nname = \"eddy-currents\"\ntarget = \"A\"\nparameters = { cut = 1.0 }\n# Omit", {"rig.toml:59: effect[1].parameters.cut", "allowed"}},
    {"EffectRange", "# Omit", "[[effect]]\nname = \"eddy-currents\"\ntarget = \"A\"\nparameters = { cutoff = -1.0 }\n# Omit", {"rig.toml:59: effect[1].parameters.cutoff = -1 Hz", "allowed"}},
    {"EffectNan", "# Omit", "[[effect]]\nname = \"eddy-currents\"\ntarget = \"A\"\nparameters = { cutoff = nan }\n# Omit", {"rig.toml:59: effect[1].parameters.cutoff = nan", "allowed"}},
};

const Mistake kScenarioMistakes[] = {
    {"RootUnknown", "", "sed = 1", {"s.toml:5: sed", "unknown key", "did you mean seed?"}},
    {"RootSeed", "", "seed = -1", {"s.toml:5: seed = -1", "allowed: 0 or more"}},
    {"RootSeedType", "", "seed = 1.5", {"s.toml:5: seed = 1.5", "allowed: an integer"}},
    {"RootNoise", "", "noise = 1", {"s.toml:5: noise = 1", "allowed: true or false"}},
    {"RootDropLimit", "", "drop_limit = 0.0", {"s.toml:5: drop_limit = 0 s", "allowed"}},
    {"StartState", "", "[start]\nstate = \"flying\"", {"s.toml:6: start.state = \"flying\"", "allowed: levitated, resting, clamped"}},
    {"StartPosition", "", "[start]\nstate = \"levitated\"\nposition = { A = [0.0, 0.0] }", {"s.toml:7: start.position", "allowed with state = \"clamped\""}},
    {"StartOutsideTheGap", "", "[start]\nstate = \"clamped\"\nposition = { A = [5e-4, 0.0] }", {"s.toml:7: start.position.A = [0.0005, 0] m", "allowed: inside the gap of 0.0004 m"}},
    {"StartNoBearing", "", "[start]\nstate = \"clamped\"\nposition = { C = [0.0, 0.0] }", {"s.toml:7: start.position.C", "allowed: A, B, Z"}},
    {"StartNan", "", "[start]\nstate = \"clamped\"\nposition = { A = [nan, 0.0] }", {"s.toml:7: start.position.A", "entry 1 is not a finite number"}},
    {"SpeedBackInTime", "", "[speed]\nprofile = [[0.0, 1.0], [0.2, 2.0], [0.1, 3.0]]", {"s.toml:6: speed.profile", "goes back in time", "allowed: increasing t"}},
    {"SpeedTooFast", "", "[speed]\nprofile = [[0.0, 1e7]]", {"s.toml:6: speed.profile", "Omega = 10000000 rad/s", "allowed"}},
    {"SpeedRow", "", "[speed]\nprofile = [[0.0, 1.0, 2.0]]", {"s.toml:6: speed.profile", "row 1 has 3 entries", "allowed: [t, Omega]"}},
    {"SpeedNan", "", "[speed]\nprofile = [[0.0, nan]]", {"s.toml:6: speed.profile", "row 1 is not an array of finite numbers"}},
    {"SpeedMissing", "", "[speed]\nfree_from = 1.0", {"s.toml:5: speed.profile", "is missing", "allowed"}},
    {"SpeedFreeNan", "", "[speed]\nprofile = [[0.0, 1.0]]\nfree_from = nan", {"s.toml:7: speed.free_from = nan", "allowed"}},
    {"ExcitationPort", "", "[[excitation]]\ntarget = \"A.x\"\nport = \"voltage\"", {"s.toml:7: excitation[1].port = \"voltage\"", "allowed: force, reference, current, duty"}},
    {"ExcitationTarget", "", "[[excitation]]\ntarget = \"C.x\"\nkind = \"step\"\namplitude = 1.0", {"s.toml:6: excitation[1].target = \"C.x\" on port force", "allowed: A.x"}},
    {"ExcitationCoilOnForce", "", "[[excitation]]\ntarget = \"A.coil1\"\nkind = \"step\"\namplitude = 1.0", {"s.toml:6: excitation[1].target = \"A.coil1\"", "allowed: A.x"}},
    {"ExcitationKind", "", "[[excitation]]\ntarget = \"A.x\"\nkind = \"stepp\"\namplitude = 1.0", {"s.toml:7: excitation[1].kind = \"stepp\"", "did you mean step?"}},
    {"ExcitationTimes", "", "[[excitation]]\ntarget = \"A.x\"\nkind = \"step\"\namplitude = 1.0\nstart = 0.2\nstop = 0.1", {"s.toml:10: excitation[1].stop = 0.1", "allowed: later than start = 0.2"}},
    {"ExcitationAmplitude", "", "[[excitation]]\ntarget = \"A.x\"\nkind = \"step\"", {"s.toml:5: excitation[1].amplitude", "is missing", "allowed"}},
    {"ExcitationFrequencyInf", "", "[[excitation]]\ntarget = \"A.x\"\nkind = \"sine\"\namplitude = 1.0\nfrequency = inf", {"s.toml:9: excitation[1].frequency = inf", "allowed: a finite number"}},
    {"ExcitationPhases", "", "[[excitation]]\ntarget = \"A.x\"\nkind = \"multisine\"\namplitude = 1.0\nfrequencies = [1.0, 2.0]\nphases = [0.0]", {"s.toml:10: excitation[1].phases", "has 1 entry, allowed: 2"}},
    {"ExcitationNoFile", "", "[[excitation]]\ntarget = \"A.x\"\nkind = \"samples\"\nfile = \"none.h5\"\nchannel = \"f\"", {"none.h5"}},
    {"LoadForce", "", "[[load]]\nplane = \"A\"\nforce = [1.0, 2.0, 3.0, 4.0]", {"s.toml:7: load[1].force", "allowed: [fx, fy]"}},
    {"LoadInf", "", "[[load]]\nplane = \"A\"\nforce = [inf, 0.0]", {"s.toml:7: load[1].force", "entry 1 is not a finite number"}},
    {"LoadPlane", "", "[[load]]\nplane = \"C\"\nforce = [1.0, 0.0]", {"s.toml:6: load[1].plane = \"C\"", "allowed: A, B, Z"}},
    {"LoadBoth", "", "[[load]]\nplane = \"A\"\nz = 0.1\nforce = [1.0, 0.0]", {"s.toml:6: load[1].plane", "allowed: either"}},
    {"LoadPlaceInf", "", "[[load]]\nz = inf\nforce = [1.0, 0.0]", {"s.toml:6: load[1].z = inf", "allowed"}},
    {"LoadTimes", "", "[[load]]\nplane = \"A\"\nforce = [1.0, 0.0]\nstart = 0.5", {"load[1].stop", "allowed: later than start"}},
    {"LoadNotATable", "", "load = 3", {"s.toml:5: load", "allowed: tables"}},
    {"FaultCoilNine", "", "[[fault]]\ntime = 0.005\ntarget = \"A.coil9\"\nkind = \"open\"", {"s.toml:7: fault[1].target = \"A.coil9\" with kind open", "allowed: A.coil1"}},
    {"FaultOnAnAxis", "", "[[fault]]\ntime = 0.005\ntarget = \"A.x\"\nkind = \"open\"", {"s.toml:7: fault[1].target = \"A.x\"", "allowed: A.coil1"}},
    {"FaultTime", "", "[[fault]]\ntime = 0.01\ntarget = \"A.coil1\"\nkind = \"open\"", {"s.toml:6: fault[1].time = 0.01 s", "allowed: 0 to below the duration of 0.01 s"}},
    {"FaultTimeNan", "", "[[fault]]\ntime = nan\ntarget = \"A.coil1\"\nkind = \"open\"", {"s.toml:6: fault[1].time = nan", "allowed"}},
    {"FaultKind", "", "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"opn\"", {"s.toml:8: fault[1].kind = \"opn\"", "did you mean open?"}},
    {"FaultFraction", "", "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"partial-short\"\nparameters = { fraction = 1.0 }", {"s.toml:9: fault[1].parameters.fraction = 1", "allowed: above 0 to below 1"}},
    {"FaultNoFraction", "", "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"partial-short\"", {"s.toml:5: fault[1].parameters", "fraction is missing", "allowed"}},
    {"FaultResistance", "", "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"partial-short\"\nparameters = { fraction = 0.5, short_resistance = -1.0 }", {"s.toml:9: fault[1].parameters.short_resistance = -1 ohm", "allowed: 0 to inf"}},
    {"FaultHalfAKey", "", "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"current-sensor\"\nparameters = { gai = 0.5 }", {"s.toml:9: fault[1].parameters.gai", "unknown key", "allowed with kind current-sensor: gain, offset, stuck"}},
    {"FaultNothing", "", "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"current-sensor\"", {"s.toml:5: fault[1].parameters", "change nothing", "allowed with kind current-sensor"}},
    {"FaultOffsetInf", "", "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"current-sensor\"\nparameters = { offset = inf }", {"s.toml:9: fault[1].parameters.offset = inf", "allowed"}},
    {"FaultStuckNumber", "", "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"current-sensor\"\nparameters = { stuck = 0.5 }", {"s.toml:9: fault[1].parameters.stuck = 0.5", "allowed: true or false"}},
    {"FaultSag", "", "[[fault]]\ntime = 0.0\nkind = \"bus-sag\"\nparameters = { voltage = -3.0 }", {"s.toml:8: fault[1].parameters.voltage = -3 V", "allowed: 0 to 100000 V"}},
    {"FaultOpenParameters", "", "[[fault]]\ntime = 0.0\ntarget = \"A.coil1\"\nkind = \"open\"\nparameters = { fraction = 0.5 }", {"s.toml:9: fault[1].parameters.fraction", "allowed with kind open: none"}},
    {"ExpectKey", "", "[expect]\ntouchdwn = false", {"s.toml:6: expect.touchdwn", "did you mean touchdown?"}},
    {"ExpectType", "", "[expect]\ntouchdown = 0", {"s.toml:6: expect.touchdown = 0", "allowed: true or false"}},
    {"ExpectNan", "", "[expect]\nmax_orbit = nan", {"s.toml:6: expect.max_orbit = nan", "allowed"}},
    {"ExpectClass", "", "[expect]\nclassified = \"shorted\"", {"s.toml:6: expect.classified = \"shorted\"", "allowed: open, partial-short"}},
};

class Messages : public CliFolder, public testing::WithParamInterface<Mistake> {
 protected:
  void ExpectOneLine(const Outcome& o) const {
    EXPECT_EQ(o.exit, 2) << o.text;
    EXPECT_EQ(o.lines(), 1) << o.text;
    EXPECT_EQ(Files(), "rig.toml s.toml ") << o.text;
    std::size_t at = 0;
    for (const char* part : GetParam().said) {
      const std::size_t found = o.text.find(part, at);
      EXPECT_NE(found, std::string::npos) << "no \"" << part << "\" in " << o.text;
      if (found == std::string::npos) return;
      at = found;
    }
  }
};
class RigMessages : public Messages {};
class ScenarioMessages : public Messages {};

TEST_P(RigMessages, OneLine) {
  ExpectOneLine(Run(Replaced(ReferenceRigText(), GetParam().from, GetParam().to), ScenarioText("")));
}
TEST_P(ScenarioMessages, OneLine) { ExpectOneLine(Run(ReferenceRigText(), ScenarioText(GetParam().to + std::string("\n")))); }

std::string NameOf(const testing::TestParamInfo<Mistake>& which) { return which.param.name; }
INSTANTIATE_TEST_SUITE_P(Table, RigMessages, testing::ValuesIn(kRigMistakes), NameOf);
INSTANTIATE_TEST_SUITE_P(Table, ScenarioMessages, testing::ValuesIn(kScenarioMistakes), NameOf);

class BaseKeys : public CliFolder {};
// What the scenario's own first lines may get wrong.
TEST_F(BaseKeys, OneLineEach) {
  const std::pair<const char*, const char*> replaced[] = {
      {"duration = 0.01", "duration = 0.0"}, {"duration = 0.01", "duration = inf"}, {"duration = 0.01", "duration = nan"},
      {"record_rate = 12500.0", "record_rate = 13000.0"}, {"record_rate = 12500.0", "record_rate = -1.0"},
      {"record_rate = 12500.0", "record_rate = inf"}, {"name = \"t\"", "name = 3"}};
  for (const auto& [from, to] : replaced) {
    const Outcome o = Run(ReferenceRigText(), Replaced(ScenarioText(""), from, to));
    EXPECT_EQ(o.exit, 2) << to << ": " << o.text;
    EXPECT_EQ(o.lines(), 1) << o.text;
    EXPECT_NE(o.text.find("s.toml:"), std::string::npos) << o.text;
    EXPECT_NE(o.text.find("allowed"), std::string::npos) << o.text;
    EXPECT_EQ(Files(), "rig.toml s.toml ");
  }
}

}  // namespace
}  // namespace ambrig
