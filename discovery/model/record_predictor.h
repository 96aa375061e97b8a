#pragma once
/// Seam: who predicts a record. The kind of the record decides; records over time have none of
/// these, the switching engine runs their scenario (CaseModel::Simulated).
#include <memory>
#include <vector>

#include "discovery/case/case.h"

namespace ambrig {

class RecordPredictor {
 public:
  virtual ~RecordPredictor() = default;
  /// Values of every channel of the record's `data`, in its order and units (each over its sd), for
  /// this hypothesis. false: the hypothesis cannot have been measured (its loop is unstable).
  /// Thread-safe.
  virtual bool Predict(const RigParameters& rig,
                       std::vector<std::vector<double>>& columns) const = 0;
};

/// nullptr for a record over time. `c` and `record`, one of its records, must outlive it.
std::unique_ptr<RecordPredictor> MakePredictor(const Case& c, const CaseRecord& record);

/// Whether the record's rows follow each other in time.
inline bool OverTime(const CaseRecord& record) { return record.kind == RecordKind::kTime; }

}  // namespace ambrig
