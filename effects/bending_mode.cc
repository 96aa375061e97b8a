/// One bending mode of the free rotor, mass normalised, in both planes:
///   eta'' + 2 zeta w eta' + w² eta = gain(z) f,     displacement += gain(z) eta
/// gain_a, gain_b: gains at the first and second radial bearing plane. A free mode is orthogonal to
/// the rigid ones, so between and beyond the planes its shape is not free: it is taken as a blend
/// of the free modes phi_k of the uniform beam with the rotor's mass and inertia, length L = √(12
/// It/m),
///   gain(z) = Σ_k c_k phi_k(z/L),   the c that meets both gains with least Σ (c_k b_k⁴)²,
/// b_k = 4.7300, 7.8532, 10.9956, 14.1372: the lowest mode alone where it fits, and no wild shape
/// where a bearing sits on a node. Straight beyond the ends. A shaft that is no uniform rod bends
/// as one of `length` times L: sensors beside the magnets tell. `gyro` couples the planes: ± gyro
/// Omega eta' (a thin shaft: 0).
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/math/constants.h"
#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

namespace {

constexpr int kModes = 4;
constexpr double kRoots[kModes] = {4.730040744862704, 7.853204624095838, 10.995607838001671,
                                   14.137165491257464};

/// Free mode k of a uniform beam at u = z/L, centre at 0, scaled to 1 at u = 1/2:
///   even: (cos b u/cos b/2 + cosh b u/cosh b/2)/2 with tan b/2 = -tanh b/2,
///   odd: the same with sin, sinh and tan b/2 = tanh b/2.
double FreeMode(int k, double u) {
  const double b = kRoots[k];
  const bool odd = k % 2 == 1;
  if (std::abs(u) > 0.5) {  // a free end has no curvature: straight on
    const double slope = odd ? b / std::tanh(b / 2) : b * std::tanh(b / 2);
    const double beyond = 1 + slope * (std::abs(u) - 0.5);
    return odd && u < 0 ? -beyond : beyond;
  }
  return odd ? 0.5 * (std::sin(b * u) / std::sin(b / 2) + std::sinh(b * u) / std::sinh(b / 2))
             : 0.5 * (std::cos(b * u) / std::cos(b / 2) + std::cosh(b * u) / std::cosh(b / 2));
}

/// Coefficients of the free modes through the gains at a and b (in units of L).
std::array<double, kModes> Blend(double a, double b, double gain_a, double gain_b) {
  double aa = 0, ab = 0, bb = 0, at_a[kModes], at_b[kModes], mobility[kModes];
  for (int k = 0; k < kModes; ++k) {
    at_a[k] = FreeMode(k, a);
    at_b[k] = FreeMode(k, b);
    mobility[k] = std::pow(kRoots[0] / kRoots[k], 8);
    aa += mobility[k] * at_a[k] * at_a[k];
    ab += mobility[k] * at_a[k] * at_b[k];
    bb += mobility[k] * at_b[k] * at_b[k];
  }
  const double det = aa * bb - ab * ab;
  const bool one = det < 1e-9 * aa * bb;  // both bearings in one plane: the first counts
  const double la = one ? gain_a / aa : (bb * gain_a - ab * gain_b) / det;
  const double lb = one ? 0 : (aa * gain_b - ab * gain_a) / det;
  std::array<double, kModes> c;
  for (int k = 0; k < kModes; ++k)
    c[static_cast<std::size_t>(k)] = mobility[k] * (at_a[k] * la + at_b[k] * lb);
  return c;
}

using Shape = std::vector<ShapePoint>;

Shape ShapeThrough(const std::vector<std::pair<std::string, double>>& planes, double gain_a,
                   double gain_b, double length) {
  if (planes.empty()) return {};
  const double za = planes.front().second, zb = planes.size() > 1 ? planes[1].second : za;
  const std::array<double, kModes> c = Blend(za / length, zb / length, gain_a, gain_b);
  Shape shape;
  const auto add = [&](double z) {
    double gain = 0;
    for (int k = 0; k < kModes; ++k)
      gain += c[static_cast<std::size_t>(k)] * FreeMode(k, z / length);
    shape.push_back({z, gain});
  };
  constexpr int kPieces = 400;  // straight pieces: off by at most (b/400)²/8 = 2e-4 of a mode's end
  add(-length);
  for (int k = 0; k <= kPieces; ++k) add(length * (static_cast<double>(k) / kPieces - 0.5));
  add(length);
  return shape;
}

}  // namespace

EffectDescription BendingModeEffect() {
  EffectDescription d;
  d.id = "bending-mode";
  d.title = "Bending mode of the shaft";
  d.physics =
      "The shaft is not rigid: one free bending mode answers to forces at its frequency, with "
      "gains\n"
      "that differ in size and sign between bearings and sensors.";
  d.target = TargetKind::kRig;
  d.needs.levitation = true;
  d.switches_pair = true;
  d.parameters = {
      {"frequency", "Hz", 300, 5, 5e3, 100, 1500, "of the free shaft at rest"},
      {"damping", "-", 0.005, 0, 0.5, 0.001, 0.02, "ratio"},
      {"gain_a", "kg^-1/2", 0, -20, 20, 0.05, 1, "mode shape at the first radial bearing"},
      {"gain_b", "kg^-1/2", 0, -20, 20, 0.05, 1, "mode shape at the second radial bearing"},
      {"gyro", "-", 0, -2, 2, 0.02, 0.3, "gyroscopic coupling of its two planes"},
      {"length", "-", 1, 0.5, 2, 0.9, 1.1, "of the bending shaft, over a uniform rod's"}};
  d.off_when_null = {"gain_a", "gain_b"};
  d.shows_in = "wide-band force excitation near its frequency, impulses; both ends together";
  d.confused_with =
      "base-mode (does not split with speed, rigid zero), sensor-lowpass well above its frequency";
  d.shape = [](const EffectInstance& e, Plant& plant) {
    if (plant.rotor.modes().size() >= kMaxModes)
      throw InputError(fmt::format("{}: more than {} bending modes in a rig", e.where, kMaxModes));
    const RotorParameters& rotor = plant.rotor.parameters();
    BendingMode mode;
    mode.omega = 2 * kPi * e.Value("frequency");
    mode.damping = e.Value("damping");
    mode.gyroscopic = e.Value("gyro");
    mode.shape =
        ShapeThrough(plant.planes, e.Value("gain_a"), e.Value("gain_b"),
                     e.Value("length") * std::sqrt(12 * rotor.inertia_transverse / rotor.mass));
    plant.rotor.AddBendingMode(mode);
  };
  return d;
}

}  // namespace ambrig
