#include "fdd/model/loss_excess.h"

namespace ambrig {

LossExcess ExcessOfLoss(const LinkageModel& m, int coil) {
  if (m.coupling != Coupling::kSides || coil >= m.coils) return {};
  const double mutual = m.n[coil] * m.n[coil] * m.Permeance(0, 0)[coil], leakage = m.leakage[coil],
               both = 2 * mutual + leakage;
  return {(3 * mutual + 2 * leakage) / both, mutual / both};
}

}  // namespace ambrig
