#pragma once
/// Position control of a rig: readings and references in, forces out, once per controller period.
/// One interface for every controller; the base rig has one PID per axis.
#include <memory>
#include <vector>

namespace ambrig {

class PositionController {
 public:
  virtual ~PositionController() = default;
  /// y, r [m] and force excitation [N] per axis -> f [N] per axis (already clamped).
  virtual void Step(const std::vector<double>& y, const std::vector<double>& r,
                    const std::vector<double>& excitation, double Omega, std::vector<double>& f) = 0;
  /// Start so that `force` per axis comes out while the readings rest at y.
  virtual void Hold(const std::vector<double>& force, const std::vector<double>& y) = 0;
  virtual std::unique_ptr<PositionController> Clone() const = 0;
};

}  // namespace ambrig
