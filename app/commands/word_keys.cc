#include "app/commands/word_keys.h"

#include <list>
#include <string>
#include <string_view>
#include <vector>

#include "control/interface/controller_kind.h"
#include "fdd/detectors/coil_detector.h"
#include "rig/amplifier_file.h"
#include "rig/bearing_kinds/stator_file.h"
#include "rig/parameters/bearing_kind.h"

namespace ambrig {

namespace {

constexpr char kOfTheCatalogue[] = "";  // filled in from the kinds that are registered

constexpr WordKey kRigWords[] = {
    {"rig file", "name", "text", "of the rig"},
    {"rig file", "gravity", "[x, y, z] m/s2", "acceleration of free fall"},
    {"[rotor]", "kind", "rigid, point, beam", "beam: docs/guide/flexible_rotor.md"},
    {"[rotor]", "file", "a file", "of a beam's sections"},
    {"[rotor]", "modes", "0 to 100", "bending modes of a beam that a run keeps"},
    {"[rotor]", "static_correction", "true, false",
     "of a beam: residual modes keep the static compliance of those dropped at the magnets"},
    {"[rotor]", "modal_damping", "list", "ratio of each bending mode"},
    {"[rotor]", "elements_per_section", "integer", "of a beam"},
    {"[rotor]", "shear, mass, interpolation", "words", "of a beam's elements: docs/guide/shaft.md"},
    {"[rotor]", "element", "two_node, three_node",
     "of a beam: three_node has a node in its middle and is of fourth order with shear, too"},
    {"[[rotor.section]]", "material", "a NAME of [rotor.materials.NAME]", "of the section"},
    {"[[rotor.station]]", "name, z", "text, m", "a plane of the shaft that is recorded"},
    {"[[rotor.support]]", "kxx, kyy, kxy, kyx, kzz, cxx, cyy", "N/m, N s/m, or lists over speeds",
     "spring and damper to the ground or a housing: docs/guide/shaft.md"},
    {"[[rotor.support]]", "speeds, speeds_rpm", "list", "of tables of coefficients"},
    {"[amplifier]", "modulation", kModulations, "docs/guide/files.md"},
    {"[amplifier]", "mode", "current, voltage", "voltage: kp volts per ampere of the set-point"},
    {"[amplifier]", "duty_limits", "[min, max]", "of the duty"},
    {"[controller]", "kind", kOfTheCatalogue, "docs/guide/controllers.md"},
    {"[controller]", "file, address, commands, parameters", "words",
     "of a controller of one's own: docs/guide/controller_in_c.md"},
    {"[controller]", "A, B, C, D, domain", "rows; s, z", "of state-space and transfer-function"},
    {"[controller]", "speeds, model_modes", "list, integer", "of lqg and h-infinity"},
    {"[controller]", "translation, tilt", "tables", "gains of tilt-translation"},
    {"[[controller.plane]]", "at", "a plane", "whose displacement is weighed"},
    {"[[controller.filter]]", "kind, axes", "notch, lead-lag, low-pass; list of axes", "of a PID"},
    {"[controllers.NAME]", "keys of [controller]", "", "to change over to in a run"},
    {"[bearings.NAME]", "kind", kOfTheCatalogue, "of its magnets"},
    {"[bearings.NAME]", "like", "another bearing", "everything that is not given"},
    {"[bearings.NAME]", "z", "m", "plane of the magnets on the shaft axis"},
    {"[bearings.NAME]", "winding", "letters N and S", "sense of the poles"},
    {"[bearings.NAME]", "template", kOfTheCatalogue, "of a stator: docs/guide/files.md"},
    {"[bearings.NAME]", "poles", "a number, or a list of tables", "of a stator"},
    {"[bearings.NAME]", "coils", "a number, or a word of the template", "how windings are joined"},
    {"[bearings.NAME]", "sensor, auxiliary, controller, bias", "tables", "see their numbers"},
    {"[bearings.NAME]", "coil_errors", "{ current_gain, edge }",
     "of this machine, a number per coil: of the measured current's gain [-], of late edges [s]"},
    {"[detection]", "kind", kOfTheCatalogue, "docs/guide/detectors.md"},
    {"[detection]", "commissioning", "a file, none", "default: NAME.commissioning.toml"},
    {"[[effect]]", "name", "of ambrig effects", "physics that the base model leaves out"},
    {"[[effect]]", "target", "bearing, coil, axis, plane, rig", "what it acts on"},
    {"[[effect]]", "parameters", "table", "numbers of the effect"},
    {"[[effect]]", "label, force, reading, voltage, torque", "formulas",
     "a law of one's own: docs/guide/formulas.md"},
};

constexpr WordKey kScenarioWords[] = {
    {"scenario file", "name, rig", "text, a file", "of the run and of its rig"},
    {"scenario file", "duration, record_rate, drop_limit", "s, Hz, s", "of the run"},
    {"scenario file", "seed", "integer", "of the noise"},
    {"scenario file", "noise, fault_tolerance", "true, false", "false: none"},
    {"scenario file", "redistribution", "auto, matrix, force-by-force", "after a coil fault"},
    {"scenario file", "hand_over", "jump, ramp, bias_first, force_preserving, time_optimal",
     "from the old currents to the new ones"},
    {"scenario file", "stiffness_compensation", "true, false", "after a coil fault"},
    {"scenario file", "retuned_controller", "main, a NAME of [controllers.NAME]",
     "designed anew for the coils that are left (lqg, h-infinity)"},
    {"[start]", "state", "levitated, resting, clamped", "at t = 0"},
    {"[start]", "position, current", "{ A = [x, y] } m, { \"A.coil1\" = i } A", "of a clamped one"},
    {"[speed]", "profile, free_from", "[[t, Omega], ...], s", "s and rad/s"},
    {"[[excitation]]", "target", "an axis or a coil", "what is driven"},
    {"[[excitation]]", "port", "force, reference, current, duty", "where it is added"},
    {"[[excitation]]", "kind", "step, pulse, ramp, sine, multisine, chirp, samples", "the signal"},
    {"[[excitation]]", "amplitude, start, stop", "the port's unit, s", "of the signal"},
    {"[[excitation]]", "frequency, phase, frequencies, phases, f0, f1", "Hz, rad", "of sines"},
    {"[[excitation]]", "width", "s", "of a pulse"},
    {"[[excitation]]", "file, channel", "a record and its column", "of samples"},
    {"[[load]]", "plane, z, force, start, stop", "", "a force on the rotor [N]"},
    {"[[fault]]", "time, target, kind, parameters", "", "see the faults of this page"},
    {"[[switch]]", "time, to", "s, a NAME or main", "another controller takes over"},
    {"[expect]",
     "detected_within, classified, touchdown, drop, redistributed, max_orbit, max_false_alarms, "
     "rests_within",
     "", "what ambrig check compares"},
};

constexpr WordKey kCaseWords[] = {
    {"case file", "rig", "a file", "the model as its user believes it"},
    {"case file", "noise", "{ channel = rms }", "else of the rig file, else estimated"},
    {"[nuisance]", "sensor_zero, time_shift, input_gain", "sd", "that may differ between records"},
    {"[[record]]", "scenario, data", "files", "what was commanded, what was measured"},
    {"[[record]]", "kind", "time, frf, static", "docs/guide/bench_records.md"},
    {"[[record]]", "use", "fit, validate, test", "who may see it"},
    {"[[record]]", "imposed", "none, motion, currents", "measured motion or currents drive"},
    {"[[record]]", "observer", "Hz", "with imposed currents: how fast the rotor follows"},
    {"[[record]]", "time_offset, leave_out", "s, [[from, to], ...]", "of the logger"},
    {"[[record]]", "speed, averages, accuracy", "rad/s, -, -", "of frequency responses, tables"},
    {"[record.channels]", "column, unit, gain, offset, late, use", "",
     "of each channel of the rig: a column of the file"},
    {"[record.responses]", "trace, unit, gain, excited, coherence, sd", "", "of each response"},
    {"[record.sd]", "sd", "the output's unit", "of a table's readings"},
};

constexpr WordKey kOtherWords[] = {
    {"campaign file",
     "scenario, scenarios, sets, speeds, loads, draws, seeds, values, bearings, "
     "coils, every, at_most, relaxation, window, commissioned, trust, reduced",
     "", "docs/guide/campaign.md"},
    {"[plants] of a campaign",
     "effects, sizes, mixtures, mixture_of, without, range, scale,"
     " spacing, uncertainty, grade",
     "", "docs/guide/reality.md"},
    {"detector study", "healthy, faulty, detectors, begin, settle, window, budget", "",
     "docs/guide/detectors.md"},
    {"design study",
     "method, scenarios, path, values, points, rows, frequency_errors, unbalance, above, below", "",
     "docs/guide/design.md"},
    {"validation file",
     "id, quantity, published, tolerance, match, source, note, frequency, speed_rpm, springs, k, c,"
     " sensor_z, reading, planes, axis, phase, on, at, unbalance",
     "", "ambrig validate"},
    {"commissioning file",
     "learnt_on, onset, leakage, knee, iron_path, fringing, gain, current_error, largest_flux, "
     "negative, lumped, carries",
     "", "written by ambrig commission"},
    {"answers of ambrig new", "template, record", "a template; a file or a list of files",
     "beside the numbers that ambrig new asks for"},
};

std::string DetectorKindNames() {
  std::string names;
  for (const CoilDetectorKind& k : CoilDetectorKinds())
    names += (names.empty() ? "" : ", ") + std::string(k.name);
  return names;
}

/// The names that are registered in the catalogue behind a key.
std::string NamesInCatalogue(std::string_view section, std::string_view key) {
  if (key == "template") return StatorTemplateNames(false) + ", " + StatorTemplateNames(true);
  if (section == "[detection]") return DetectorKindNames();
  return section == "[controller]" ? ControllerKindNames() : BearingKindNames();
}

}  // namespace

std::span<const WordKey> WordKeys() {
  static std::list<std::string> names;  // that the keys point to
  static const std::vector<WordKey> all = [] {
    std::vector<WordKey> keys;
    for (const std::span<const WordKey> part :
         {std::span<const WordKey>(kRigWords), std::span<const WordKey>(kScenarioWords),
          std::span<const WordKey>(kCaseWords), std::span<const WordKey>(kOtherWords)})
      keys.insert(keys.end(), part.begin(), part.end());
    for (WordKey& w : keys)
      if (w.allowed == kOfTheCatalogue)
        w.allowed = names.emplace_back(NamesInCatalogue(w.section, w.key)).c_str();
    return keys;
  }();
  return all;
}

}  // namespace ambrig
