#pragma once
/// What is left of the errors of single coils (discovery/model/coil_errors.h) once they are taken
/// off to first order: where a current loop is at its limits, a machine whose coils are a little
/// different does not differ in proportion. That is no effect to be named.
#include <string>
#include <vector>

#include "discovery/model/case_model.h"

namespace ambrig {

/// Errors over the noise of machines of one type: the largest of some that are sampled.
struct UnitErrors {
  double largest = 1;  // of all fitted records, or of all unseen ones
  // of each target, by any channel of its kind in its record; empty where the rig file states no
  // spread
  std::vector<double> most;
};

/// Changes over the floor of some machines of the type from the nominal model `h`, all rows of the
/// model; nothing is taken off. Empty where the rig file states no spread or `h` loses the rotor.
std::vector<std::vector<double>> ChangesOfUnits(const CaseModel& model, const Hypothesis& h);

/// What the model's nuisances leave of such changes.
UnitErrors ErrorsOfUnits(const CaseModel& model, const std::vector<std::vector<double>>& changes);

/// Whether another unit of this type would leave a residual as large as this one, in every channel
/// of every record.
bool IsWithinUnits(const CaseModel& model, const std::vector<double>& residual,
                   const UnitErrors& of_units);

/// What a comparison with the nominal model `h` says of the coils: how much of its error those of
/// any machine of the type make. Empty where the rig file states no spread or nothing but noise is
/// left.
std::string SaidOfCoils(const CaseModel& model, const Hypothesis& h,
                        const std::vector<double>& residual);

}  // namespace ambrig
