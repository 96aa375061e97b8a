// Steps of the rotor against closed forms: a spin that is braked, a race that rings on its mount.
#include <gtest/gtest.h>

#include <cmath>

#include "rotor/motion/rotor_model.h"

namespace ambrig {
namespace {

/// Torque -c Omega.
class Brake : public ForceTerm {
 public:
  explicit Brake(double c) : c_(c) {}
  void Add(const MotionState& state, RotorForces& forces) const override {
    forces.torque -= c_ * state.Omega;
  }

 private:
  double c_;
};

// Ip Omega' = -c Omega: Omega = Omega0 exp(-t/tau), theta = Omega0 tau (1 - exp(-t/tau)). A step of
// h errs by (h/tau)⁵/120 of Omega, with h/tau = 0.1 by 8e-8.
TEST(RotorMotion, AFreeSpinIsBrakedExponentially) {
  const double Ip = 0.0042, tau = 0.01, Omega0 = 500, h = 1e-3;
  RotorModel m({4.2, 0.036, Ip, 0.03}, {0, 0, 0});
  m.SetSpeed(SpeedProfile({{0, Omega0}}), 0);
  m.terms.push_back(std::make_unique<Brake>(Ip / tau));
  MotionState s;
  m.SetSpin(s);
  s.Omega = Omega0;
  for (int n = 1; n <= 20; ++n) {
    m.Step(s, {}, 0, 0, h);
    const double exact = Omega0 * std::exp(-n * h / tau);
    EXPECT_NEAR(s.Omega / exact, 1, 2 * n * 8.4e-8) << n;
    EXPECT_NEAR(s.theta, tau * (Omega0 - exact), 1e-6 * Omega0 * tau) << n;
  }
}

// A race on its mount, left alone off its seat: x = x0 e^(-d t) (cos w t + d/w sin w t). The step
// is 4 of the mount's own rate, which one Runge-Kutta step would blow up (its limit is 2.83).
TEST(RotorMotion, ARaceRingsOnItsMountWithoutContact) {
  const double k = 1e9, M = 0.1, c = 1e3, dt = 4e-5;
  AuxiliaryParameters p = {2e-4, 2e7, 1.0, 0.5, 0.15};
  p.mount_stiffness = k;
  p.mount_damping = c;
  p.mount_mass = M;
  RotorModel m({4.2, 0.036, 0.0042, 0.03}, {0, 0, 0});
  m.AddAuxiliary("A", -0.1, p);
  const auto d = static_cast<std::size_t>(m.auxiliaries()[0].mount_dof);
  EXPECT_NEAR(m.MountRate(), std::sqrt(k / M), 1e-6);
  MotionState s;
  const double x0 = 1e-6, decay = c / (2 * M), w = std::sqrt(k / M - decay * decay);
  s.q[d] = x0;
  for (int n = 1; n <= 5; ++n) {
    m.Step(s, {}, 0, 0, dt);
    const double t = n * dt, exact = x0 * std::exp(-decay * t) *
                                     (std::cos(w * t) + decay / w * std::sin(w * t));
    // A piece is one unit of phase or less: (1)^5/120 of the amplitude each.
    EXPECT_NEAR(s.q[d], exact, 4 * n * x0 / 120) << n;
  }
  EXPECT_LT(std::abs(s.q[d]), x0);
}

/// A surface 10 um beside the axis in x, 20 um in y.
class SurfaceBeside : public SurfaceTerm {
 public:
  void Add(const MotionState&, double, double* dx, double* dy) const override {
    *dx += 1e-5;
    *dy -= 2e-5;
  }
};

// A radial plane sees the surface in both its directions, one along the axis does not.
TEST(RotorMotion, APlaneSeesTheSurfaceBesideTheAxis) {
  RotorModel m({4.2, 0.036, 0.0042, 0.03}, {0, 0, 0});
  m.surface.push_back(std::make_unique<SurfaceBeside>());
  MotionState s;
  s.q = {3e-6, 4e-6, 7e-6, 1e-4, -2e-4};
  const double z = 0.1;
  const PlanePoint radial = m.Position(s, m.MakePlane(z));
  EXPECT_NEAR(radial.x, 3e-6 - z * 2e-4 + 1e-5, 1e-18);
  EXPECT_NEAR(radial.y, 4e-6 - z * 1e-4 - 2e-5, 1e-18);
  PlaneMap axial;
  axial.Add(2, 1, 0);
  EXPECT_NEAR(m.Position(s, axial).x, 7e-6, 1e-18);
  EXPECT_EQ(m.Position(s, axial).y, 0);
}

}  // namespace
}  // namespace ambrig
