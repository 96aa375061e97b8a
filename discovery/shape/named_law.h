#pragma once
/// The catalogue's law of a named effect, fitted: where a refinement starts.
#include "discovery/search/fit.h"
#include "discovery/shape/shape.h"

namespace ambrig {

struct NamedLaw {
  FitResult base, fit;    // rig parameters alone; with the effect
  std::size_t index = 0;  // of the effect in fit.hypothesis.rig.effects
};

/// An effect that the rig file holds already is fitted from where it stands; else screened at
/// `target` ("": everywhere) and fitted.
/// @throws InputError for a target that the rig does not have, and when no fit holds the rotor.
NamedLaw FitNamedLaw(const CaseModel& model, const std::string& effect, const std::string& target,
                     double effective_sample_size,
                     const std::function<void(double, const std::string&)>& progress);

/// Largest flux density of a bearing's poles over all records of the case, with the hypothesis. [T]
double LargestDensity(const CaseModel& model, const Hypothesis& h, const std::string& bearing);

/// How far the records drive what the law of `named` depends on.
ShapeReach ReachOf(const CaseModel& model, const Hypothesis& h, const EffectInstance& named);

}  // namespace ambrig
