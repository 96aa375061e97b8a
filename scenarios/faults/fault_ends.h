#pragma once
/// Ends of faults that are still to come in a run.
#include <limits>
#include <vector>

#include "scenarios/faults/fault.h"

namespace ambrig {

class FaultEnds {
 public:
  /// After the fault was put into the plant; one of the same kind and target that has not ended yet
  /// no longer ends by itself. `spec` must outlive the run.
  void Add(const Fault& fault, const FaultSpec& spec);
  double next() const { return next_; }  // [s], infinite: none
  /// The fault that ends at next(); there must be one.
  const FaultSpec& Take();

 private:
  struct End {
    double time;  // [s]
    const FaultSpec* spec;
  };
  void FindNext();
  std::vector<End> ends_;
  double next_ = std::numeric_limits<double>::infinity();
};

}  // namespace ambrig
