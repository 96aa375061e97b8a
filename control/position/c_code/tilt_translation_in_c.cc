/// Tilt and translation as C: control/position/tilt_translation.h.
#include "control/position/c_code/c_code.h"
#include "control/position/tilt_translation.h"
#include "core/math/linear_equations.h"

namespace ambrig {

namespace {

// State of a PID: derivative, last, integral; [plane x, y][translation, tilt].
constexpr const char* kTiltTranslationInC = R"(
static double $_state[2][2][3], $_held[2 * $_BEARINGS];
static int $_started[2][2];

static void $_coordinates(const double *y, int side, double *c) {
  int k;
  c[0] = c[1] = 0;
  for (k = 0; k < $_BEARINGS; ++k) {
    c[0] += $_sensing[2 * k] * y[2 * k + side];
    c[1] += $_sensing[2 * k + 1] * y[2 * k + side];
  }
}

static double $_actuated(int bearing, const double *wanted) {
  return $_actuation[bearing] * wanted[0] + $_actuation[$_BEARINGS + bearing] * wanted[1];
}

static void $_hold(const double *force, const double *y, const double *r) {
  int side, k, q;
  for (side = 0; side < 2; ++side) {
    double plane[$_BEARINGS], wanted[2], c[2], target[2];
    for (k = 0; k < $_BEARINGS; ++k) plane[k] = force[2 * k + side];
    product(2, $_BEARINGS, $_total, plane, wanted);
    $_coordinates(y, side, c);
    $_coordinates(r, side, target);
    for (k = 0; k < $_BEARINGS; ++k) $_held[2 * k + side] = plane[k] - $_actuated(k, wanted);
    for (q = 0; q < 2; ++q) {
      $_state[side][q][0] = 0;
      $_state[side][q][1] = c[q];
      $_state[side][q][2] = wanted[q] - $_kp[q] * (target[q] - c[q]);
      $_started[side][q] = 1;
    }
  }
}

static double $_pid(int side, int q, double y, double r) {
  double *s = $_state[side][q];
  const double e = r - y;
  double raw;
  if (!$_started[side][q]) s[1] = y;
  $_started[side][q] = 1;
  s[0] = $_filter[q] * s[0] + (1 - $_filter[q]) * (y - s[1]) / $_TS;
  s[1] = y;
  raw = $_kp[q] * e - $_kd[q] * s[0] + s[2] + 0;
  s[2] += $_ki[q] * $_TS * e;
  return raw;
}

static void $_step(const double *y, const double *r, const double *excitation, double omega, double *f) {
  double before[2][2], wanted[2][2]; /* [side][translation, tilt] */
  int side, k, q;
  for (side = 0; side < 2; ++side) {
    double c[2], target[2];
    $_coordinates(y, side, c);
    $_coordinates(r, side, target);
    for (q = 0; q < 2; ++q) {
      before[side][q] = $_state[side][q][2];
      wanted[side][q] = $_pid(side, q, c[q], target[q]);
    }
  }
  wanted[0][1] += $_GYRO * omega * $_state[1][1][0];
  wanted[1][1] -= $_GYRO * omega * $_state[0][1][0];
  for (side = 0; side < 2; ++side) {
    int limited = 0;
    for (k = 0; k < $_BEARINGS; ++k) {
      const int axis = 2 * k + side;
      const double raw = $_actuated(k, wanted[side]) + $_held[axis] + excitation[axis];
      f[axis] = clamped(raw, $_f_max[axis]);
      limited = limited || f[axis] != raw;
    }
    if (limited)
      for (q = 0; q < 2; ++q) $_state[side][q][2] = before[side][q];
  }
}

static void $_track(const double *y, const double *r, double omega, const double *f) {
  static const double none[2 * $_BEARINGS];
  double unused[2 * $_BEARINGS];
  (void)f;
  $_step(y, r, none, omega, unused);
}
)";

}  // namespace

void TiltTranslation::WriteC(CCode& c) const {
  const std::string part = c.NewPart();
  c.Define(part, "BEARINGS", static_cast<long>(sensing_.cols()));
  c.Define(part, "TS", Ts_);
  c.Define(part, "GYRO", gyro_);
  c.Constant(part, "sensing", Eigen::MatrixXd(sensing_));
  c.Constant(part, "actuation", Eigen::MatrixXd(actuation_));
  c.Constant(part, "total", PseudoinverseOf(actuation_));
  c.Constant(part, "f_max", f_max_);
  c.Constant(part, "filter", std::vector<double>(filter_.begin(), filter_.end()));
  c.Constant(part, "kp", std::vector<double>{pid_[0].kp, pid_[1].kp});
  c.Constant(part, "kd", std::vector<double>{pid_[0].kd, pid_[1].kd});
  c.Constant(part, "ki", std::vector<double>{pid_[0].ki, pid_[1].ki});
  c.Add(part, kTiltTranslationInC);
}

}  // namespace ambrig
