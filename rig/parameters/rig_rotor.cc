#include "rig/parameters/rig_rotor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/math/constants.h"
#include "rig/parameters/bearing_kind.h"
#include "rotor/shaft/shaft_parameters.h"

namespace ambrig {

namespace {

constexpr Field<RotorParameters> kBeamRotorFields[] = {
    {"journal_radius", &RotorParameters::journal_radius, "m", 1e-4, 10,
     "at the auxiliary bearings"},
};

/// Mass, inertias and modes of the shaft as it is now. Returns how far its centre of mass is from
/// z_origin.
double TakeShaft(RigParameters& rig) {
  const ReducedRotor reduced = BuildReduced(*rig.beam, ResidualPlanes(rig));
  rig.rotor.mass = reduced.mass;
  rig.rotor.inertia_transverse = reduced.inertia_transverse;
  rig.rotor.inertia_polar = reduced.inertia_polar;
  rig.modes = BendingModes(reduced);
  return reduced.z_com - rig.z_origin;
}

/// What a run and its linear model carry: springs and dampers to the ground (rig/rig_assembly.cc).
void CheckRigSupports(const TomlTable& t, const BeamDefinition& d) {
  const char* allowed =
      ", allowed in a rig: springs and dampers to the ground (ambrig analyze takes "
      "the rest of a shaft's own file)";
  for (const SpringSupport& s : d.supports) {
    const std::string name = fmt::format("\"{}\" ", s.name);
    if (!s.on_shaft() || !s.on.empty())
      t.Fail("support", name + "stands on or carries a housing" + allowed);
    if (s.has_mass()) t.Fail("support", name + "has added masses" + allowed);
  }
  if (!d.shafts.empty())
    t.Fail("shaft", fmt::format("stands {} times{}", d.shafts.size(), allowed));
  for (const ShaftSection& s : d.sections)
    if (s.torque != 0)
      t.Fail("section", fmt::format("\"{}\" has torque = {} N m, allowed in a rig: 0", s.name,
                                    NumberText(s.torque)));
  for (const ShaftSection& s : d.sections)
    if (s.axial_force != 0)
      t.Fail("section", fmt::format("\"{}\" has axial_force = {} N, allowed in a rig: 0", s.name,
                                    NumberText(s.axial_force)));
}

/// The engines move the rotor once a switching period: a support's own frequency stays a twentieth
/// of it, where a step of that length errs by (2 pi / 20)^5 / 120 of a turn, 3e-5.
void CheckSupportRates(const TomlTable& rotor, const RigParameters& rig) {
  const double limit = 2 * kPi * rig.amplifier.switching_frequency / 20;
  for (const SpringSupport& s : rig.beam->definition.supports) {
    const double arm = s.z - rig.z_origin;
    double mobility = 1 / rig.rotor.mass + arm * arm / rig.rotor.inertia_transverse;
    for (const BendingMode& m : rig.modes) mobility += m.Gain(arm) * m.Gain(arm);
    double k = 0, c = 0;
    for (const SupportCoefficients& at :
         s.varies() ? s.table : std::vector<SupportCoefficients>{s}) {
      k = std::max({k, std::abs(at.kxx) + std::abs(at.kxy), std::abs(at.kyy) + std::abs(at.kyx)});
      c = std::max({c, std::abs(at.cxx) + std::abs(at.cxy), std::abs(at.cyy) + std::abs(at.cyx)});
    }
    const double rate = std::max(std::sqrt(k * mobility), c * mobility);
    if (rate < limit) continue;
    rotor.Fail(
        "support",
        fmt::format("\"{}\" moves the shaft at {:.0f} Hz, allowed in a rig: up to a twentieth "
                    "of the switching frequency, {:.0f} Hz",
                    s.name, rate / (2 * kPi), limit / (2 * kPi)));
  }
}

void ReadBeamRotor(const TomlTable& t, RigParameters& rig) {
  rig.beam = ReadBeam(t, &rig.tolerances);
  CheckRigSupports(t, rig.beam->definition);
  if (rig.beam->modes > kMaxModes)
    t.Fail("modes", fmt::format("= {}, allowed: 0 to {}", rig.beam->modes, kMaxModes));
  t.Read(rig.rotor, kBeamRotorFields);
  rig.z_origin = rig.nominal_com_z = TakeShaft(rig);
  for (ShaftPlane p : rig.beam->planes) {
    p.z -= rig.z_origin;
    rig.stations.push_back(p);
  }
}

/// The engines feed the rotor mean forces of switching periods: half their frequency is the last
/// that such a feed can carry.
void CheckModes(const TomlTable& rotor, const RigParameters& rig) {
  const double limit = rig.amplifier.switching_frequency / 2;
  if (static_cast<int>(rig.modes.size()) > kMaxModes)
    rotor.Fail("static_correction",
               fmt::format("= true adds a residual mode for each of {} bearings to modes = {}, "
                           "allowed: {} modes in all",
                           static_cast<int>(rig.modes.size()) - rig.beam->modes, rig.beam->modes,
                           kMaxModes));
  for (std::size_t k = 0; k < rig.modes.size(); ++k) {
    const double f = rig.modes[k].omega / (2 * kPi);
    if (f < limit) continue;
    if (static_cast<int>(k) >= rig.beam->modes)
      rotor.Fail("static_correction",
                 fmt::format("= true has a residual mode at {:.0f} Hz, allowed: below half the "
                             "switching frequency of {} Hz (other modes, or false)",
                             f, rig.amplifier.switching_frequency));
    rotor.Fail("modes",
               fmt::format("= {}, allowed: 0 to {} (mode {} at {:.0f} Hz lies above half the "
                           "switching frequency of {} Hz)",
                           rig.beam->modes, k, k + 1, f, rig.amplifier.switching_frequency));
  }
}

}  // namespace

std::vector<double> ResidualPlanes(const RigParameters& rig) {
  std::vector<double> planes;  // none while the file's bearings are still to be read
  for (const BearingParameters& b : rig.bearings)
    if (rig.beam && rig.beam->static_correction && b.kind->two_axes)
      planes.push_back(b.z + rig.z_origin);
  return planes;
}

void ReadRotor(const TomlTable& t, RigParameters& rig) {
  rig.rotor_kind = t.Choice("kind", "rigid", "rigid, point, beam");
  if (rig.rotor_kind == "beam") {
    ReadBeamRotor(t, rig);
    t.RejectUnknownKeys();
    return;
  }
  if (rig.rotor_kind == "point") {
    rig.rotor.inertia_transverse = 1;
    rig.rotor.inertia_polar = 0;
    rig.rotor.journal_radius = 0.01;
  }
  t.Read(rig.rotor, kRotorFields, &rig.tolerances);
  t.RejectUnknownKeys();
  if (rig.rotor.inertia_polar > 2 * rig.rotor.inertia_transverse)
    t.Fail("inertia_polar",
           fmt::format("= {} kg m2, allowed: at most twice inertia_transverse = {} (no "
                       "body has more)",
                       rig.rotor.inertia_polar, rig.rotor.inertia_transverse));
  constexpr double kLargestRadius = 10;  // of gyration [m]: no shaft of a rig is longer than 30 m
  const double most = kLargestRadius * kLargestRadius * rig.rotor.mass;
  if (rig.rotor_kind == "rigid" && rig.rotor.inertia_transverse > most)
    t.Fail("inertia_transverse",
           fmt::format("= {:g} kg m2 of {:g} kg, allowed: at most {:g} (a radius of gyration of "
                       "{:g} m)",
                       rig.rotor.inertia_transverse, rig.rotor.mass, most, kLargestRadius));
}

void SetShaft(RigParameters& rig, std::size_t parameter, double value) {
  SetShaftParameter(*rig.beam, parameter, value);
  const double moved = TakeShaft(rig);
  rig.z_origin += moved;
  for (ShaftPlane& p : rig.stations) p.z -= moved;
  for (BearingParameters& b : rig.bearings) {
    if (!b.kind->two_axes) continue;
    b.z -= moved;
    b.sensor.z -= moved;
    b.auxiliary_z -= moved;  // nan: at the bearing
  }
}

void PlaceOnShaft(const TomlTable& root, RigParameters& rig) {
  if (!rig.beam) return;
  double lo = kInfinity, hi = -kInfinity;
  for (const ShaftSection& s : rig.beam->definition.sections) {
    if (!s.stiff) continue;
    lo = std::min(lo, s.z0);
    hi = std::max(hi, s.z0 + s.length);
  }
  const auto place = [&](const TomlTable& t, const char* key, double& z) {
    if (!(lo <= z && z <= hi))
      t.Fail(key, fmt::format("= {} m, allowed: on the shaft, {} to {} m", NumberText(z),
                              NumberText(lo), NumberText(hi)));
    z -= rig.z_origin;
  };
  const TomlTable bearings = *root.Table("bearings");
  for (BearingParameters& b : rig.bearings) {
    if (rig.FindStation(b.name))
      bearings.Fail(b.name,
                    "is also the name of a disk or station of the shaft, allowed: another one");
    if (!b.kind->two_axes) continue;
    const TomlTable t = *bearings.Table(b.name);
    place(t, "z", b.z);
    place(t, "sensor", b.sensor.z);
    if (!std::isnan(b.auxiliary_z)) place(t, "auxiliary", b.auxiliary_z);
    for (Tolerance& k : rig.tolerances)
      if (k.path == "bearings." + b.name + ".sensor.z") k.true_value -= rig.z_origin;
  }
  if (rig.beam->static_correction) TakeShaft(rig);  // now that the magnets' planes are known
  CheckModes(*root.Table("rotor"), rig);
  CheckSupportRates(*root.Table("rotor"), rig);
}

}  // namespace ambrig
