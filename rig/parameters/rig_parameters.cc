#include "rig/parameters/rig_parameters.h"

#include <cmath>

#include "control/interface/controller_kind.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/parameters/rig_rotor.h"

namespace ambrig {

namespace {

/// Calls visit(path, place) for every number of the rig's tables.
template <class Visit>
void VisitNumbers(RigParameters& rig, const Visit& visit) {
  const auto below = [&](const std::string& section) -> PlaceVisitor {
    return [&visit, section](const ParameterPlace& p) {
      visit(section + "." + std::string(p.key), p);
    };
  };
  // a beam's mass and inertia follow from its shaft
  if (!rig.beam) VisitPlaces(rig.rotor, kRotorFields, below("rotor"));
  VisitPlaces(rig.amplifier, kAmplifierFields, below("amplifier"));
  VisitPlaces(rig.amplifier, kAmplifierModeFields, below("amplifier"));
  VisitPlaces(rig.amplifier, kAmplifierErrorFields, below("amplifier"));
  VisitPlaces(rig.speed_sensor, kSpeedSensorFields, below("speed_sensor"));
  VisitPlaces(rig.controller, kControllerFields, below("controller"));
  VisitPlaces(rig.controller.pid, kPidFields, below("controller"));
  for (BearingParameters& b : rig.bearings) {
    const std::string section = "bearings." + b.name;
    b.kind->numbers(b, below(section));
    VisitPlaces(b.sensor, kSensorFields, below(section + ".sensor"));
    if (b.auxiliary) VisitPlaces(*b.auxiliary, kAuxiliaryFields, below(section + ".auxiliary"));
    if (b.controller) VisitPlaces(*b.controller, kPidFields, below(section + ".controller"));
  }
}

/// The same of a rig that stays as it is: the places are only read.
template <class Visit>
void VisitNumbers(const RigParameters& rig, const Visit& visit) {
  VisitNumbers(const_cast<RigParameters&>(rig), visit);
}

}  // namespace

std::vector<std::string> AxisNames(const RigParameters& rig) {
  std::vector<std::string> names;
  for (const BearingParameters& b : rig.bearings)
    for (const std::string& name : b.Axes()) names.push_back(name);
  return names;
}

std::vector<std::size_t> ControlledAxes(const RigParameters& rig) {
  std::vector<std::size_t> axes;
  std::size_t k = 0;
  for (const BearingParameters& b : rig.bearings)
    for (std::size_t side = 0; side < b.Axes().size(); ++side, ++k)
      if (!b.controller) axes.push_back(k);
  return axes;
}

const BearingParameters* RigParameters::Find(const std::string& bearing) const {
  for (const auto& b : bearings)
    if (b.name == bearing) return &b;
  return nullptr;
}

const ShaftPlane* RigParameters::FindStation(const std::string& station) const {
  for (const auto& s : stations)
    if (s.name == station) return &s;
  return nullptr;
}

int RigParameters::periods_per_control() const {
  return static_cast<int>(std::lround(amplifier.switching_frequency / controller.rate));
}

std::vector<std::string> ParameterPaths(const RigParameters& rig) {
  std::vector<std::string> paths;
  VisitNumbers(rig, [&](const std::string& path, const ParameterPlace&) { paths.push_back(path); });
  if (rig.beam)
    for (const ShaftParameter& p : rig.beam->parameters) paths.push_back(p.path);
  return paths;
}

const double* ParameterAt(const RigParameters& rig, const std::string& path) {
  const double* found = nullptr;
  VisitNumbers(rig, [&](const std::string& at, const ParameterPlace& p) {
    if (path == at) found = p.at;
  });
  if (rig.beam)
    for (const ShaftParameter& p : rig.beam->parameters)
      if (p.path == path) found = &p.value;
  return found;
}

bool SetParameter(RigParameters& rig, const std::string& path, double value) {
  for (std::size_t k = 0; rig.beam && k < rig.beam->parameters.size(); ++k)
    if (rig.beam->parameters[k].path == path) {
      SetShaft(rig, k, value);
      return true;
    }
  bool found = false;
  VisitNumbers(rig, [&](const std::string& at, const ParameterPlace& p) {
    if (path != at) return;
    *p.at =
        rig.beam && path.ends_with(".sensor.z") ? value + rig.nominal_com_z - rig.z_origin : value;
    found = true;
  });
  return found;
}

bool ParameterRange(const RigParameters& rig, const std::string& path, double* lo, double* hi,
                    std::string* unit) {
  bool found = false;
  VisitNumbers(rig, [&](const std::string& at, const ParameterPlace& p) {
    if (path != at) return;
    *lo = p.lo;
    *hi = p.hi;
    *unit = p.unit;
    found = true;
  });
  for (std::size_t k = 0; rig.beam && k < rig.beam->parameters.size(); ++k)
    if (const ShaftParameter& p = rig.beam->parameters[k]; p.path == path) {
      *lo = p.lo;
      *hi = p.hi;
      *unit = p.unit;
      found = true;
    }
  return found;
}

std::vector<ParameterRow> RigParameterRows() {
  std::vector<ParameterRow> rows;
  const auto add = [&](const std::string& section, const auto& fields) {
    AddRows(rows, section, fields);
  };
  add("[rotor]", kRotorFields);
  add("[rotor.materials.NAME]", kMaterialFields);
  add("[[rotor.section]]", kShaftSectionFields);
  add("[[rotor.disk]]", kDiskFields);
  add("[amplifier]", kAmplifierFields);
  add("[amplifier]", kAmplifierModeFields);
  add("[amplifier]", kAmplifierErrorFields);
  add("[speed_sensor]", kSpeedSensorFields);
  add("[controller]", kControllerFields);
  for (const ControllerKind* kind : ControllerKinds())
    if (kind->document) kind->document(rows);
  add("[controller.unbalance]", kUnbalanceControlFields);
  for (const BearingKind* kind : BearingKinds()) kind->document(rows);
  add("[bearings.A.sensor]", kSensorFields);
  add("[bearings.A.auxiliary]", kAuxiliaryFields);
  add("[bearings.A.controller]", kPidFields);
  add("[detection]", kDetectionFields);
  return rows;
}

}  // namespace ambrig
