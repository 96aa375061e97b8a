#pragma once
/// Magnetic bearings of ROSS (MagneticBearingElement) as the tables of a rig of ours. ROSS's
/// bearing per axis is two horseshoes of two poles, k_s = -mu0 nw² ag i0² cos(alpha)/g0³ and
/// k_i = mu0 nw² ag i0 cos(alpha)/g0² with nw turns on both poles of a horseshoe: here poles of
/// nw/2 turns, `gap` g0, `pole_area` ag, `bias_current` i0. Its controller gives a current k_amp
/// k_sense (kp + ki/s + kd s/(1 + s/n_f)) x; ours gives forces, so k_i times that, with
/// derivative_time_constant = 1/n_f. Source: ross/bearing_seal_element.py of version 2.3;
/// Schweitzer and Maslen, Magnetic Bearings, 2009, 69 to 80 and 343.
#include "rotor/shaft/beam_file.h"
#include "rotor/shaft/ross_elements.h"

namespace ambrig {

struct RossMagnet {
  std::string name;  // as a name of ours, without blanks and dots
  double z = 0;      // on the axis of nodes [m]
  std::string shaft;
  double gap = 0, bias = 0, area = 0, turns = 0, alpha = 0;  // g0, i0, ag, nw, alpha
  double kp = 0, ki = 0, kd = 0, cutoff = 0;                 // gains of the current, n_f [rad/s]
  double current_gain() const;                               // k_i [N/A]
};

/// Whether an element is one, whatever class it was saved as: version 2.3 saves one as a
/// BearingElement with the coefficients of its controller at some speeds.
bool IsRossMagneticBearing(const RossElement& element);

/// What a rig cannot say of it goes to `lost`. @throws InputError for numbers that are no bearing.
RossMagnet ReadRossMagnet(const RossElement& element, std::vector<std::string>& lost);

/// A rig file of a shaft in these bearings; what ROSS does not say (amplifiers,
/// sampling, sensors, auxiliary bearings) is assumed and marked so.
std::string MagneticRigText(const BeamFile& shaft, std::vector<RossMagnet> magnets);

/// The way back: what of a rig file's [bearings] ROSS's magnetic bearings are, with z as in
/// its [rotor]. Bearings that are none of these (another winding, thrust) and what ROSS does not
/// know of them go to `lost`.
std::vector<RossMagnet> MagnetsOfRig(const std::string& rig_file, std::vector<std::string>& lost);

/// Why a shaft cannot be a rig's, "" when it can: several shafts, housings, added masses,
/// axial forces, torque.
std::string NoRigShaft(const BeamDefinition& definition);

}  // namespace ambrig
