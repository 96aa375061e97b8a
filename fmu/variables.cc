#include "fmu/variables.h"

#include <fmt/format.h>

#include <cmath>
#include "core/base/coil_name.h"

namespace ambrig {

namespace {

using Role = FmuVariable::Role;
using Type = FmuVariable::Type;

constexpr double kLongestRun = 1e5;  // [s], as of a scenario file

FmuVariable Variable(Role role, Type type, const std::string& name, const std::string& unit,
                     const std::string& words, double start = 0) {
  FmuVariable v;
  v.role = role;
  v.type = type;
  v.name = name;
  v.unit = unit;
  v.words = words;
  v.start = start;
  return v;
}

void AddParameters(const RigParameters& rig, const Scenario& scenario,
                   std::vector<FmuVariable>& to) {
  for (const std::string& path : ParameterPaths(rig)) {
    FmuVariable v = Variable(Role::kParameter, Type::kReal, path, "", "number of the rig file");
    ParameterRange(rig, path, &v.lo, &v.hi, &v.unit);
    v.start = *ParameterAt(rig, path);
    // A sensor's place counts as in the file.
    if (rig.beam && path.ends_with(".sensor.z")) v.start -= rig.nominal_com_z - rig.z_origin;
    if (std::isnan(v.start)) continue;  // not given, follows from others
    to.push_back(v);
  }
  to.push_back(Variable(Role::kSeed, Type::kInteger, "seed", "-", "of the noise",
                        static_cast<double>(scenario.seed)));
  to.back().lo = 0;
  to.back().hi = 2147483647;
  to.push_back(Variable(Role::kNoise, Type::kBoolean, "noise", "-", "measurements have noise",
                        scenario.noise ? 1 : 0));
  to.push_back(Variable(Role::kFaultTolerant, Type::kBoolean, "fault_tolerant", "-",
                        "faults are detected and currents redistributed",
                        scenario.fault_tolerant ? 1 : 0));
}

void AddInputs(const RigParameters& rig, const Scenario& scenario, std::vector<FmuVariable>& to) {
  const auto add = [&to](Role role, const std::string& name, const char* unit, const char* words,
                         std::size_t owner, int index) {
    to.push_back(Variable(role, Type::kReal, name, unit, words));
    to.back().owner = owner;
    to.back().index = index;
  };
  const std::vector<std::string> axes = AxisNames(rig);
  for (std::size_t a = 0; a < axes.size(); ++a)
    add(Role::kReference, "reference." + axes[a], "m", "wanted position", a, 0);
  for (std::size_t a = 0; a < axes.size(); ++a)
    add(Role::kForce, "force." + axes[a], "N", "added to the controller's force", a, 0);
  for (std::size_t b = 0; b < rig.bearings.size(); ++b)
    for (int j = 0; j < rig.bearings[b].coils(); ++j)
      add(Role::kCurrent, "current." + CoilName(rig.bearings[b].name, j), "A",
          "added to the coil's set-point", b, j);
  std::size_t plane = 0;
  for (const BearingParameters& b : rig.bearings) {
    int direction = 0;
    for (const std::string& axis : b.Axes())
      add(Role::kLoad, "load." + axis, "N", "on the shaft at the magnets", plane, direction++);
    ++plane;
  }
  for (const ShaftPlane& s : rig.stations) {
    add(Role::kLoad, fmt::format("load.{}.x", s.name), "N", "on the shaft", plane, 0);
    add(Role::kLoad, fmt::format("load.{}.y", s.name), "N", "on the shaft", plane++, 1);
  }
  add(Role::kAcceleration, "acceleration", "rad/s2",
      "of the shaft, from the communication point on", 0, 0);
  add(Role::kSpeed, "speed", "rad/s", "of the shaft, from the communication point on", 0, 0);
  to.back().start = scenario.speed.Speed(0);
}

std::vector<std::string> TargetsOf(const Fault& fault, const RigParameters& rig) {
  std::vector<std::string> names;
  switch (fault.target) {
    case FaultTarget::kCoil:
      for (const BearingParameters& b : rig.bearings)
        for (int j = 0; j < b.coils(); ++j) names.push_back(CoilName(b.name, j));
      break;
    case FaultTarget::kAxis:
      names = AxisNames(rig);
      break;
    case FaultTarget::kRig:
      names = {"rig"};
      break;
  }
  return names;
}

void AddFaultInputs(const RigParameters& rig, std::vector<FmuVariable>& to) {
  for (const Fault* fault : Faults())
    for (const std::string& target : TargetsOf(*fault, rig)) {
      const std::string name = fmt::format("fault.{}.{}", target, fault->kind);
      const std::size_t at = to.size();
      to.push_back(Variable(Role::kFault, Type::kBoolean, name, "-",
                            "becoming true: " + std::string(fault->doc)));
      to.back().fault = fault;
      to.back().target = target;
      for (const FaultParameter& p : fault->parameters) {
        to.push_back(Variable(Role::kFaultNumber, p.flag ? Type::kBoolean : Type::kReal,
                              fmt::format("{}.{}", name, p.key), std::string(p.unit),
                              std::string(p.doc), p.neutral));
        to.back().fault = fault;
        to.back().target = target;
        to.back().key = p.key;
        to.back().fault_at = at;
      }
    }
}

}  // namespace

std::vector<FmuVariable> FmuVariablesOf(const RigParameters& rig, const Scenario& scenario,
                                        const std::vector<SteppedOutput>& outputs) {
  std::vector<FmuVariable> all{Variable(Role::kTime, Type::kReal, "time", "s", "of the importer")};
  AddParameters(rig, scenario, all);
  AddInputs(rig, scenario, all);
  AddFaultInputs(rig, all);
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    const SteppedOutput& o = outputs[k];
    all.push_back(Variable(Role::kOutput, o.yes_no() ? Type::kBoolean : Type::kReal, o.name, o.unit,
                           o.words));
    all.back().owner = k;
  }
  return all;
}

Scenario OpenScenario(const RigParameters& rig) {
  Scenario s;
  s.name = rig.name;
  s.duration = kLongestRun;
  s.record_rate = rig.controller.rate;
  return s;
}

}  // namespace ambrig
