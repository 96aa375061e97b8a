#pragma once
/// Feedback linearisation: a PID in force units, and for each bearing the currents that give
/// this force where the rotor is, by the inverse of the magnets' law instead of the bias-current
/// map. The forces neither fall off with the square of the current nor grow as the gap closes: the
/// rotor is a mass without negative stiffness. The sensors may stand beside the magnets: the place
/// of a rigid rotor in the planes of the magnets is taken from all sensors, z of both as in the rig
/// file. Coils that fail are not redistributed.
#include "control/interface/controller_kind.h"
#include "control/position/pid.h"

namespace ambrig {

class FeedbackLinearisation : public PositionController {
 public:
  FeedbackLinearisation(std::vector<PidParameters> axes, const ControllerSite& site);
  void Step(const std::vector<double>& y, const std::vector<double>& r,
            const std::vector<double>& excitation, double Omega, std::vector<double>& f) override;
  const Lane* SetPoints(std::size_t bearing) const override;
  void Hold(const std::vector<double>& force, const std::vector<double>& y,
            const std::vector<double>& r) override;
  /// Of the forces that the bias-current map would be asked for: the PID's less k_s r, r in
  /// the magnets' planes.
  StateSpace Linear(double Omega) const override;
  std::unique_ptr<PositionController> Clone() const override {
    return std::make_unique<FeedbackLinearisation>(*this);
  }

 private:
  struct Bearing {
    std::size_t index = 0, first = 0;  // in the rig; of its axes
    std::size_t axes = 2;
    MagnetInverse inverse;
    Lane set_points;                // [A]
    Eigen::Matrix2Xd place_from_y;  // rotor in the plane of the magnets from all readings
  };
  void Invert(const std::vector<double>& y, const std::vector<double>& f);

  DecentralisedPid pid_;
  std::vector<Bearing> bearings_;
};

}  // namespace ambrig
