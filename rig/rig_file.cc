#include "rig/rig_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/base/read_file.h"
#include "core/base/toml_checked.h"
#include "rig/amplifier_file.h"
#include "rig/clearance.h"
#include "rig/coil_errors_file.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/parameters/rig_rotor.h"
#include "rig/rig_assembly.h"
#include "rig/rig_checks.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

constexpr Range kPlace{"m", -100, 100, "place along the shaft"};

void ReadSensor(const TomlTable& bearing, BearingParameters& b,
                std::vector<Tolerance>* tolerances) {
  const auto t = bearing.Table("sensor");
  if (!t) bearing.Fail("sensor", "is missing, allowed: { z = m, noise = m }");
  if (b.kind->axial)
    b.sensor.z = 0;
  else if (!b.kind->two_axes && !std::isfinite(b.sensor.z))
    b.sensor.z = b.z;
  t->Read(b.sensor, kSensorFields, tolerances);
  t->RejectUnknownKeys();
}

void ReadAuxiliary(const TomlTable& bearing, BearingParameters& b, double gap) {
  const auto t = bearing.Table("auxiliary");
  if (t) {
    AuxiliaryParameters p = b.auxiliary.value_or(AuxiliaryParameters{});
    t->Read(p, kAuxiliaryFields);
    if (b.kind->two_axes && t->Has("z")) b.auxiliary_z = Within(*t, "z", kRequired, kPlace);
    t->RejectUnknownKeys();
    b.auxiliary = p;
    if (p.clearance >= gap)
      t->Fail("clearance",
              fmt::format("= {} m, allowed: smaller than the gap of {} m (the rotor would "
                          "touch the poles first)",
                          p.clearance, gap));
  } else if (b.auxiliary && b.auxiliary->clearance >= gap) {
    bearing.Fail("gap", fmt::format("= {} m, allowed: larger than the auxiliary clearance of {} m",
                                    gap, b.auxiliary->clearance));
  }
}

PidParameters ReadPid(const TomlTable& t) {
  PidParameters p;
  t.Read(p, kPidFields);
  return p;
}

/// Whether a table gives a value itself: "gap", or "sensor.z" of its table [sensor].
bool Gives(const TomlTable& t, const std::string& key) {
  const auto [table, last] = InnermostOf(t, key);
  return table.Has(last);
}

BearingParameters ReadBearing(const TomlTable& t, const std::string& name, const RigParameters& rig,
                              std::vector<Tolerance>& tolerances) {
  BearingParameters b;
  const std::string like = t.String("like", "");
  if (!like.empty()) {
    const BearingParameters* other = rig.Find(like);
    if (!other) {
      std::string known;
      for (const auto& k : rig.bearings) known += (known.empty() ? "" : ", ") + k.name;
      t.Fail("like",
             fmt::format("= \"{}\", allowed: a bearing with its own values: {}", like, known));
    }
    b = *other;
    const std::string from = "bearings." + like + ".", to = "bearings." + name + ".";
    const std::vector<Tolerance> all = tolerances;
    for (const Tolerance& k : all)
      if (k.path.starts_with(from) && !Gives(t, k.path.substr(from.size())))
        tolerances.push_back({to + k.path.substr(from.size()), k.sd, kRequired});
  }
  b.name = name;
  b.auxiliary_z = kRequired;  // a place of its own is not copied
  const std::string kind = t.Choice("kind", std::string(b.kind->name), BearingKindNames());
  b.kind = FindBearingKind(kind);
  if (b.kind->two_axes) {
    b.z = Within(t, "z", like.empty() ? kRequired : b.z, kPlace);
  } else {
    b.z = Within(t, "z", 0, kPlace);
  }
  b.kind->read(t, b, &tolerances);
  ReadCoilErrors(t, b);
  if (like.empty() || t.Has("sensor")) ReadSensor(t, b, &tolerances);
  ReadAuxiliary(t, b, GapOf(b));
  if (const auto c = t.Table("controller")) {
    b.controller = ReadPid(*c);
    c->RejectUnknownKeys();
  }
  t.RejectUnknownKeys();
  return b;
}

void ReadSpeedSensor(const TomlTable& root, RigParameters& rig) {
  const auto t = root.Table("speed_sensor");
  if (!t) return;
  t->Read(rig.speed_sensor, kSpeedSensorFields, &rig.tolerances);
  const double pulses = rig.speed_sensor.pulses_per_revolution;
  if (pulses != std::floor(pulses))
    t->Fail("pulses_per_revolution", fmt::format("= {}, allowed: an integer", pulses));
  t->RejectUnknownKeys();
}

/// Where a synthesis may weigh displacements.
std::vector<std::string> PlaneNames(const RigParameters& rig) {
  std::vector<std::string> names;
  for (const BearingParameters& b : rig.bearings)
    if (b.kind->two_axes) names.push_back(b.name);
  for (const ShaftPlane& s : rig.stations) names.push_back(s.name);
  return names;
}

void ReadController(const TomlTable& t, RigParameters& rig) {
  t.Read(rig.controller, kControllerFields);
  const double periods = rig.amplifier.switching_frequency / rig.controller.rate;
  if (std::abs(periods - std::round(periods)) > 1e-9 * periods || periods < 0.5)
    t.Fail("rate", fmt::format("= {} Hz, allowed: the switching frequency of {} Hz over an integer",
                               rig.controller.rate, rig.amplifier.switching_frequency));
  std::vector<std::string> axes;
  for (const std::size_t k : ControlledAxes(rig)) axes.push_back(AxisNames(rig)[k]);
  ReadControllerKind(t, axes, PlaneNames(rig), rig.controller);
  t.RejectUnknownKeys();
}

/// Without [controller]: rotors that are held, and records whose currents were measured.
void LeaveUncontrolled(RigParameters& rig) {
  rig.controller.kind = "none";
  rig.controller.rate = rig.amplifier.switching_frequency;
  rig.controller.bias_current = 0.5 * rig.amplifier.i_max;
  rig.controller.pid = {0, 0, 0, 0, 1e9};
}

/// [controllers.NAME]: rate and bias current are the main one's.
void ReadOtherControllers(const TomlTable& root, RigParameters& rig) {
  const auto all = root.Table("controllers");
  if (!all) return;
  std::vector<std::string> axes;
  for (const std::size_t k : ControlledAxes(rig)) axes.push_back(AxisNames(rig)[k]);
  for (const std::string& name : all->Keys()) {
    const auto t = all->Table(name);
    if (name == "main") all->Fail(name, "is the name of [controller], allowed: another one");
    ControllerParameters c;
    c.name = name;
    c.rate = rig.controller.rate;
    c.bias_current = rig.controller.bias_current;
    ReadControllerKind(*t, axes, PlaneNames(rig), c);
    t->RejectUnknownKeys();
    rig.other_controllers.push_back(c);
  }
}

void ReadBearings(const TomlTable& root, RigParameters& rig) {
  const auto all = root.Table("bearings");
  if (!all)
    root.Fail("bearings", "is missing, allowed: tables [bearings.A], [bearings.B], [bearings.Z]");
  std::vector<std::string> names = all->Keys(), later;
  for (int pass = 0; pass < 2; ++pass)  // those that are `like` another come after it
    for (const std::string& name : names) {
      const TomlTable t = *all->Table(name);
      if (t.Has("like") == (pass == 1))
        rig.bearings.push_back(ReadBearing(t, name, rig, rig.tolerances));
    }
  // Those with two axes first, the one along the shaft last.
  std::sort(rig.bearings.begin(), rig.bearings.end(), [](const auto& a, const auto& b) {
    return std::tie(b.kind->two_axes, a.kind->axial, a.name) <
           std::tie(a.kind->two_axes, b.kind->axial, b.name);
  });
  int radial = 0, thrust = 0, opposed = 0;
  for (const auto& b : rig.bearings) {
    radial += b.kind->two_axes;
    thrust += b.kind->axial;
    opposed += b.kind->alone;
    for (const auto& other : rig.bearings) {
      if (&b == &other || !b.kind->two_axes || !other.kind->two_axes) continue;
      if (b.z == other.z)
        all->Table(b.name)->Fail(
            "z", fmt::format("= {} m, allowed: another plane than bearing {}", b.z, other.name));
      if (b.sensor.z == other.sensor.z)
        all->Table(b.name)->Fail(
            "sensor", fmt::format("z = {} m, allowed: another plane than the sensor of bearing {}, "
                                  "or the rotor's tilt is not seen",
                                  b.sensor.z, other.name));
    }
  }
  if (opposed == 0 && radial < 2) all->Fail("", "a rigid rotor needs at least two radial bearings");
  if (opposed > 0 && (radial + thrust > 0 || opposed > 1 || rig.rotor_kind != "point"))
    all->Fail("", "an opposed bearing stands alone, with rotor.kind = \"point\"");
  if (thrust > 1) all->Fail("", "at most one thrust bearing");
}

void ReadDetection(const TomlTable& root, DetectionParameters& d) {
  const auto t = root.Table("detection");
  if (!t) return;
  d.kind = t->String("kind", d.kind);
  d.where = t->Where("kind");
  t->Read(d, kDetectionFields);
  d.commissioning = t->String("commissioning", "");
  if (!d.commissioning.empty() && d.commissioning != "none")
    d.commissioning = Beside(root.file(), d.commissioning);
  t->RejectUnknownKeys();
}

RigParameters RigOfTable(const TomlTable& root) {
  RigParameters rig;
  rig.file = root.file();
  rig.name = root.String("name", "rig");
  const auto g =
      AllWithin(root, "gravity", {0, -9.81, 0}, {"m/s2", -1000, 1000, "acceleration of free fall"});
  if (g.size() != 3) root.Fail("gravity", "allowed: [gx, gy, gz] in m/s2");
  rig.gravity = {g[0], g[1], g[2]};
  const auto section = [&](const char* key) {
    const auto t = root.Table(key);
    if (!t) root.Fail(key, fmt::format("is missing, allowed: a table [{}]", key));
    return *t;
  };
  ReadRotor(section("rotor"), rig);
  ReadAmplifier(section("amplifier"), rig);
  ReadSpeedSensor(root, rig);
  ReadBearings(root, rig);
  TuneAmplifier(*root.Table("amplifier"), rig);
  PlaceOnShaft(root, rig);
  if (const auto controller = root.Table("controller"))
    ReadController(*controller, rig);
  else
    LeaveUncontrolled(rig);
  ReadOtherControllers(root, rig);
  ReadDetection(root, rig.detection);
  const EffectTargets known = TargetsOfEffects(rig);
  for (const TomlTable& t : root.Tables("effect")) rig.effects.push_back(ReadEffect(t, known));
  CheckRig(root, rig);
  root.RejectUnknownKeys();
  return rig;
}

}  // namespace

RigParameters ReadRig(const std::string& file) { return RigOfTable(TomlTable::FromFile(file)); }
RigParameters ReadRigText(const std::string& text, const std::string& file_name) {
  return RigOfTable(TomlTable::FromText(text, file_name));
}

}  // namespace ambrig
