#pragma once
/// The plants of a campaign: healthy machines that each have effects which their controller and
/// their fault detection do not know, and parameters drawn from the sd in the rig file. [plants] of
/// a campaign file; docs/guide/campaign.md explains the keys by example.
///
/// An effect of "low" size has the weak end of its usual range (`ambrig effects`), "high" the
/// strong end, "typical" their geometric mean; what does not switch it on keeps its default. It
/// acts on all radial bearings, on the rig, or on one coil, axis or plane that is drawn. A mixture
/// has some effects of the list, each between both ends (evenly in the logarithm).
#include <string>
#include <vector>

#include "core/base/toml.h"
#include "rig/rig_parameters.h"

namespace ambrig {

struct CampaignPlant {
  std::string label, effect, size;      // "eddy-currents high", or "mixture" and its effects
  std::vector<EffectInstance> effects;  // added to those of the rig file
  std::vector<double> deviates;         // of every tolerance with an sd, times the scale [sd]
  double scale = 0;                     // [sd]
  bool commissioned = false;            // the detection has learnt this plant before its run
};

/// @throws InputError "file:line: key = value, allowed ..." for every mistake.
std::vector<CampaignPlant> ReadPlants(const TomlTable& table, const RigParameters& rig);

/// Gives the rig the plant's effects and true values.
void ApplyPlant(const CampaignPlant& plant, RigParameters* rig);

/// "cutoff 300 Hz": what switches an effect on, at size "low", "typical" or "high". Empty for a name
/// that is no effect's.
std::string EffectSizeText(const std::string& effect, const std::string& size);

/// True values `deviates` standard deviations off those in force; the nominal ones stay.
void DrawTolerances(const std::vector<double>& deviates, RigParameters* rig);

}  // namespace ambrig
