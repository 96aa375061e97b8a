#pragma once
/// Shaft positions at the bearing planes between and after the controller's readings, and faults of
/// the position sensors.
///
/// Readings y of one sensor plane come once per controller period; three of them give the parabola
/// that is followed until the next one (whirl: ω² r t²/2 would be missed by a straight line). A
/// rigid shaft connects the sensor planes: radial position at z is the least-squares line through
/// all planes, the identity for a single one.
/// Faulty axis: a step that no force could make (`jump`, against the parabola; more when the shaft
/// may have struck something), or the very same reading again and again after readings that were
/// never equal.
#include <vector>

namespace ambrig {

struct SensedPlane {
  double z = 0;                // [m]
  int x_axis = 0, y_axis = 0;  // index of the readings
};

class PositionMonitor {
 public:
  PositionMonitor() = default;
  /// `jump`: largest credible departure from the parabola within one period [m]; `noise`: of a
  /// reading [m rms].
  PositionMonitor(std::size_t axes, double jump, double noise = 0);

  /// New readings of time t [s]; false: the same t again, ignored. `struck`: what impacts may
  /// add to a departure, per axis [m]; empty: nothing.
  bool Read(double t, const std::vector<double>& readings, const std::vector<double>& struck = {});
  /// Position of axis `a` at time t [m].
  double At(std::size_t a, double t) const {
    const double u = (t - last_) * per_step_;  // in controller periods
    const Axis& axis = axes_[a];
    return axis.y[0] + u * axis.slope + u * u * axis.curvature;
  }
  /// The reading k steps ago, k < 3 [m]; the newest one while there are not three.
  double Recent(std::size_t a, std::size_t k) const { return axes_[a].y[count_ < 3 ? 0 : k]; }
  /// By how much the last readings of axis `a` departed from the parabola, beyond their noise [m].
  double Departure(std::size_t a) const;
  double step() const { return step_; }  // between readings [s]
  bool ready(double t) const { return count_ >= 3 && t - last_ < 6 * step_; }
  bool faulty(std::size_t a) const { return axes_[a].faulty; }
  /// Axes that became faulty since the last call: several at once where a plane's cable breaks.
  std::vector<int> TakeNewFaults();

 private:
  struct Axis {
    double y[3] = {0, 0, 0};          // newest first
    double slope = 0, curvature = 0;  // of their parabola, per step and per step²
    double departure[3] = {0, 0, 0};  // newest first
    int equal = 0, different = 0;
    bool faulty = false;
  };
  std::vector<Axis> axes_;
  double jump_ = 3e-5, noise_ = 0, last_ = -1, step_ = 0, per_step_ = 0;
  long long count_ = 0;
  std::vector<int> new_faults_;
};

}  // namespace ambrig
