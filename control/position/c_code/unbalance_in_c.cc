/// Unbalance control round another controller, as C: control/position/unbalance_control.h.
#include "control/position/c_code/c_code.h"
#include "control/position/unbalance_control.h"

namespace ambrig {

namespace {

constexpr const char* kUnbalanceInC = R"(
static double $_re[$_AXES], $_im[$_AXES], $_rest[$_AXES]; /* the part that turns with the shaft [m] */

static void $_remove(const double *y, double omega) {
  const int learns = fabs(omega) >= $_FROM_SPEED;
  const double turn_re = cos(omega * $_TS), turn_im = sin(omega * $_TS);
  int k;
  for (k = 0; k < $_AXES; ++k) {
    double re, im;
    $_rest[k] = y[k] - $_re[k];
    if (learns) {
      $_re[k] += $_GAIN_RE * $_rest[k];
      $_im[k] += $_GAIN_IM * $_rest[k];
    } else {
      $_re[k] *= 1 - $_BANDWIDTH * $_TS;
      $_im[k] *= 1 - $_BANDWIDTH * $_TS;
    }
    re = $_re[k] * turn_re - $_im[k] * turn_im;
    im = $_re[k] * turn_im + $_im[k] * turn_re;
    $_re[k] = re;
    $_im[k] = im;
  }
}

static void $_hold(const double *force, const double *y, const double *r) {
  int k;
  for (k = 0; k < $_AXES; ++k) $_re[k] = $_im[k] = 0;
  INNER_hold(force, y, r);
}

static void $_step(const double *y, const double *r, const double *excitation, double omega, double *f) {
  $_remove(y, omega);
  INNER_step($_rest, r, excitation, omega, f);
}

static void $_track(const double *y, const double *r, double omega, const double *f) {
  $_remove(y, omega);
  INNER_track($_rest, r, omega, f);
}
)";

}  // namespace

void UnbalanceControl::WriteC(CCode& c) const {
  const std::string part = c.NewPart(), inner = c.NextPart();
  inner_->WriteC(c);
  c.Define(part, "AXES", static_cast<long>(rest_.size()));
  c.Define(part, "TS", Ts_);
  c.Define(part, "FROM_SPEED", p_.from_speed);
  c.Define(part, "BANDWIDTH", p_.bandwidth);
  c.Define(part, "GAIN_RE", gain_.real());
  c.Define(part, "GAIN_IM", gain_.imag());
  std::string text = kUnbalanceInC;
  for (std::size_t at = text.find("INNER"); at != std::string::npos; at = text.find("INNER"))
    text.replace(at, 5, inner);
  c.Add(part, text);
}

}  // namespace ambrig
