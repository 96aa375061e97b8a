#pragma once
/// Any linear controller between the errors e = r - y [m] and the forces [N] of its axes, by state
/// space:
///
///   f = C x + D e + offset + excitation, clamped to ±f_max per axis;   x+ = A x + B e
///
/// The offset is what a controller without integral action needs to carry a static force (the
/// weight); Hold sets it. With several speeds the matrices are interpolated by |Omega|
/// (control/position/gain_schedule.h); the states must mean the same at each. The state goes
/// on while a force is clamped.
#include "control/position/position_controller.h"

namespace ambrig {

class StateSpaceController : public PositionController {
 public:
  /// `points`: one system per speed, axes x axes, equal orders. @throws std::logic_error otherwise.
  StateSpaceController(std::vector<double> speeds, std::vector<StateSpace> points,
                       std::vector<double> f_max);
  void Step(const std::vector<double>& y, const std::vector<double>& r,
            const std::vector<double>& excitation, double Omega, std::vector<double>& f) override;
  void Hold(const std::vector<double>& force, const std::vector<double>& y,
            const std::vector<double>& r) override;
  StateSpace Linear(double Omega) const override;
  void WriteC(CCode& code) const override;
  std::unique_ptr<PositionController> Clone() const override {
    return std::make_unique<StateSpaceController>(*this);
  }

 private:
  StateSpace At(double Omega) const;

  std::vector<double> speeds_;
  std::vector<StateSpace> points_;
  std::vector<double> f_max_;
  StateSpace now_;         // the matrices in use
  double now_speed_ = -1;  // [rad/s]
  Eigen::VectorXd x_, next_, e_, offset_, raw_;
};

}  // namespace ambrig
