#include "scenarios/faults/fault_ends.h"

#include <algorithm>

#include "core/base/errors.h"

namespace ambrig {

void FaultEnds::Add(const Fault& fault, const FaultSpec& spec) {
  if (!fault.duration) return;
  std::erase_if(ends_, [&](const End& e) {
    return e.spec->kind == spec.kind && e.spec->target == spec.target;
  });
  ends_.push_back({spec.time + fault.duration(spec), &spec});
  FindNext();
}

const FaultSpec& FaultEnds::Take() {
  const auto first = std::min_element(ends_.begin(), ends_.end(),
                                      [](const End& a, const End& b) { return a.time < b.time; });
  Require(first != ends_.end(), "a fault that ends");
  const FaultSpec& spec = *first->spec;
  ends_.erase(first);
  FindNext();
  return spec;
}

void FaultEnds::FindNext() {
  next_ = std::numeric_limits<double>::infinity();
  for (const End& e : ends_) next_ = std::min(next_, e.time);
}

}  // namespace ambrig
