#pragma once
/// A law of the iron whose drop depends on the present flux alone: a flux that has stood for ever
/// drops what it drops now, and there is nothing to remember.
#include "actuators/magnetics/flux_law.h"

namespace ambrig {

class MemorylessLaw : public FluxLaw {
 public:
  std::optional<LinearDrop> LinearAt(const Lane& phi) const final {
    LinearDrop out;
    Lane drop{};
    Drop(phi, &drop, &out.slope);
    return out;
  }
  void Steady(const Lane& phi, Lane* drop, Lane* slope) const final { Drop(phi, drop, slope); }
  void Commit(const Lane& /*phi*/) final {}
  void Settle(const Lane& /*phi*/) final {}
};

}  // namespace ambrig
