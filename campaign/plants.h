#pragma once
/// The plants of a campaign: healthy machines that each have effects which their controller and
/// their fault detection do not know, and parameters sampled from the sd in the rig file. [plants]
/// of a campaign file; docs/guide/campaign.md explains the keys by example.
///
/// An effect of "low" size has the weak end of its usual range (`ambrig effects`), "high" the
/// strong end, "typical" their geometric mean; what does not switch it on keeps its default. It
/// acts on all radial bearings (or those that `bearings` names), on the rig, or on one coil, axis
/// or plane that is sampled (of the bearings that are named, where it can). A mixture has some
/// effects of the list, each between both ends (evenly in the logarithm).
///
/// What happens to a plant between its commissioning and its run, neither of which the detection is
/// told: `warmer`, its copper has another temperature, and `sensor_drift`, the zeros of its
/// position sensors have moved. A plant that is not commissioned has them too.
#include <string>
#include <vector>

#include "core/base/toml.h"
#include "rig/parameters/rig_parameters.h"

namespace ambrig {

struct CampaignPlant {
  std::string label, effect, size;      // "eddy-currents high", or "mixture" and its effects
  std::vector<EffectInstance> effects;  // added to those of the rig file
  std::vector<double> deviates;         // of every tolerance with an sd, times the scale [sd]
  double scale = 0;                     // [sd]
  double unit = 1;                      // amplifier.unit: draws of what differs from coil to coil
  bool commissioned = false;            // the detection has learnt this plant before its run
  // Since then:
  double warmer = 0;                  // copper of all coils [K]
  std::vector<EffectInstance> drift;  // of the zeros of the position sensors, one per axis
};

/// @throws InputError "file:line: key = value, allowed ..." for every mistake.
std::vector<CampaignPlant> ReadPlants(const TomlTable& table, const RigParameters& rig);

/// Gives the rig the plant's effects and true values, as they are when it is commissioned.
void ApplyPlant(const CampaignPlant& plant, RigParameters* rig);

/// Gives the rig of ApplyPlant what has happened to the plant since: true resistances times
/// 1 + 0.00393 warmer, zeros of the sensors. The nominal values stay.
void AgePlant(const CampaignPlant& plant, RigParameters* rig);

/// "cutoff 300 Hz": what switches an effect on, at size "low", "typical" or "high". Empty for a
/// name that is no effect's.
std::string EffectSizeText(const std::string& effect, const std::string& size);

/// True values `deviates` standard deviations off those in force; the nominal ones stay.
void DrawTolerances(const std::vector<double>& deviates, RigParameters* rig);

}  // namespace ambrig
