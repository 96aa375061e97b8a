/// LQG control as C: control/synthesis/lqg.h.
#include "control/position/c_code/c_code.h"
#include "control/synthesis/lqg.h"

namespace ambrig {

namespace {

constexpr const char* kLqgInC = R"(
static double $_x[$_STATES], $_xi[$_AXES], $_corrected[$_STATES], $_speed = -1;
static double $_An[$_STATES * $_STATES], $_Bn[$_STATES * $_AXES], $_Cn[$_AXES * $_STATES], $_Ln[$_STATES * $_AXES],
    $_Kxn[$_AXES * $_STATES], $_Kin[$_AXES * $_AXES], $_Nxn[$_STATES * $_AXES], $_Nfn[$_AXES * $_AXES];
static const double *$_Am = $_A, *$_B1 = $_B, *$_C1 = $_C, *$_L1 = $_L, *$_Kx1 = $_Kx, *$_Ki1 = $_Ki,
                    *$_Nx1 = $_Nx, *$_Nf1 = $_Nf; /* in use */

static void $_schedule(double omega) {
  double weight;
  const int low = locate($_POINTS, $_speeds, omega, &weight);
  if ($_POINTS == 1 || omega == $_speed) return;
  mix($_STATES * $_STATES, $_A, low, weight, $_An);
  mix($_STATES * $_AXES, $_B, low, weight, $_Bn);
  mix($_AXES * $_STATES, $_C, low, weight, $_Cn);
  mix($_STATES * $_AXES, $_L, low, weight, $_Ln);
  mix($_AXES * $_STATES, $_Kx, low, weight, $_Kxn);
  mix($_AXES * $_AXES, $_Ki, low, weight, $_Kin);
  mix($_STATES * $_AXES, $_Nx, low, weight, $_Nxn);
  mix($_AXES * $_AXES, $_Nf, low, weight, $_Nfn);
  $_Am = $_An;
  $_B1 = $_Bn;
  $_C1 = $_Cn;
  $_L1 = $_Ln;
  $_Kx1 = $_Kxn;
  $_Ki1 = $_Kin;
  $_Nx1 = $_Nxn;
  $_Nf1 = $_Nfn;
  $_speed = omega;
}

static void $_hold(const double *force, const double *y, const double *r) {
  double in[3 * $_AXES];
  int k;
  for (k = 0; k < $_AXES; ++k) {
    in[k] = force[k];
    in[$_AXES + k] = y[k];
    in[2 * $_AXES + k] = r[k];
  }
  product($_STATES, 3 * $_AXES, $_HOLD_X, in, $_x);
  product($_AXES, 3 * $_AXES, $_HOLD_XI, in, $_xi);
}

/* xf = x + L (y - C x) */
static void $_correct(const double *y) {
  double innovation[$_AXES];
  int k;
  for (k = 0; k < $_AXES; ++k) innovation[k] = y[k];
  add_product(-1, $_AXES, $_STATES, $_C1, $_x, innovation);
  for (k = 0; k < $_STATES; ++k) $_corrected[k] = $_x[k];
  add_product(1, $_STATES, $_AXES, $_L1, innovation, $_corrected);
}

/* x+ = A xf + B f */
static void $_predict(const double *f) {
  product($_STATES, $_STATES, $_Am, $_corrected, $_x);
  add_product(1, $_STATES, $_AXES, $_B1, f, $_x);
}

/* Nf r - Kx (xf - Nx r): the force without its integral part. */
static void $_proportional(const double *r, double *f) {
  double work[$_STATES];
  int k;
  for (k = 0; k < $_STATES; ++k) work[k] = $_corrected[k];
  add_product(-1, $_STATES, $_AXES, $_Nx1, r, work);
  product($_AXES, $_AXES, $_Nf1, r, f);
  add_product(-1, $_AXES, $_STATES, $_Kx1, work, f);
}

static void $_step(const double *y, const double *r, const double *excitation, double omega, double *f) {
  double own[$_AXES];
  int k;
  $_schedule(omega);
  $_correct(y);
  $_proportional(r, own);
  add_product(-1, $_AXES, $_AXES, $_Ki1, $_xi, own);
  for (k = 0; k < $_AXES; ++k) {
    const double raw = own[k] + excitation[k], e = r[k] - y[k], limit = $_f_max[k];
    if (!((raw > limit && e > 0) || (raw < -limit && e < 0))) $_xi[k] -= $_TS * e;
    f[k] = clamped(raw, limit);
    own[k] = f[k] - excitation[k];
  }
  $_predict(own);
}

static void $_track(const double *y, const double *r, double omega, const double *f) {
  double Ki[$_AXES * $_AXES];
  int k;
  $_schedule(omega);
  $_correct(y);
  $_proportional(r, $_xi);
  for (k = 0; k < $_AXES; ++k) $_xi[k] -= f[k];
  for (k = 0; k < $_AXES * $_AXES; ++k) Ki[k] = $_Ki1[k];
  solve($_AXES, Ki, $_xi);
  $_predict(f);
}
)";

}  // namespace

void LqgController::WriteC(CCode& c) const {
  const std::string part = c.NewPart();
  const Eigen::Index axes = xi_.size(), n = x_.size();
  // Hold is linear in forces, readings and references: its columns are what it does
  // to unit vectors.
  Eigen::MatrixXd hold_x(n, 3 * axes), hold_xi(axes, 3 * axes);
  for (Eigen::Index k = 0; k < 3 * axes; ++k) {
    LqgController copy(speeds_, designs_, f_max_, Ts_);
    std::vector<double> in[3];
    for (auto& v : in) v.assign(f_max_.size(), 0.0);
    in[k / axes][static_cast<std::size_t>(k % axes)] = 1;
    copy.Hold(in[0], in[1], in[2]);
    hold_x.col(k) = copy.x_;
    hold_xi.col(k) = copy.xi_;
  }
  c.Define(part, "AXES", static_cast<long>(axes));
  c.Define(part, "STATES", static_cast<long>(n));
  c.Define(part, "POINTS", static_cast<long>(designs_.size()));
  c.Define(part, "TS", Ts_);
  c.Constant(part, "speeds", speeds_);
  c.Constant(part, "f_max", f_max_);
  const auto gains = [&](const char* name, Eigen::MatrixXd LqgDesign::*at) {
    std::vector<Eigen::MatrixXd> all;
    for (const LqgDesign& d : designs_) all.push_back(d.*at);
    c.Constants(part, name, all);
  };
  gains("A", &LqgDesign::A);
  gains("B", &LqgDesign::B);
  gains("C", &LqgDesign::C);
  gains("L", &LqgDesign::L);
  gains("Kx", &LqgDesign::Kx);
  gains("Ki", &LqgDesign::Ki);
  gains("Nx", &LqgDesign::Nx);
  gains("Nf", &LqgDesign::Nf);
  c.Constant(part, "HOLD_X", hold_x);
  c.Constant(part, "HOLD_XI", hold_xi);
  c.Add(part, kLqgInC);
}

}  // namespace ambrig
