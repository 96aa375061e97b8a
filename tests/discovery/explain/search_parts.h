#pragma once
/// What the parts of a search work on, for a case whose measurements are written down: noise of
/// 2e-7 m at known places.
#include <gtest/gtest.h>

#include <vector>

#include "discovery/explain/coil_error_selection.h"
#include "discovery/explain/name_rankings.h"
#include "discovery/explain/nuisance_selection.h"
#include "discovery/explain/search_models.h"
#include "discovery/explain/search_progress.h"
#include "tests/discovery/measured_case.h"

namespace ambrig::testing {

/// Four places, held; the last record is kept back for validation. What the sensor of A.x adds
/// there: a gain, and the offset [m] of each record.
inline Case FourPlaces(double gain, const std::vector<double>& offsets) {
  return MeasuredCase({{2e-5, 3e-5, gain, offsets[0]},
                       {-6e-5, 1e-5, gain, offsets[1]},
                       {5e-5, -4e-5, gain, offsets[2]},
                       {-3e-5, -5e-5, gain, offsets[3]}});
}

/// The search as it is before the rig parameters are fitted.
class SearchParts : public ::testing::Test {
 protected:
  explicit SearchParts(const Case& c = FourPlaces(1, {0, 0, 0, 0}))
      : case_(c),
        nominal_(Hypothesis::Base(case_.rig)),
        models_(case_, nullptr, nullptr),
        progress_(options_, models_) {
    options_.candidates = 2;
    options_.rounds = 1;
    models_.LimitToHeld(nominal_);
    noise_ = models_.FindNoise(nominal_);
    models_.UseFloors(nominal_);
  }

  const Case case_;
  const Hypothesis nominal_;
  ExplainOptions options_;
  SearchModels models_;
  SearchProgress progress_;
  SearchModels::FoundNoise noise_;
  SearchLog log_;
  NuisanceSelection nuisances_{models_, log_, progress_};
  CoilErrorSelection coils_{models_, nuisances_, log_, progress_};
  AdoptedEffects adopted_{0};
  NameRankings names_;
};

}  // namespace ambrig::testing
