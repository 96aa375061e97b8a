/// One bending mode of the free rotor, mass normalised, in both planes:
///   eta'' + 2 zeta w eta' + w² eta = gain(z) f,     displacement += gain(z) eta
/// gain_a, gain_b: gains at the first and second radial bearing plane. A free mode is orthogonal to
/// the rigid ones, so between and beyond the planes its shape is not free: it is taken as that of the
/// uniform beam with the rotor's mass and transverse inertia, length L = √(12 It/m),
///   gain(z) = p phi_1(z/L) + q phi_2(z/L),   p, q from gain_a, gain_b,
/// phi_1 (even), phi_2 (odd) its first two free modes (b L = 4.7300, 7.8532), straight beyond the ends.
/// Where the planes sit on nodes, or are fewer than two, the gain runs straight through what is known.
/// `gyro` couples the planes: ± gyro Omega eta' (a thin shaft: 0).
#include <array>
#include <cmath>

#include "core/math/constants.h"
#include "effects/effects_motion.h"
#include "effects/plane_targets.h"

namespace ambrig {

namespace {

/// First even and odd free mode of a uniform beam at u = z/L, centre at 0, scaled to 1 at u = 1/2:
///   even: (cos b u/cos b/2 + cosh b u/cosh b/2)/2 with tan b/2 = -tanh b/2,
///   odd: the same with sin, sinh and tan b/2 = tanh b/2.
double FreeMode(bool odd, double u) {
  const double b = odd ? 7.853204624095838 : 4.730040744862704;
  if (std::abs(u) > 0.5) {  // a free end has no curvature: straight on
    const double slope = odd ? b / 2 * (1 / std::tan(b / 2) + 1 / std::tanh(b / 2))
                             : b / 2 * (-std::tan(b / 2) + std::tanh(b / 2));
    const double beyond = 1 + slope * (std::abs(u) - 0.5);
    return odd && u < 0 ? -beyond : beyond;
  }
  return odd ? 0.5 * (std::sin(b * u) / std::sin(b / 2) + std::sinh(b * u) / std::sinh(b / 2))
             : 0.5 * (std::cos(b * u) / std::cos(b / 2) + std::cosh(b * u) / std::cosh(b / 2));
}

using Shape = std::vector<std::pair<double, double>>;

Shape ShapeThrough(const std::vector<std::pair<std::string, double>>& planes, double gain_a, double gain_b,
                   double length) {
  if (planes.empty()) return {};
  const double za = planes[0].second;
  if (planes.size() < 2) return {{za, gain_a}};
  const double zb = planes[1].second;
  const double a1 = FreeMode(false, za / length), a2 = FreeMode(true, za / length);
  const double b1 = FreeMode(false, zb / length), b2 = FreeMode(true, zb / length);
  const double det = a1 * b2 - a2 * b1;
  if (zb == za) return {{za, gain_a}};
  if (std::abs(det) < 0.05)
    return za < zb ? Shape{{za, gain_a}, {zb, gain_b}} : Shape{{zb, gain_b}, {za, gain_a}};
  const double p = (gain_a * b2 - gain_b * a2) / det, q = (a1 * gain_b - b1 * gain_a) / det;
  const auto gain = [&](double z) { return p * FreeMode(false, z / length) + q * FreeMode(true, z / length); };
  Shape shape;
  constexpr int kPieces = 200;  // linear interpolation to 1e-4 of the end's gain
  for (int k = 0; k <= kPieces; ++k) {
    const double z = length * (static_cast<double>(k) / kPieces - 0.5);
    shape.emplace_back(z, gain(z));
  }
  shape.emplace(shape.begin(), -length, gain(-length));
  shape.emplace_back(length, gain(length));
  return shape;
}

}  // namespace

EffectDescription BendingModeEffect() {
  EffectDescription d;
  d.id = "bending-mode";
  d.title = "Bending mode of the shaft";
  d.physics =
      "The shaft is not rigid: one free bending mode answers to forces at its frequency, with gains\n"
      "that differ in size and sign between bearings and sensors.";
  d.target = TargetKind::kRig;
  d.parameters = {{"frequency", "Hz", 300, 5, 5e3, 100, 1500, "of the free shaft at rest"},
                  {"damping", "-", 0.005, 0, 0.5, 0.001, 0.02, "ratio"},
                  {"gain_a", "kg^-1/2", 0, -20, 20, 0.05, 1, "mode shape at the first radial bearing"},
                  {"gain_b", "kg^-1/2", 0, -20, 20, 0.05, 1, "mode shape at the second radial bearing"},
                  {"gyro", "-", 0, -2, 2, 0.02, 0.3, "gyroscopic coupling of its two planes"}};
  d.off_when_null = {"gain_a", "gain_b"};
  d.shows_in = "wide-band force excitation near its frequency, impulses; both ends together";
  d.confused_with = "base-mode (does not split with speed, rigid zero), sensor-lowpass well above its frequency";
  d.shape = [](const EffectInstance& e, Plant& plant) {
    if (plant.rotor.modes().size() >= 2) throw InputError(e.where + ": at most two bending modes in a rig");
    const RotorParameters& rotor = plant.rotor.parameters();
    BendingMode mode;
    mode.omega = 2 * kPi * e.Value("frequency");
    mode.damping = e.Value("damping");
    mode.gyroscopic = e.Value("gyro");
    mode.shape = ShapeThrough(plant.planes, e.Value("gain_a"), e.Value("gain_b"),
                              std::sqrt(12 * rotor.inertia_transverse / rotor.mass));
    plant.rotor.AddBendingMode(mode);
  };
  return d;
}

}  // namespace ambrig
