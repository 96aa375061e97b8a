#pragma once
/// The keys of a bearing of kind "stator" or "axial-stator" in a rig file.
#include "actuators/magnetics/stator_parameters.h"
#include "core/base/toml.h"

namespace ambrig {

/// Over what `p` holds already (a bearing `like` another). @throws InputError
void ReadStator(const TomlTable& t, bool axial, StatorParameters& p,
                std::vector<Tolerance>* tolerances);

/// Of all radial ones, or of all axial ones: comma separated.
std::string StatorTemplateNames(bool axial);

/// What must hold between a stator and its amplifiers, at the centre: a bias without a net force,
/// forces in all directions, currents of both signs where only magnets bias.
/// `bias`: the controller's bias current [A], `unipolar`: bridges of two quadrants.
/// @throws InputError
void CheckStator(const TomlTable& t, const StatorParameters& p, double bias, bool unipolar);

/// The bias current that holds [A]: its own, nothing where magnets bias it, else `bias`.
double BiasOf(const StatorParameters& p, double bias);

}  // namespace ambrig
