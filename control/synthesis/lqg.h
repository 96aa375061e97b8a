#pragma once
/// Linear-quadratic Gaussian control with integral action, sampled, made from the plant's model at
/// load.
///
///   cost       sum over k and axes of (y/y_w)² + (xi/xi_w)² + (f/f_w)² + v²,
///     xi_(k+1) = xi_k + Ts (y - r)
///   observer   xf = x + L (y - C x),  x+ = A xf + B f      (f as clamped, without the excitation)
///   force      f = -Kx (xf - Nx r) + Nf r - Ki xi          (Nx, Nf: the rest at y = r)
///
/// y_w, xi_w, f_w are the sizes that cost 1; v are the weighed outputs of the shaft
/// (control/synthesis/plane_weight.h, mode_weight.h). The noise model has independent forces
/// at the bearings, disturbances of the shaft, and readings. Clamped, the integral stops on the
/// side that e = r - y pushes to, as the PID's. Source: Franklin, Powell, Workman 1998, chapter 9.
#include "control/linear/sampled_plant.h"
#include "control/position/position_controller.h"
#include "core/base/parameters.h"

namespace ambrig {

struct LqgParameters {
  double position_weight = 1e-5;
  double integral_weight = 2e-7;
  double force_weight = 10;
  double force_noise = 1;
  double sensor_noise = 2e-7;
};

inline constexpr Field<LqgParameters> kLqgFields[] = {
    {"position_weight", &LqgParameters::position_weight, "m", 1e-9, 1, "deviation that costs 1"},
    {"integral_weight", &LqgParameters::integral_weight, "m s", 1e-12, 1,
     "integral of the deviation with unit cost"},
    {"force_weight", &LqgParameters::force_weight, "N", 1e-6, 1e9, "force that costs 1"},
    {"force_noise", &LqgParameters::force_noise, "N", 1e-9, 1e9,
     "rms of forces at the bearings, new every controller period"},
    {"sensor_noise", &LqgParameters::sensor_noise, "m", 1e-12, 1e-2,
     "rms of the readings, as the design counts it"},
};

/// Gains of one speed.
struct LqgDesign {
  Eigen::MatrixXd A, B, C;                           // the plant
  Eigen::MatrixXd L, Kx, Ki, Nx, Nf;                 // (n x p), (p x n), (p x p), (n x p), (p x p)
  double control_residual = 0, filter_residual = 0;  // of the Riccati equations
  double spectral_radius = 0;                        // of the worse of A - B K and A - A L C
};

/// @throws InputError (`where`: file and line) when the plant cannot be stabilised with these
/// weights.
LqgDesign DesignLqg(const SampledPlant& plant, const LqgParameters& p, const std::string& where);

class LqgController : public PositionController {
 public:
  /// One design per speed [rad/s], interpolated by |Omega|.
  LqgController(std::vector<double> speeds, std::vector<LqgDesign> designs,
                std::vector<double> f_max, double Ts);
  void Step(const std::vector<double>& y, const std::vector<double>& r,
            const std::vector<double>& excitation, double Omega, std::vector<double>& f) override;
  void Hold(const std::vector<double>& force, const std::vector<double>& y,
            const std::vector<double>& r) override;
  void Track(const std::vector<double>& y, const std::vector<double>& r, double Omega,
             const std::vector<double>& f) override;
  StateSpace Linear(double Omega) const override;
  void WriteC(CCode& code) const override;
  std::unique_ptr<PositionController> Clone() const override {
    return std::make_unique<LqgController>(*this);
  }

 private:
  LqgDesign At(double Omega) const;
  void Schedule(double Omega);
  /// xf from the prediction and the readings.
  void Correct(const std::vector<double>& y, const std::vector<double>& r);
  void Predict();
  /// The integral with which the force now would be f_.
  void MatchIntegral();

  std::vector<double> speeds_;
  std::vector<LqgDesign> designs_;
  std::vector<double> f_max_;
  double Ts_;
  LqgDesign now_;
  double now_speed_ = -1;
  Eigen::VectorXd x_, corrected_, xi_, y_, r_, f_, work_;
};

}  // namespace ambrig
