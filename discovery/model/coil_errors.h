#pragma once
/// Errors of single coils whose size the rig file states and not what each coil has: the gains of
/// the current measurements (amplifier.current_gain_spread) and the instants at which the bridges
/// switch (amplifier.edge_spread). A model draws all coils alike; these are the columns of their
/// errors.
#include <string>
#include <vector>

#include "discovery/model/hypothesis.h"
#include "discovery/model/nuisances.h"
#include "effects/effect.h"

namespace ambrig {

/// A kind of nuisance for each error of each coil, the same in all records; one sd is the spread of
/// the rig file. The floors of `model` are set. Simulates every record once for each; empty where
/// no spread is stated or `h` loses the rotor.
std::vector<NuisanceKind> CoilErrorKinds(const CaseModel& model, const Hypothesis& h);

/// Whether an effect is no larger than what single coils of this type can differ by, five times the
/// spread that the rig file states: not to be told from it.
bool IsWithinCoilErrors(const EffectInstance& effect, const RigParameters& rig);

/// What was found of single coils, on top of the errors that the bearings of `rig` are known to
/// have.
void AddCoilErrors(const std::vector<NuisanceFound>& found, RigParameters& rig);

}  // namespace ambrig
