#pragma once
/// The bodies behind an OdeRotor (rotor/crosscheck/ode_rotor.h), private to its sources.
#include <vector>

#include "rotor/crosscheck/ode_rotor.h"
#include "rotor/crosscheck/ode_world.h"

namespace ambrig {

class OdeRotor::Rig {
 public:
  Rig(const RotorModel& model, const OdeOptions& options);
  void Step(MotionState& s, const DofVector& Q, const Eigen::Vector3d& stator, double dt);

  long steps = 0, first_warning = OdeWorld::Warnings();

 private:
  struct Race {
    const AuxiliaryPlane* plane = nullptr;
    int body = kOdeStatic;  // itself, the base, or the frame
    bool on_mount = false, turns = false;
  };
  void Load(const MotionState& s);
  void Store(MotionState& s, double h) const;
  void AddForces(const MotionState& s, const DofVector& Q, const Eigen::Vector3d& stator, double h);
  void AddMounts(const Eigen::Vector3d& floor);
  bool AddContacts(const MotionState& s, double h);
  void AddContact(const AuxiliaryParameters& p, OdeContact c, double h);
  void TurnAndStep(MotionState& s, bool contact, double h);
  double LongestStep(const MotionState& s, double dt) const;
  Eigen::Vector3d Axis() const { return world_.Turn(rotor_).col(2); }
  Eigen::Vector3d BasePlace() const {
    return base_ < 0 ? Eigen::Vector3d::Zero() : world_.Place(base_);
  }
  Eigen::Vector3d BaseVelocity() const {
    return base_ < 0 ? Eigen::Vector3d::Zero() : world_.Velocity(base_);
  }

  const RotorModel& model_;
  OdeOptions options_;
  OdeWorld world_;
  double Ip_, It_;
  int rotor_ = 0, base_ = kOdeStatic;
  std::vector<Race> races_;
};

}  // namespace ambrig
