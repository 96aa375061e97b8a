#pragma once
/// The moving side of the rig: rigid rotor with gyroscopics, bending modes of the free shaft,
/// auxiliary bearings with races and mounts, a compliant base, and any force terms.
///
///   m x'' = Fx                 It alpha'' + Ip Omega beta'  = Mx
///   m y'' = Fy                 It beta''  - Ip Omega alpha' = My
///   m z'' = Fz                 theta' = Omega (prescribed, or Ip Omega' = Mz)
///
/// Bending adds its own coordinates and couples to the tilt (rotor/motion/bending_mode.h).
/// A radial force at z gives Mx = -z fy, My = z fx; the shaft centre there sits at
/// (x + z beta, y - z alpha). On a moving base the coordinates are relative to the base, so gaps
/// and readings need no correction; the rotor feels minus the base's acceleration.
/// Source: docs/theory/base_model.md sections 1 and 8.
#include <memory>
#include <string>
#include <vector>

#include "rotor/contact/auxiliary_bearing.h"
#include "rotor/linear/force_term.h"
#include "rotor/motion/bending_mode.h"
#include "rotor/motion/rotor_parameters.h"
#include "rotor/motion/speed_profile.h"

namespace ambrig {

/// An auxiliary bearing in the model; its optional mount and race own coordinates.
struct AuxiliaryPlane {
  std::string name;
  PlaneMap map;
  AuxiliaryParameters parameters;
  int mount_dof = -1, race_dof = -1;
};

/// Displacement of the shaft's surface from its axis (bow): moves gaps, journals and readings.
class SurfaceTerm {
 public:
  virtual ~SurfaceTerm() = default;
  virtual void Add(const MotionState& state, double z, double* dx, double* dy) const = 0;
};

/// An external force of the scenario: between start and stop, at z. [N], [m], [s]
struct ExternalLoad {
  PlaneMap map;
  double fx = 0, fy = 0, fz = 0;
  double start = 0, stop = 0;
};

/// The stator as a mass on a spring and a damper in both radial directions.
struct BaseOnFloor {
  double mass = 0;                                     // [kg]
  std::array<double, 2> stiffness = {}, damping = {};  // along x and y [N/m], [N s/m]
};

class RotorModel {
 public:
  RotorModel(const RotorParameters& parameters, const std::array<double, 3>& gravity);

  // Assembly; every mode must be added before the planes.
  void AddBendingMode(const BendingMode& mode);
  PlaneMap MakePlane(double z) const;
  void AddAuxiliary(const std::string& name, double z, const AuxiliaryParameters& p);
  void SetAxialStop(const AuxiliaryParameters& p) {
    axial_ = p;
    has_axial_ = true;
  }
  /// Puts the race of auxiliary plane `k` on a mount (or changes the mount it has).
  void SetMount(std::size_t k, double stiffness, double damping, double mass);
  void SetBase(const BaseOnFloor& base);
  void AddLoad(double z, double fx, double fy, double fz, double start, double stop);
  void SetSpeed(const SpeedProfile& profile, double free_from = kInfinity);

  std::vector<std::unique_ptr<ForceTerm>> terms;
  std::vector<std::unique_ptr<SurfaceTerm>> surface;
  bool axial_free = false;  // false without a thrust bearing: z stays put

  /// Fills theta, Omega of `s` at its time t if the speed is prescribed there.
  void SetSpin(MotionState& s) const;
  /// Advances by dt under constant magnetic forces `Q` (and what they push on the stator).
  void Step(MotionState& s, const DofVector& Q, double stator_x, double stator_y, double dt) const;
  /// Accelerations at `s`; `near_contact` false: no auxiliary bearing can be touched.
  void Accelerations(const MotionState& s, const DofVector& Q, double stator_x, double stator_y,
                     DofVector& a, double* torque, bool near_contact = true) const;
  /// Shaft centre (with bow) at a plane. [m]
  PlanePoint Position(const MotionState& s, const PlaneMap& plane) const {
    return surface.empty() ? plane.Point(s.q) : OnSurface(s, plane);
  }
  /// Largest penetration over the auxiliary bearings [m]; negative: the least clearance left.
  double Penetration(const MotionState& s, std::size_t plane) const;
  double AxialPenetration(const MotionState& s) const;
  bool NearContact(const MotionState& s, double horizon) const;
  /// Rotor at rest on its first two auxiliary bearings. @throws InputError without two, or without
  /// gravity across the shaft.
  void Rest(MotionState& s) const;
  /// Base at the deflection under the static load that the stator carries.
  void SettleBase(MotionState& s, double stator_x, double stator_y) const;
  /// Kinetic energy of the rotor, elastic energy of its modes and of the contacts
  /// in auxiliary bearings, and gravity's potential [J]. Base, mounts, races and axial stop are
  /// not in it.
  double Energy(const MotionState& s) const;

  int dof() const { return dof_; }
  int mode_dof(std::size_t k) const { return shaft_.dof(k); }  // eta_x of mode k; eta_y follows
  const std::vector<BendingMode>& modes() const { return shaft_.modes(); }
  bool HasBase() const { return base_dof_ >= 0; }
  const RotorParameters& parameters() const { return p_; }
  RotorParameters& parameters() { return p_; }
  const std::array<double, 3>& gravity() const { return g_; }
  const std::vector<AuxiliaryPlane>& auxiliaries() const { return aux_; }
  std::vector<AuxiliaryPlane>& auxiliaries() { return aux_; }
  const SpeedProfile& speed() const { return speed_; }
  double free_from() const { return free_from_; }
  bool SpeedIsFree(double t) const { return t >= free_from_; }
  bool HasLoads() const { return !loads_.empty(); }
  // For an independent model of the same rotor (rotor/motion/rotor_stepper.h).
  const std::vector<ExternalLoad>& loads() const { return loads_; }
  const AuxiliaryParameters* axial_stop() const { return has_axial_ ? &axial_ : nullptr; }
  const BaseOnFloor& base() const { return base_; }
  int base_dof() const { return base_dof_; }
  double MountRate() const;  // fastest rate of a race on its mount [1/s], 0: none

 private:
  PlanePoint OnSurface(const MotionState& s, const PlaneMap& plane) const;
  int NewDof(double mass);
  /// theta, Omega of the speed profile at the state's time.
  void Prescribe(MotionState& s) const;
  /// Sure that nothing touches at the plane within the horizon, without a square root.
  bool FarFromContact(const MotionState& s, std::size_t plane, double horizon) const;
  double StiffnessRate(const MotionState& s) const;
  void StepOnce(MotionState& s, const DofVector& Q, double stator_x, double stator_y, double dt,
                bool near_contact) const;
  /// The same under `forced` alone, loads included.
  void StepUnder(MotionState& s, const DofVector& forced, double stator_x, double stator_y,
                 double dt, bool near_contact) const;
  /// Whether nothing but given forces and gyroscopics acts: a rigid rotor, touching nothing.
  bool IsUnforced(bool near_contact) const { return dof_ == 5 && !near_contact && terms.empty(); }
  /// StepOnce, to rounding, of a rotor that flies freely.
  void StepUnforced(MotionState& s, const DofVector& forced, double dt) const;

  RotorParameters p_;
  std::array<double, 3> g_;
  int dof_ = 5;
  std::array<double, kMaxDof> inverse_mass_{};
  ModalShaft shaft_;
  std::vector<AuxiliaryPlane> aux_;
  AuxiliaryParameters axial_;
  bool has_axial_ = false;
  int base_dof_ = -1;
  BaseOnFloor base_;
  std::vector<ExternalLoad> loads_;
  SpeedProfile speed_;
  double free_from_ = kInfinity;
};

}  // namespace ambrig
