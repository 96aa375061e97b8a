#pragma once
/// A stator of any kind as a rig file describes it: its poles one by one, or a template with a few
/// numbers that expands to poles (stator_templates.cc). Source: docs/theory/stators.md.
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "actuators/magnetics/stator_geometry.h"
#include "core/base/parameters.h"

namespace ambrig {

/// A permanent magnet: reluctance length/(mu0 mu_r area).
struct BiasMagnet {
  double mmf = 0;             // [A], 0: none
  double length = kRequired;  // along its flux [m]
  double area = kRequired;    // [m2]
  double mu_r = 1.05;         // recoil permeability [-]
  double Reluctance() const;  // [1/H]
};

inline constexpr Field<BiasMagnet> kBiasMagnetFields[] = {
    {"mmf", &BiasMagnet::mmf, "A", -1e6, 1e6,
     "magnetomotive force, H_c times length; its sign turns the bias"},
    {"length", &BiasMagnet::length, "m", 1e-5, 1, "along the flux"},
    {"area", &BiasMagnet::area, "m2", 1e-8, 1, "across the flux"},
    {"mu_r", &BiasMagnet::mu_r, "-", 1, 100, "recoil permeability"},
};

/// One pole. Of an axial stator `angle_deg` is without meaning and `side` +1 or -1.
struct StatorPole {
  double angle_deg = 0, cone_deg = 0;
  double area = kRequired, gap = kRequired;
  double plane = 1;  // of the iron that it stands on, from 1
  double side = 1;
  std::map<int, double> turns;  // coil from 0 -> signed turns
  std::optional<BiasMagnet> magnet;
};

inline constexpr Field<StatorPole> kStatorPoleFields[] = {
    {"angle_deg", &StatorPole::angle_deg, "deg", -720, 720,
     "direction of its pull from the x axis"},
    {"area", &StatorPole::area, "m2", 1e-8, 1.0, "of its face"},
    {"gap", &StatorPole::gap, "m", 1e-6, 1e-1, "rotor centred"},
    {"cone_deg", &StatorPole::cone_deg, "deg", -80, 80, "of the gap's normal out of the plane"},
    {"plane", &StatorPole::plane, "-", 1, 4,
     "iron that it belongs to: poles of one plane share it"},
    {"side", &StatorPole::side, "-", -1, 1, "axial-stator: 1 pulls towards +z, -1 towards -z"},
};

struct StatorParameters {
  std::string pattern;     // template; empty: `poles` are given
  std::string winding;     // letters N and S; empty: the template's
  std::string connection;  // how a template joins its windings to coils; empty: its first
  double turns = kRequired, pole_area = kRequired, gap = kRequired;
  double pole_count = 0;                    // 0: the template's
  double first_pole_angle_deg = kRequired;  // nan: the template's
  double cone_deg = 0;
  double leakage_inductance = kRequired, resistance = kRequired;
  double bias_current = kRequired;  // nan: the controller's, 0 where magnets give the bias
  BiasMagnet bias;
  bool bias_in_poles = false;     // a template with a magnet in every pole
  bool axial = false;             // along the shaft
  std::vector<StatorPole> poles;  // of a file that gives them
};

inline constexpr Field<StatorParameters> kStatorFields[] = {
    {"leakage_inductance", &StatorParameters::leakage_inductance, "H", 1e-9, 1.0,
     "L_l, per coil, never zero"},
    {"resistance", &StatorParameters::resistance, "ohm", 1e-6, 1e4, "R, per coil"},
};
/// Of a template.
inline constexpr Field<StatorParameters> kStatorTemplateFields[] = {
    {"turns", &StatorParameters::turns, "-", 1, 1e4, "N, per wound pole"},
    {"pole_area", &StatorParameters::pole_area, "m2", 1e-8, 1.0, "A, per pole"},
    {"gap", &StatorParameters::gap, "m", 1e-6, 1e-1, "g0, rotor centred"},
};

/// What a template makes; one function for each, in stator_templates.cc.
struct StatorTemplate {
  const char* name;
  const char* doc;
  bool axial;
  int poles;                  // default, 0: fixed
  int least, most, multiple;  // that a file may ask for
  const char* connections;    // allowed words of `coils`, the first is the default
  bool magnet;                // needs `bias`
  std::vector<StatorPole> (*expand)(const StatorParameters& p);
};
const std::vector<StatorTemplate>& StatorTemplates();
/// nullptr: no template has this name.
const StatorTemplate* FindStatorTemplate(const std::string& name);

/// Poles as given, or as the template expands.
std::vector<StatorPole> PolesOf(const StatorParameters& p);
int CoilsOf(const std::vector<StatorPole>& poles);
/// Of an axial stator z takes the place of x, as everywhere (stator_geometry.h).
std::shared_ptr<const PoleNetwork> NetworkOf(const StatorParameters& p);
StatorGeometry GeometryOf(const StatorParameters& p);

}  // namespace ambrig
