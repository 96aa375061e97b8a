/// Run-out: the sensed surface is not round or not concentric, and turns with the rotor.
/// A probe at angle a reads in addition
///   sum over n = 1, 2 of  c_n cos n(a - theta) + s_n sin n(a - theta),
/// a = 0 for x, 90 degrees for y; the same at any speed (facts.md 5.3, effects.md "Phases").
#include <array>
#include <cmath>

#include "effects/effects_motion.h"
#include "effects/plane_targets.h"

namespace ambrig {

namespace {

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
      "motion,\n"
      "once and twice per turn, the same size at any speed; the bearing answers with a force.";
  d.target = TargetKind::kPlane;
  d.parameters = {{"c1", "m", 0, -1e-3, 1e-3, 1e-6, 2e-5, "once per turn, cosine"},
                  {"s1", "m", 0, -1e-3, 1e-3, 1e-6, 2e-5, "once per turn, sine"},
                  {"c2", "m", 0, -1e-3, 1e-3, 5e-7, 1e-5, "twice per turn, cosine"},
                  {"s2", "m", 0, -1e-3, 1e-3, 5e-7, 1e-5, "twice per turn, sine"}};
  d.off_when_null = {"c1", "s1", "c2", "s2"};
  d.shows_in =
      "turning records at two speeds: the reading stays at slow roll, where unbalance vanishes";
  d.confused_with =
      "unbalance (grows with the square of the speed), shaft-bow (moves the gaps too)";
  d.apply = [](const EffectInstance& e, Plant& plant) {
    PositionSensor& sensor = TargetPlane(e, plant).sensor;
    const std::array<double, 4> p = {e.Value("c1"), e.Value("s1"), e.Value("c2"), e.Value("s2")};
    const double ax = ProbeAngle(sensor.map, false), ay = ProbeAngle(sensor.map, true);
    const bool one_axis = plant.Find(e.target)->opposed;
    AddMap(sensor, ReadingStage::kSurface, [=](const MotionState& state, double* x, double* y) {
      const auto surface = [&](double angle) {
        const double a = angle - state.theta;
        return p[0] * std::cos(a) + p[1] * std::sin(a) + p[2] * std::cos(2 * a) +
               p[3] * std::sin(2 * a);
      };
      *x += surface(ax);
      if (!one_axis) *y += surface(ay);
    });
  };
  return d;
}

}  // namespace ambrig
