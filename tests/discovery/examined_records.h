#pragma once
/// A few records of an examination, as a logger writes them, and a search that is short enough for
/// tests.
#include <algorithm>
#include <string>
#include <vector>

#include "discovery/data/input_size.h"
#include "discovery/experiment/examination.h"
#include "discovery/experiment/measured_case.h"
#include "discovery/explain/explain.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_file.h"

namespace ambrig {

inline constexpr const char* kReferenceFile = "/scenarios/library/rigs/reference.toml";

/// What a rig has beside its file: a law, and records r whose inputs are larger by `larger[r]`.
struct ExaminedTruth {
  std::vector<EffectInstance> law = {};
  std::vector<double> larger = {};
};

/// The examination's records of these titles, of the rig of a file without its thrust bearing.
inline Case ExaminedRecords(const std::string& file, const std::vector<std::string>& titles,
                            const ExaminedTruth& is = {}) {
  RigParameters rig = ReadRig(std::string(AMBRIG_SOURCE_DIR) + file);
  std::erase_if(rig.bearings, [](const BearingParameters& b) { return b.kind->axial; });
  std::vector<ExaminationRecord> chosen;
  for (const ExaminationRecord& r : Examination(rig, 4))
    if (std::ranges::count(titles, r.title) > 0) chosen.push_back(r);
  Case c = EmptyCase(rig, chosen);
  const Case commanded = WithInputs(c, is.larger);
  const CaseModel model(commanded);
  Hypothesis truth;
  truth.rig = rig;
  truth.rig.effects = is.law;
  for (std::size_t r = 0; r < c.records.size(); ++r) MeasureRecord(model, truth, r, 31, 0.1, c);
  return c;
}

/// Two candidates in one round.
inline ExplainOptions ShortSearch() {
  ExplainOptions options;
  options.candidates = 2;
  options.rounds = 1;
  return options;
}

}  // namespace ambrig
