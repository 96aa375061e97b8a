#pragma once
/// What the commissioned detector concludes from one period, all coils of a bearing together.
#include <vector>

#include "fdd/diagnosis.h"

namespace ambrig {

struct CoilVerdict {
  bool alarm = false;     // some coil's ratio is above 1 in this period
  bool decided = false;   // `diagnosis` holds
  bool doubtful = false;  // of the model, in this period
  Diagnosis diagnosis;
  std::vector<Diagnosis> more;  // of other coils, decided together with it
  // the other winding of a thrust side whose ripple a loop of the decided one keeps out: whole
  std::vector<Diagnosis> beside;
  double excess = 0;  // c of the decided coil, the periods of the decision [-]
  // share of its turns that the decided coil truly has, where it had been taken for one with fewer;
  // 0: not so
  double turns = 0;

  /// No coil stands out.
  static CoilVerdict Calm(bool doubtful) {
    CoilVerdict out;
    out.doubtful = doubtful;
    return out;
  }

  /// Blames all of them, one at least, the first by name.
  void Blame(const std::vector<Diagnosis>& failed) {
    diagnosis = failed[0];
    more.assign(failed.begin() + 1, failed.end());
  }
};

}  // namespace ambrig
