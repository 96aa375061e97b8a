/// Run-out: the sensed surface is not round or not concentric, and turns with the rotor.
/// A probe at angle a reads in addition
///   sum over n = 1 ... 7 of  c_n cos n(a - theta) + s_n sin n(a - theta),
/// a = 0 for x, 90 degrees for y; the same at any speed (published_values.md 7, docs/effects.md). A
/// ground surface has lobes: orders above the second are small, but far over the noise of a good
/// sensor.
#include <array>
#include <cmath>
#include <complex>

#include <fmt/format.h>

#include "effects/effect.h"
#include "effects/plane_targets.h"

namespace ambrig {

namespace {

constexpr int kOrders = 7;

/// Angle of a probe from the weights with which it sees the shaft's x and y.
double ProbeAngle(const PlaneMap& map, bool second) {
  double wx = 0, wy = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(map.count); ++k) {
    const double w = second ? map.wy[k] : map.wx[k];
    if (map.dof[k] == 0) wx += w;
    if (map.dof[k] == 1) wy += w;
  }
  return std::atan2(wy, wx);
}

}  // namespace

EffectDescription SensorRunout() {
  EffectDescription d;
  d.id = "sensor-runout";
  d.title = "Run-out of the sensed surface";
  d.physics =
      "The surface in front of the probes is out of round or off centre: its error is read as "
      "motion,\nonce per turn and in harmonics, the same size at any speed; the controller "
      "responds with a force.";
  d.target = TargetKind::kPlane;
  d.needs.rotation = true;
  for (int n = 1; n <= kOrders; ++n) {
    const double usual = n == 1 ? 1e-6 : n == 2 ? 5e-7 : 5e-8;
    for (const char* part : {"c", "s"}) {
      const std::string name = fmt::format("{}{}", part, n);
      d.parameters.push_back({name, "m", 0, -1e-3, 1e-3, usual, 20 * usual,
                              fmt::format("order {}, {}", n, part[0] == 'c' ? "cosine" : "sine")});
      d.off_when_null.push_back(name);
    }
  }
  d.adds_signal = true;
  d.shows_in =
      "turning records at two speeds: the reading stays at slow roll, where unbalance vanishes";
  d.confused_with =
      "unbalance (grows with the square of the speed), shaft-bow (moves the gaps too)";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    PositionSensor& sensor = TargetPlane(e, plant).sensor;
    std::array<std::complex<double>, kOrders> profile;  // c_n - i s_n
    for (std::size_t n = 0; n < profile.size(); ++n)
      profile[n] = {e.Value(fmt::format("c{}", n + 1)), -e.Value(fmt::format("s{}", n + 1))};
    const double ax = ProbeAngle(sensor.map, false), ay = ProbeAngle(sensor.map, true);
    const bool one_axis = plant.Find(e.target)->opposed;
    AddMap(sensor, ReadingStage::kSurface, [=](const MotionState& state, double* x, double* y) {
      const auto surface = [&](double angle) {
        const std::complex<double> turn = std::polar(1.0, angle - state.theta);
        std::complex<double> sum = 0;  // Horner's rule in the turn
        for (std::size_t n = profile.size(); n-- > 0;) sum = (sum + profile[n]) * turn;
        return sum.real();
      };
      *x += surface(ax);
      if (!one_axis) *y += surface(ay);
    });
  };
  return d;
}

}  // namespace ambrig
