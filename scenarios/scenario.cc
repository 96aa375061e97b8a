#include "scenarios/scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/base/coil_name.h"
#include "core/base/counted.h"
#include "core/base/read_file.h"
#include "core/base/toml_checked.h"
#include "rig/bearing_kinds/bearing_kind.h"
#include "rig/rig_checks.h"
#include "rig/rig_figures.h"
#include "scenarios/faults/fault_file.h"
#include "scenarios/start_file.h"

namespace ambrig {

namespace {

std::string Join(const std::vector<std::string>& names) {
  std::string out;
  for (const auto& n : names) out += (out.empty() ? "" : ", ") + n;
  return out;
}

struct Targets {
  std::vector<std::string> axes, coils, planes, bearings, load_planes;
};

Targets TargetsOfRig(const RigParameters& rig) {
  Targets t;
  for (const auto& b : rig.bearings) {
    for (const auto& a : b.Axes()) t.axes.push_back(a);
    for (int j = 0; j < b.coils(); ++j) t.coils.push_back(CoilName(b.name, j));
    if (!b.kind->axial) t.planes.push_back(b.name);
    t.bearings.push_back(b.name);
  }
  t.load_planes = t.bearings;
  for (const auto& s : rig.stations) t.load_planes.push_back(s.name);
  return t;
}

constexpr Range kScenarioTime{"s", -1e5, 1e5, "scenario time"};

double PositiveTime(const TomlTable& t, const char* key, double fallback) {
  return Within(t, key, fallback, {"s", 1e-6, 1e5, "length of time"});
}

void ReadSpeed(const TomlTable& root, Scenario& s) {
  const auto t = root.Table("speed");
  if (!t) return;
  const auto rows = t->Rows("profile");
  if (rows.empty()) t->Fail("profile", "is missing, allowed: [[t, Omega], ...] in s and rad/s");
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (std::abs(rows[k][0]) > 1e5)
      t->Fail("profile",
              fmt::format("row {}: t = {} s, allowed: -1e5 to 1e5 s", k + 1, rows[k][0]));
    if (rows[k].size() != 2)
      t->Fail("profile", fmt::format("row {} has {}, allowed: [t, Omega]", k + 1,
                                     Counted(rows[k].size(), "entry")));
    if (k > 0 && rows[k][0] <= rows[k - 1][0])
      t->Fail("profile",
              fmt::format("row {} goes back in time: t = {} s after {} s, allowed: increasing t",
                          k + 1, rows[k][0], rows[k - 1][0]));
    if (std::abs(rows[k][1]) > 1e5)
      t->Fail("profile",
              fmt::format("row {}: Omega = {} rad/s, allowed: -1e5 to 1e5", k + 1, rows[k][1]));
  }
  s.speed = SpeedProfile(rows);
  s.speed_free_from = Within(*t, "free_from", kInfinity, kScenarioTime);
  t->RejectUnknownKeys();
}

void ReadExcitations(const TomlTable& root, const Targets& targets, Scenario& s) {
  for (const TomlTable& t : root.Tables("excitation")) {
    Excitation e = ReadExcitation(t, Beside(s.file, "."), s.duration);
    const bool coil = e.port == "current" || e.port == "duty";
    const auto& allowed = coil ? targets.coils : targets.axes;
    if (std::find(allowed.begin(), allowed.end(), e.target) == allowed.end())
      t.Fail("target",
             fmt::format("= \"{}\" on port {}, allowed: {}", e.target, e.port, Join(allowed)));
    s.excitations.push_back(e);
  }
}

void ReadLoads(const TomlTable& root, const Targets& targets, const RigParameters& rig,
               Scenario& s) {
  for (const TomlTable& t : root.Tables("load")) {
    LoadSpec l;
    if (t.Has("plane") == t.Has("z")) t.Fail("plane", "allowed: either plane = \"A\" or z = m");
    if (t.Has("plane")) {
      const std::string plane = t.String("plane");
      const BearingParameters* b = rig.Find(plane);
      const ShaftPlane* station = rig.FindStation(plane);
      if (!b && !station)
        t.Fail("plane", fmt::format("= \"{}\", allowed: {}", plane, Join(targets.load_planes)));
      l.z = b ? b->z : station->z;
      l.axial = b && b->kind->axial;
    } else {
      const auto [lo, hi] = ShaftExtent(rig);
      l.z = Within(t, "z", kRequired,
                   {"m", lo + rig.z_origin, hi + rig.z_origin, "a place on the shaft"}) -
            rig.z_origin;
    }
    constexpr Range kForce{"N", -1e8, 1e8, "force of a load"};
    const auto f = t.IsNumber("force")
                       ? std::vector<double>{Within(t, "force", kRequired, kForce)}
                       : (t.Has("force") ? AllWithin(t, "force", {}, kForce) : t.Numbers("force"));
    if (f.empty() || f.size() > 3) t.Fail("force", "allowed: [fx, fy] or [fx, fy, fz] in N");
    if (l.axial && f.size() == 1) {
      l.fz = f[0];
    } else {
      l.fx = f[0];
      l.fy = f.size() > 1 ? f[1] : 0;
      l.fz = f.size() > 2 ? f[2] : 0;
    }
    l.start = Within(t, "start", 0, kScenarioTime);
    l.stop = Within(t, "stop", s.duration, kScenarioTime);
    if (!(l.stop > l.start))
      t.Fail("stop", fmt::format("= {} s, allowed: later than start = {} s", l.stop, l.start));
    t.RejectUnknownKeys();
    s.loads.push_back(l);
  }
}

/// Two states of one part at one instant: a coil with its bridge, or one sensor.
bool Contradicts(const FaultSpec& a, const FaultSpec& b) {
  const bool sensors = a.kind.ends_with("-sensor") == b.kind.ends_with("-sensor");
  return a.time == b.time && a.target == b.target && sensors;
}

constexpr FaultTarget kAll[] = {FaultTarget::kCoil, FaultTarget::kAxis, FaultTarget::kRig};

void ReadFaults(const TomlTable& root, const Targets& targets, Scenario& s) {
  for (const TomlTable& t : root.Tables("fault")) {
    FaultSpec f;
    f.where = t.Where();
    f.time = t.Number("time");
    if (!(f.time >= 0 && f.time < s.duration))
      t.Fail("time",
             fmt::format("= {} s, allowed: 0 to below the duration of {} s", f.time, s.duration));
    const Fault& kind = ReadFault(t, FaultKindNames(kAll), &f.parameters);
    f.kind = kind.kind;
    f.target = t.String("target", kind.target == FaultTarget::kRig ? "rig" : "");
    const std::vector<std::string> allowed = kind.target == FaultTarget::kCoil ? targets.coils
                                             : kind.target == FaultTarget::kAxis
                                                 ? targets.axes
                                                 : std::vector<std::string>{"rig"};
    if (std::find(allowed.begin(), allowed.end(), f.target) == allowed.end())
      t.Fail("target",
             fmt::format("= \"{}\" with kind {}, allowed: {}", f.target, f.kind, Join(allowed)));
    t.RejectUnknownKeys();
    for (const FaultSpec& other : s.faults)
      if (Contradicts(f, other))
        t.Fail("kind", fmt::format("= \"{}\" on {} at {} s, where {} is set at the same instant, "
                                   "allowed: one of them",
                                   f.kind, f.target, f.time, other.kind));
    s.faults.push_back(f);
  }
  std::stable_sort(s.faults.begin(), s.faults.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
}

void ReadSwitches(const TomlTable& root, const RigParameters& rig, Scenario& s) {
  std::vector<std::string> allowed{"main"};
  for (const ControllerParameters& c : rig.other_controllers) allowed.push_back(c.name);
  for (const TomlTable& t : root.Tables("switch")) {
    SwitchSpec change;
    change.time = t.Number("time");
    if (!(change.time >= 0 && change.time < s.duration))
      t.Fail("time", fmt::format("= {} s, allowed: 0 to below the duration of {} s", change.time,
                                 s.duration));
    change.to = t.String("to");
    if (std::find(allowed.begin(), allowed.end(), change.to) == allowed.end())
      t.Fail("to", fmt::format("= \"{}\", allowed: controllers of the rig: {}", change.to,
                               Join(allowed)));
    t.RejectUnknownKeys();
    for (const SwitchSpec& other : s.switches)
      if (other.time == change.time)
        t.Fail("time", fmt::format("= {} s, where the scenario changes to \"{}\", allowed: one "
                                   "change at one instant",
                                   change.time, other.to));
    s.switches.push_back(change);
  }
  std::stable_sort(s.switches.begin(), s.switches.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
}

/// A controller of the rig that a synthesis designs: "main" or one of [controllers.NAME].
void ReadRetunedController(const TomlTable& root, const RigParameters& rig, Scenario& s) {
  if (!root.Has("retuned_controller")) return;
  const std::vector<std::string> allowed = DesignedControllers(rig);
  s.retuned_controller = root.String("retuned_controller");
  if (std::find(allowed.begin(), allowed.end(), s.retuned_controller) == allowed.end())
    root.Fail("retuned_controller",
              fmt::format(
                  "= \"{}\", allowed: controllers of the rig that are designed for its plant (kind "
                  "lqg, h-infinity): {}",
                  s.retuned_controller, allowed.empty() ? "it has none" : Join(allowed)));
}

void ReadExpect(const TomlTable& root, Scenario& s) {
  const auto t = root.Table("expect");
  if (!t) return;
  const auto number = [&](const char* key, std::optional<double>& out, const Range& range) {
    if (t->Has(key)) out = Within(*t, key, kRequired, range);
  };
  const auto flag = [&](const char* key, std::optional<bool>& out) {
    if (t->Has(key)) out = t->Bool(key, false);
  };
  number("detected_within", s.expect.detected_within, {"s", 0, 1e5, "delay of the detection"});
  number("max_orbit", s.expect.max_orbit, {"m", 0, 1, "largest orbit"});
  number("max_false_alarms", s.expect.max_false_alarms, {"-", 0, 1e9, "alarms without a fault"});
  number("rests_within", s.expect.rests_within, {"m", 0, 1, "orbit at the end"});
  flag("touchdown", s.expect.touchdown);
  flag("drop", s.expect.drop);
  flag("redistributed", s.expect.redistributed);
  if (t->Has("classified")) s.expect.classified = t->Choice("classified", "", FaultClassNames());
  t->RejectUnknownKeys();
}

void CheckRate(const TomlTable& root, const RigParameters& rig, double rate) {
  const double pwm = rig.amplifier.switching_frequency, k = rig.amplifier.adc_samples_per_period;
  const double slow = pwm / rate, fast = rate / pwm;
  const auto whole = [](double v) { return std::abs(v - std::round(v)) < 1e-6 * v && v > 0.5; };
  if (whole(slow) || (whole(fast) && whole(k / fast))) return;
  root.Fail("record_rate",
            fmt::format("= {} Hz, allowed: the switching frequency {} Hz over an integer, or times "
                        "a divisor of {} samples a period",
                        rate, pwm, k));
}

Scenario Read(const TomlTable& root, const RigParameters& rig) {
  Scenario s;
  s.file = root.file();
  s.name = root.String("name", std::filesystem::path(s.file).stem().string());
  s.rig_file = root.String("rig", "rig.toml");
  s.duration = PositiveTime(root, "duration", kRequired);
  s.record_rate = Within(root, "record_rate", rig.controller.rate,
                         {"Hz", std::min(1 / s.duration, rig.controller.rate), 1e9,
                          "rows per second, at least one in the duration"});
  CheckRate(root, rig, s.record_rate);
  const long long seed = root.Integer("seed", 1);
  if (seed < 0) root.Fail("seed", fmt::format("= {}, allowed: 0 or more", seed));
  s.seed = static_cast<std::uint64_t>(seed);
  s.noise = root.Bool("noise", true);
  s.fault_tolerant = root.Bool("fault_tolerance", true);
  s.redistribution = root.Choice("redistribution", s.redistribution, "auto,matrix,force-by-force");
  s.current_transition = root.Choice("hand_over", s.current_transition, kCurrentTransitionNames);
  s.stiffness_compensation = root.Bool("stiffness_compensation", true);
  ReadRetunedController(root, rig, s);
  s.drop_limit = PositiveTime(root, "drop_limit", 0.1);
  const Targets targets = TargetsOfRig(rig);
  ReadStart(root, rig, s);
  ReadSpeed(root, s);
  ReadExcitations(root, targets, s);
  ReadLoads(root, targets, rig, s);
  ReadFaults(root, targets, s);
  ReadSwitches(root, rig, s);
  ReadExpect(root, s);
  root.RejectUnknownKeys();
  return s;
}

}  // namespace

Scenario ReadScenario(const std::string& file, const RigParameters& rig) {
  return Read(TomlTable::FromFile(file), rig);
}
Scenario ReadScenarioText(const std::string& text, const std::string& file,
                          const RigParameters& rig) {
  return Read(TomlTable::FromText(text, file), rig);
}

std::string RigOfScenario(const std::string& file) {
  const TomlTable root = TomlTable::FromFile(file);
  return ExistingFile(root, "rig", "rig.toml");
}

bool HasExpectations(const std::string& file) {
  return TomlTable::FromFile(file).Table("expect").has_value();
}

}  // namespace ambrig
