#include "discovery/case/test_records.h"

#include <algorithm>

namespace ambrig {

namespace {

/// The case with those of its records that are of the test, or are not; nothing where none is of
/// the test.
std::optional<Case> Part(const Case& c, bool of_test) {
  if (std::ranges::none_of(c.records, &CaseRecord::test)) return std::nullopt;
  Case part = c;
  std::erase_if(part.records, [of_test](const CaseRecord& r) { return r.test != of_test; });
  return part;
}

}  // namespace

std::optional<Case> WithoutTestRecords(const Case& c) { return Part(c, false); }

std::optional<Case> TestRecordsOf(const Case& c) { return Part(c, true); }

bool AnyValidates(const Case& c) {
  return std::ranges::any_of(c.records, [](const CaseRecord& r) { return r.validate && !r.test; });
}

}  // namespace ambrig
