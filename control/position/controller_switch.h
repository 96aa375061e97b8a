#pragma once
/// Several controllers of one rig, one of them in charge; changing over without a bump.
///
/// The one that takes over first holds the force of some periods ago and follows the readings since
/// then (PositionController::Track). In the period of the change both compute; the difference of
/// their forces is carried on and fades, so that the force has no step:
///   f = clamp(f_new + (f_old - f_new)_0 exp(-k Ts / fade)).
#include <deque>

#include "control/position/position_controller.h"

namespace ambrig {

class ControllerSwitch : public PositionController {
 public:
  static constexpr std::size_t kRemembered = 64;  // periods that the new one follows
  static constexpr double kFade = 0.02;           // [s]

  /// The first is in charge. f_max [N] per axis.
  ControllerSwitch(std::vector<std::unique_ptr<PositionController>> controllers,
                   std::vector<double> f_max, double Ts);
  /// One more controller of the rig, which is in charge when it is switched to; returns its index.
  std::size_t Add(std::unique_ptr<PositionController> controller);
  /// From the next Step on. Cheap when `index` is in charge already.
  void SwitchTo(std::size_t index);
  std::size_t in_charge() const { return now_; }

  void Observe(const std::vector<BearingControl>& control, double t) override {
    for (const auto& c : controllers_) c->Observe(control, t);
  }
  const Lane* SetPoints(std::size_t bearing) const override {
    return controllers_[now_]->SetPoints(bearing);
  }
  void Step(const std::vector<double>& y, const std::vector<double>& r,
            const std::vector<double>& excitation, double Omega, std::vector<double>& f) override;
  void Hold(const std::vector<double>& force, const std::vector<double>& y,
            const std::vector<double>& r) override;
  void Track(const std::vector<double>& y, const std::vector<double>& r, double Omega,
             const std::vector<double>& f) override;
  StateSpace Linear(double Omega) const override { return controllers_[now_]->Linear(Omega); }
  std::unique_ptr<PositionController> Clone() const override;

 private:
  struct Moment {
    std::vector<double> y, r, f;
    double Omega = 0;
  };
  void ChangeOver(const std::vector<double>& y, const std::vector<double>& r,
                  const std::vector<double>& excitation, double Omega, std::vector<double>& f);

  std::vector<std::unique_ptr<PositionController>> controllers_;
  std::vector<double> f_max_;
  double keep_;  // of the difference, per period
  std::size_t now_ = 0, next_ = 0;
  std::deque<Moment> past_;
  std::vector<double> difference_;  // [N]
};

}  // namespace ambrig
