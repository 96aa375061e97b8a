#include "discovery/case/test_records.h"

#include <algorithm>

namespace ambrig {

namespace {

/// The case with those of its records that are of the test, or are not; nothing where none is of
/// the test.
std::optional<Case> Part(const Case& c, bool of_test) {
  if (std::ranges::none_of(c.records, &CaseRecord::test)) return std::nullopt;
  Case part;
  part.file = c.file;
  part.rig_file = c.rig_file;
  part.rig = c.rig;
  part.noise = c.noise;
  part.nuisances = c.nuisances;
  part.notes = c.notes;
  std::ranges::copy_if(c.records, std::back_inserter(part.records),
                       [of_test](const CaseRecord& r) { return r.test == of_test; });
  return part;
}

}  // namespace

std::optional<Case> WithoutTestRecords(const Case& c) { return Part(c, false); }

std::optional<Case> TestRecordsOf(const Case& c) { return Part(c, true); }

bool AnyValidates(const Case& c) {
  return std::ranges::any_of(c.records, [](const CaseRecord& r) { return r.validate && !r.test; });
}

}  // namespace ambrig
