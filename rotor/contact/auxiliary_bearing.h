#pragma once
/// Auxiliary (touch-down) bearing of one radial plane, and axial stops.
///
///   p = r - c > 0:  N = k pⁿ (1 + h p'), clipped at N >= 0
///   friction mu N v/√(v² + v_s²), v_s = 0.01 m/s, v: sliding speed of the journal on the race
///   race (optional inertia J, drag d): J w' = friction * R - d w; mount (optional): mass,
///     stiffness, damping
///
/// Source: base_model.md section 8; restitution oracle published_values.md 5.
#include "core/base/parameters.h"

namespace ambrig {

struct AuxiliaryParameters {
  double clearance = kRequired;
  double stiffness = kRequired;
  double exponent = 1;
  double damping = 0;
  double friction = 0;
  double race_inertia = 0;  // 0: the race stands still
  double race_drag = 0;
  double mount_stiffness = kInfinity;
  double mount_damping = 0;
  double mount_mass = 0.1;
};

inline constexpr Field<AuxiliaryParameters> kAuxiliaryFields[] = {
    {"clearance", &AuxiliaryParameters::clearance, "m", 1e-7, 1e-1, "c, radial (axial at stops)"},
    {"stiffness", &AuxiliaryParameters::stiffness, "N/m^n", 1, 1e14, "k of N = k p^n (1 + h p')"},
    {"exponent", &AuxiliaryParameters::exponent, "-", 1, 3, "n"},
    {"damping", &AuxiliaryParameters::damping, "s/m", 0, 1e4, "h"},
    {"friction", &AuxiliaryParameters::friction, "-", 0, 2, "mu"},
    {"race_inertia", &AuxiliaryParameters::race_inertia, "kg m2", 0, 10,
     "inner race about its axis; 0: it does not rotate"},
    {"race_drag", &AuxiliaryParameters::race_drag, "N m s", 0, 10, "drag torque over race speed"},
    {"mount_stiffness", &AuxiliaryParameters::mount_stiffness, "N/m", 1, kInfinity,
     "race on a resilient mount; inf: rigid"},
    {"mount_damping", &AuxiliaryParameters::mount_damping, "N s/m", 0, 1e7, "of the mount"},
    {"mount_mass", &AuxiliaryParameters::mount_mass, "kg", 1e-4, 100,
     "race and holder on the mount"},
};

inline constexpr double kSlidingSpeed = 0.01;  // v_s [m/s], regularises the friction

struct ContactForce {
  double penetration = 0;  // [m], > 0 in contact
  double normal = 0;       // N >= 0 [N]
  double fx = 0, fy = 0;   // on the journal [N]
  double torque = 0;       // on the rotor about z [N m]
  double race_torque = 0;  // on the race [N m]
};

/// Force on the journal whose centre sits at (x, y) relative to the race and moves with (vx, vy);
/// surface speed Omega * journal_radius, race surface speed race_speed * journal_radius.
ContactForce RadialContact(const AuxiliaryParameters& p, double journal_radius, double x, double y,
                           double vx, double vy, double Omega, double race_speed);

/// Axial stop on both sides: force along z on the rotor.
double AxialContact(const AuxiliaryParameters& p, double z, double vz);

/// Penetration at which the contact carries `load` at rest. [N] -> [m]
double StaticPenetration(const AuxiliaryParameters& p, double load);

}  // namespace ambrig
