#include "scenarios/scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/base/coil_name.h"
#include "core/base/counted.h"
#include "core/base/read_file.h"
#include "core/base/toml_checked.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"
#include "scenarios/expect_file.h"
#include "scenarios/faults/fault_file.h"
#include "scenarios/load_file.h"
#include "scenarios/start_file.h"

namespace ambrig {

namespace {

std::string Join(const std::vector<std::string>& names) {
  std::string out;
  for (const auto& n : names) out += (out.empty() ? "" : ", ") + n;
  return out;
}

struct Targets {
  std::vector<std::string> axes, coils;
};

Targets TargetsOfRig(const RigParameters& rig) {
  Targets t;
  for (const auto& b : rig.bearings) {
    for (const auto& a : b.Axes()) t.axes.push_back(a);
    for (int j = 0; j < b.coils(); ++j) t.coils.push_back(CoilName(b.name, j));
  }
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

/// Above half the rate at which a port takes its commands a signal comes out as another, slower
/// one.
void CheckSampled(const TomlTable& t, const Excitation& e, const RigParameters& rig) {
  const bool coil = e.port == "current" || e.port == "duty";
  const double most = 0.5 * (coil ? rig.amplifier.switching_frequency : rig.controller.rate);
  const auto check = [&](const char* key, double f) {
    if (f > most)
      t.Fail(key, fmt::format("= {} Hz, allowed: at most {} Hz, half the {} (port {})", f, most,
                              coil ? "switching frequency" : "controller's rate", e.port));
  };
  if (e.kind == "sine") check("frequency", e.frequency);
  if (e.kind == "chirp") check("f0", e.f0);
  if (e.kind == "chirp") check("f1", e.f1);
  for (const double f : e.frequencies) check("frequencies", f);
}

/// A file of other times than the excitation's would command nothing, or one value throughout.
void CheckCovered(const TomlTable& t, const Excitation& e, double duration) {
  if (e.kind != "samples") return;
  const double from = std::max(e.start, 0.0), to = std::min(e.stop, duration);
  if (e.sample_start < to && e.SamplesEnd() > from) return;
  t.Fail("file", fmt::format("holds {} s to {} s, allowed: times of the excitation, {} s to {} s",
                             e.sample_start, e.SamplesEnd(), from, to));
}

void ReadExcitations(const TomlTable& root, const Targets& targets, const RigParameters& rig,
                     Scenario& s) {
  for (const TomlTable& t : root.Tables("excitation")) {
    Excitation e = ReadExcitation(t, Beside(s.file, "."), s.duration);
    const bool coil = e.port == "current" || e.port == "duty";
    const auto& allowed = coil ? targets.coils : targets.axes;
    if (std::find(allowed.begin(), allowed.end(), e.target) == allowed.end())
      t.Fail("target",
             fmt::format("= \"{}\" on port {}, allowed: {}", e.target, e.port, Join(allowed)));
    CheckSampled(t, e, rig);
    CheckCovered(t, e, s.duration);
    s.excitations.push_back(e);
  }
}

/// Two states of one part at one instant: a coil with its bridge, or one sensor.
bool Contradicts(const FaultSpec& a, const FaultSpec& b) {
  const bool sensors = a.kind.ends_with("-sensor") == b.kind.ends_with("-sensor");
  return a.time == b.time && a.target == b.target && sensors;
}

constexpr FaultTarget kAll[] = {FaultTarget::kCoil, FaultTarget::kAxis, FaultTarget::kRig};

void ReadFaults(const TomlTable& root, const Targets& targets, const RigParameters& rig,
                Scenario& s) {
  for (const TomlTable& t : root.Tables("fault")) {
    FaultSpec f;
    f.where = t.Where();
    f.time = t.Number("time");
    if (!(f.time >= 0 && f.time < s.duration))
      t.Fail("time",
             fmt::format("= {} s, allowed: 0 to below the duration of {} s", f.time, s.duration));
    const Fault& kind = ReadFault(t, FaultKindNames(kAll), rig, &f.parameters);
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
  s.redistribution =
      root.Choice("redistribution", s.redistribution, "auto, matrix, force-by-force");
  s.current_transition = root.Choice("hand_over", s.current_transition, kCurrentTransitionNames);
  s.stiffness_compensation = root.Bool("stiffness_compensation", true);
  ReadRetunedController(root, rig, s);
  s.drop_limit = PositiveTime(root, "drop_limit", 0.1);
  const Targets targets = TargetsOfRig(rig);
  ReadStart(root, rig, s);
  ReadSpeed(root, s);
  ReadExcitations(root, targets, rig, s);
  ReadLoads(root, rig, s);
  ReadFaults(root, targets, rig, s);
  ReadSwitches(root, rig, s);
  ReadExpect(root, rig, s);
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
