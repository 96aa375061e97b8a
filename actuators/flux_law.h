#pragma once
/// Seam for iron that is not ideal: the extra MMF that a pole's iron needs besides its gap.
/// The base rig has none (ideal iron, fast diagonal-plus-rank-one path); effects implement it.

namespace ambrig {

class FluxLaw {
 public:
  virtual ~FluxLaw() = default;
  /// MMF drop [A] and its slope [A/Wb] of pole `j` if its flux is `phi` [Wb] at the end of a step
  /// of `h` seconds that starts from the law's present state.
  virtual void Drop(int j, double phi, double h, double* drop, double* slope) const = 0;
  /// The step is taken: remember it (turning points, diffused flux).
  virtual void Commit(int j, double phi, double h) = 0;
  /// Settle at a steady flux (start of a run).
  virtual void Settle(int j, double phi) = 0;
};

}  // namespace ambrig
