/// State spaces as C: control/position/state_space_controller.h.
#include "control/position/c_code/c_code.h"
#include "control/position/state_space_controller.h"

namespace ambrig {

namespace {

constexpr const char* kStateSpaceInC = R"(
#define $_NX ($_STATES > 0 ? $_STATES : 1)
static double $_x[$_NX], $_offset[$_AXES], $_speed = -1;
static double $_An[$_NX * $_NX], $_Bn[$_NX * $_AXES], $_Cn[$_AXES * $_NX], $_Dn[$_AXES * $_AXES];
static const double *$_A1 = $_A, *$_B1 = $_B, *$_C1 = $_C, *$_D1 = $_D; /* in use */

static void $_hold(const double *force, const double *y, const double *r) {
  double in[2 * $_AXES];
  int k;
  for (k = 0; k < $_AXES; ++k) {
    in[k] = force[k];
    in[$_AXES + k] = r[k] - y[k];
  }
  product($_STATES, 2 * $_AXES, $_HOLD_X, in, $_x);
  product($_AXES, 2 * $_AXES, $_HOLD_OFFSET, in, $_offset);
}

static void $_schedule(double omega) {
  double weight;
  const int low = locate($_POINTS, $_speeds, omega, &weight);
  mix($_STATES * $_STATES, $_A, low, weight, $_An);
  mix($_STATES * $_AXES, $_B, low, weight, $_Bn);
  mix($_AXES * $_STATES, $_C, low, weight, $_Cn);
  mix($_AXES * $_AXES, $_D, low, weight, $_Dn);
  $_A1 = $_An;
  $_B1 = $_Bn;
  $_C1 = $_Cn;
  $_D1 = $_Dn;
  $_speed = omega;
}

static void $_step(const double *y, const double *r, const double *excitation, double omega, double *f) {
  double e[$_AXES], raw[$_AXES], next[$_NX];
  int k;
  if ($_POINTS > 1 && omega != $_speed) $_schedule(omega);
  for (k = 0; k < $_AXES; ++k) e[k] = r[k] - y[k];
  product($_AXES, $_AXES, $_D1, e, raw);
  add_product(1, $_AXES, $_STATES, $_C1, $_x, raw);
  for (k = 0; k < $_AXES; ++k) raw[k] += $_offset[k];
  product($_STATES, $_STATES, $_A1, $_x, next);
  add_product(1, $_STATES, $_AXES, $_B1, e, next);
  for (k = 0; k < $_STATES; ++k) $_x[k] = next[k];
  for (k = 0; k < $_AXES; ++k) f[k] = clamped(raw[k] + excitation[k], $_f_max[k]);
}

static void $_track(const double *y, const double *r, double omega, const double *f) {
  static const double none[$_AXES];
  double unused[$_AXES];
  (void)f;
  $_step(y, r, none, omega, unused);
}
)";

}  // namespace

void StateSpaceController::WriteC(CCode& c) const {
  const std::string part = c.NewPart();
  const Eigen::Index axes = e_.size(), n = now_.states();
  // Hold is linear in the forces and errors: its columns are what it does to unit vectors.
  Eigen::MatrixXd hold_x(n, 2 * axes), hold_offset(axes, 2 * axes);
  for (Eigen::Index k = 0; k < 2 * axes; ++k) {
    StateSpaceController copy(speeds_, points_, f_max_);
    std::vector<double> force(f_max_.size(), 0.0), r = force;
    (k < axes ? force[static_cast<std::size_t>(k)] : r[static_cast<std::size_t>(k - axes)]) = 1;
    copy.Hold(force, std::vector<double>(f_max_.size(), 0.0), r);
    hold_x.col(k) = copy.x_;
    hold_offset.col(k) = copy.offset_;
  }
  std::vector<Eigen::MatrixXd> A, B, C, D;
  for (const StateSpace& s : points_) {
    A.push_back(s.A);
    B.push_back(s.B);
    C.push_back(s.C);
    D.push_back(s.D);
  }
  c.Define(part, "AXES", static_cast<long>(axes));
  c.Define(part, "STATES", static_cast<long>(n));
  c.Define(part, "POINTS", static_cast<long>(points_.size()));
  c.Constant(part, "speeds", speeds_);
  c.Constant(part, "f_max", f_max_);
  c.Constants(part, "A", A);
  c.Constants(part, "B", B);
  c.Constants(part, "C", C);
  c.Constants(part, "D", D);
  c.Constant(part, "HOLD_X", hold_x);
  c.Constant(part, "HOLD_OFFSET", hold_offset);
  c.Add(part, kStateSpaceInC);
}

}  // namespace ambrig
