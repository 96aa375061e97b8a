#pragma once
/// Unbalance control by a generalised notch round any controller: the part of each reading that
/// turns with the shaft is taken out before the controller sees it, so that the magnets carry no
/// synchronous current and the shaft turns about its axis of inertia (automatic balancing). Per
/// axis a complex amplitude p follows the shaft:
///
///   e = y - Re p,     p+ = exp(i Omega Ts) (p + 2 b Ts exp(i phase) e)
///
/// b is the rate at which the amplitude is learned where the loop's sensitivity is S(i Omega) = 1;
/// the loop stays stable for small b when Re(exp(i phase) S) > 0, which phase = 0 fulfils above the
/// bearing's own frequencies. Below `from_speed`, and without rotation, the amplitude decays at the
/// same rate and is not learned. Source: Herzog, Buehler, Gaehler, Larsonneur, IEEE Trans. Control
/// Systems Technology 4 (1996) 580.
#include <complex>

#include "control/position/position_controller.h"
#include "core/base/parameters.h"

namespace ambrig {

struct UnbalanceControlParameters {
  double from_speed = kRequired;
  double bandwidth = 10;
  double phase_deg = 0;
};

inline constexpr Field<UnbalanceControlParameters> kUnbalanceControlFields[] = {
    {"from_speed", &UnbalanceControlParameters::from_speed, "rad/s", 1, 1e5,
     "slowest speed at which it acts"},
    {"bandwidth", &UnbalanceControlParameters::bandwidth, "1/s", 1e-3, 1e3,
     "rate at which the amplitude is learned"},
    {"phase_deg", &UnbalanceControlParameters::phase_deg, "deg", -180, 180,
     "phase of the update, for speeds near the natural frequencies of the bearing"},
};

class UnbalanceControl : public PositionController {
 public:
  UnbalanceControl(std::unique_ptr<PositionController> inner, std::size_t axes,
                   const UnbalanceControlParameters& p, double Ts);
  void Observe(const std::vector<BearingControl>& control, double t) override {
    inner_->Observe(control, t);
  }
  const Lane* SetPoints(std::size_t bearing) const override { return inner_->SetPoints(bearing); }
  void Step(const std::vector<double>& y, const std::vector<double>& r,
            const std::vector<double>& excitation, double Omega, std::vector<double>& f) override;
  void Hold(const std::vector<double>& force, const std::vector<double>& y,
            const std::vector<double>& r) override;
  void Track(const std::vector<double>& y, const std::vector<double>& r, double Omega,
             const std::vector<double>& f) override;
  StateSpace Linear(double Omega) const override;
  void WriteC(CCode& code) const override;
  std::unique_ptr<PositionController> Clone() const override;

 private:
  void Remove(const std::vector<double>& y, double Omega);

  std::unique_ptr<PositionController> inner_;
  UnbalanceControlParameters p_;
  double Ts_;
  std::complex<double> gain_;                  // 2 b Ts exp(i phase)
  std::vector<std::complex<double>> turning_;  // per axis [m]
  std::vector<double> rest_;                   // readings without them [m]
};

}  // namespace ambrig
