#include "rotor/crosscheck/ode_world.h"

#include <ode/ode.h>

#include <cstdarg>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

namespace ambrig {

static_assert(sizeof(dReal) == sizeof(double), "ambrig needs ODE in double precision");

namespace {

thread_local long warnings = 0;

std::string Text(const char* format, va_list arguments) {
  char line[400];
  std::vsnprintf(line, sizeof line, format, arguments);
  return line;
}

// ODE's own handlers print and end the program.
void Warn(int, const char*, va_list) { ++warnings; }
[[noreturn]] void Fail(int number, const char* format, va_list arguments) {
  throw std::runtime_error("ODE error " + std::to_string(number) + ": " + Text(format, arguments));
}

struct Initialised {
  Initialised() {
    dSetMessageHandler(Warn);
    dSetErrorHandler(Fail);
    dSetDebugHandler(Fail);
    if (dInitODE2(0) == 0) throw std::runtime_error("ODE cannot be initialised");
    if (dCheckConfiguration("ODE_double_precision") == 0)
      throw std::runtime_error("the installed libode is not of double precision");
  }
  ~Initialised() { dCloseODE(); }
};

Eigen::Vector3d Vector(const dReal* v) { return {v[0], v[1], v[2]}; }

}  // namespace

struct OdeWorld::Library {
  dWorldID world = nullptr;
  dJointGroupID once = nullptr;  // joints of one step
  std::vector<dBodyID> bodies;

  dBodyID Body(int k) const {
    return k == kOdeStatic ? nullptr : bodies.at(static_cast<std::size_t>(k));
  }
};

OdeWorld::OdeWorld() : ode_(std::make_unique<Library>()) {
  static const Initialised initialised;  // once for the program, on whatever thread
  ode_->world = dWorldCreate();
  ode_->once = dJointGroupCreate(0);
  dWorldSetAutoDisableFlag(ode_->world, 0);
  dWorldSetContactSurfaceLayer(ode_->world, 0);
}

OdeWorld::~OdeWorld() {
  dJointGroupDestroy(ode_->once);
  dWorldDestroy(ode_->world);
}

int OdeWorld::AddBody(double mass, const Eigen::Vector3d& inertia, bool gyroscopic) {
  const dBodyID body = dBodyCreate(ode_->world);
  dMass m;
  dMassSetParameters(&m, mass, 0, 0, 0, inertia.x(), inertia.y(), inertia.z(), 0, 0, 0);
  dBodySetMass(body, &m);
  dBodySetGyroscopicMode(body, gyroscopic);
  dBodySetFiniteRotationMode(body, 1);  // turns by h ω, not by its first-order quaternion
  ode_->bodies.push_back(body);
  return static_cast<int>(ode_->bodies.size()) - 1;
}

void OdeWorld::AddHinge(int one, int two, const Eigen::Vector3d& anchor) {
  const dJointID hinge = dJointCreateHinge(ode_->world, nullptr);
  dJointAttach(hinge, ode_->Body(one), ode_->Body(two));
  dJointSetHingeAnchor(hinge, anchor.x(), anchor.y(), anchor.z());
  dJointSetHingeAxis(hinge, 0, 0, 1);
}

void OdeWorld::SetPose(int body, const Eigen::Vector3d& place, const Eigen::Matrix3d& turn) {
  dMatrix3 r = {};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) r[4 * row + column] = turn(row, column);
  dBodySetPosition(ode_->Body(body), place.x(), place.y(), place.z());
  dBodySetRotation(ode_->Body(body), r);
}

void OdeWorld::SetVelocity(int body, const Eigen::Vector3d& v) {
  dBodySetLinearVel(ode_->Body(body), v.x(), v.y(), v.z());
}

void OdeWorld::SetTurning(int body, const Eigen::Vector3d& omega) {
  dBodySetAngularVel(ode_->Body(body), omega.x(), omega.y(), omega.z());
}

Eigen::Vector3d OdeWorld::Place(int body) const {
  return Vector(dBodyGetPosition(ode_->Body(body)));
}

Eigen::Matrix3d OdeWorld::Turn(int body) const {
  const dReal* r = dBodyGetRotation(ode_->Body(body));
  Eigen::Matrix3d turn;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) turn(row, column) = r[4 * row + column];
  return turn;
}

Eigen::Vector3d OdeWorld::Velocity(int body) const {
  return Vector(dBodyGetLinearVel(ode_->Body(body)));
}

Eigen::Vector3d OdeWorld::Turning(int body) const {
  return Vector(dBodyGetAngularVel(ode_->Body(body)));
}

void OdeWorld::AddForce(int body, const Eigen::Vector3d& f) {
  dBodyAddForce(ode_->Body(body), f.x(), f.y(), f.z());
}

void OdeWorld::AddTorque(int body, const Eigen::Vector3d& m) {
  dBodyAddTorque(ode_->Body(body), m.x(), m.y(), m.z());
}

void OdeWorld::AddContact(const OdeContact& contact) {
  dContact c = {};
  c.surface.mode =
      dContactMu2 | dContactFDir1 | dContactSoftERP | dContactSoftCFM | dContactApprox1;
  c.surface.mu = contact.friction;
  c.surface.mu2 = 0;
  c.surface.soft_erp = contact.erp;
  c.surface.soft_cfm = contact.cfm;
  for (int k = 0; k < 3; ++k) {
    c.geom.pos[k] = contact.point[k];
    c.geom.normal[k] = contact.normal[k];
    c.fdir1[k] = contact.slide[k];
  }
  c.geom.depth = contact.depth;
  dJointAttach(dJointCreateContact(ode_->world, ode_->once, &c), ode_->Body(contact.one),
               ode_->Body(contact.two));
}

void OdeWorld::AddMotor(int body, const Eigen::Vector3d& axis, double speed) {
  const dJointID motor = dJointCreateAMotor(ode_->world, ode_->once);
  dJointAttach(motor, ode_->Body(body), nullptr);
  dJointSetAMotorMode(motor, dAMotorUser);
  dJointSetAMotorNumAxes(motor, 1);
  dJointSetAMotorAxis(motor, 0, 0, axis.x(), axis.y(), axis.z());
  dJointSetAMotorParam(motor, dParamVel, speed);
  dJointSetAMotorParam(motor, dParamFMax, dInfinity);
}

void OdeWorld::Step(double h) {
  const int done = dWorldStep(ode_->world, h);
  dJointGroupEmpty(ode_->once);
  if (done == 0) throw std::runtime_error("ODE has no memory for a step");
}

long OdeWorld::Warnings() { return warnings; }

}  // namespace ambrig
