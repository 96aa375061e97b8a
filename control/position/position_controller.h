#pragma once
/// Position control of a rig: readings and references in, forces out, once per controller period.
/// One interface for every controller; the base rig has one PID per axis.
#include <memory>
#include <vector>

#include "control/current/bearing_control.h"
#include "control/linear/state_space.h"

namespace ambrig {

class CCode;

class PositionController {
 public:
  virtual ~PositionController() = default;
  /// Before each Step: the coils of all bearings as they are controlled now, and the time [s]. For
  /// controllers that look at more than positions.
  virtual void Observe(const std::vector<BearingControl>& /*control*/, double /*t*/) {}
  /// y, r [m] and force excitation [N] per axis -> f [N] per axis (already clamped).
  virtual void Step(const std::vector<double>& y, const std::vector<double>& r,
                    const std::vector<double>& excitation, double Omega,
                    std::vector<double>& f) = 0;
  /// The set-points [A] of a bearing of the rig, from the last Step, where the controller commands
  /// currents itself; nullptr: the current map makes them from the forces.
  virtual const Lane* SetPoints(std::size_t /*bearing*/) const { return nullptr; }
  /// Start so that `force` per axis [N] comes out while the readings rest at y and the references
  /// at r [m].
  virtual void Hold(const std::vector<double>& force, const std::vector<double>& y,
                    const std::vector<double>& r) = 0;
  /// One period in which somebody else commanded `f` [N]: the state follows, nothing comes out.
  /// What a controller does before it takes over; an observer learns from `f`, others only from the
  /// readings.
  virtual void Track(const std::vector<double>& y, const std::vector<double>& r, double Omega,
                     const std::vector<double>& f) {
    const std::vector<double> none(y.size(), 0.0);
    std::vector<double> unused(f.size());
    Step(y, r, none, Omega, unused);
  }
  /// Small signals, no limits, r = 0: readings [m] -> forces [N] at the controller's rate and this
  /// speed [rad/s].
  virtual StateSpace Linear(double Omega) const = 0;
  virtual std::unique_ptr<PositionController> Clone() const = 0;
  /// Writes the controller as C99 (control/position/c_code/c_code.h). @throws InputError unless
  /// its class can.
  virtual void WriteC(CCode& code) const;
};

}  // namespace ambrig
