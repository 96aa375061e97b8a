/// PIDs as C: control/position/pid.h, filtered_pid.h.
#include "control/position/c_code/c_code.h"
#include "control/position/filtered_pid.h"

namespace ambrig {

namespace {

constexpr const char* kPidInC = R"(
static double $_derivative[$_AXES], $_last[$_AXES], $_integral[$_AXES];
static int $_started[$_AXES];

static void $_hold(const double *force, const double *y, const double *r) {
  int k;
  for (k = 0; k < $_AXES; ++k) {
    $_derivative[k] = 0;
    $_integral[k] = force[k] - $_kp[k] * (r[k] - y[k]);
    $_last[k] = y[k];
    $_started[k] = 1;
  }
}

static void $_step(const double *y, const double *r, const double *excitation, double omega, double *f) {
  int k;
  (void)omega;
  for (k = 0; k < $_AXES; ++k) {
    const double e = r[k] - y[k], limit = $_f_max[k];
    double raw;
    if (!$_started[k]) $_last[k] = y[k];
    $_started[k] = 1;
    $_derivative[k] = $_filter[k] * $_derivative[k] + (1 - $_filter[k]) * (y[k] - $_last[k]) / $_TS;
    $_last[k] = y[k];
    raw = $_kp[k] * e - $_kd[k] * $_derivative[k] + $_integral[k] + excitation[k];
    if (!((raw > limit && e > 0) || (raw < -limit && e < 0))) $_integral[k] += $_ki[k] * $_TS * e;
    f[k] = clamped(raw, limit);
  }
}
)";

/// Readings alone move the state.
constexpr const char* kTrackByStep = R"(
static void $_track(const double *y, const double *r, double omega, const double *f) {
  static const double none[$_AXES];
  double unused[$_AXES];
  (void)f;
  $_step(y, r, none, omega, unused);
}
)";

constexpr const char* kFilteredPidInC = R"(
static double $_derivative[$_AXES], $_last[$_AXES], $_integral[$_AXES], $_last_speed;
static double $_s1[$_FILTERS + 1], $_s2[$_FILTERS + 1];
static int $_started[$_AXES];

/* kp, kd, ki, tau_d, f_max of an axis at this speed. */
static void $_gains(int axis, double omega, double *p) {
  const double *all = $_points + 5 * $_first_point[axis];
  const int points = $_first_point[axis + 1] - $_first_point[axis];
  double weight;
  const int low = locate(points, $_speeds + $_first_point[axis], omega, &weight);
  int k;
  if (points == 1)
    for (k = 0; k < 5; ++k) p[k] = all[k];
  else
    mix(5, all, low, weight, p);
}

static void $_hold(const double *force, const double *y, const double *r) {
  int k, j;
  for (k = 0; k < $_AXES; ++k) {
    double p[5];
    $_gains(k, $_last_speed, p);
    $_derivative[k] = 0;
    $_integral[k] = force[k] - p[0] * (r[k] - y[k]);
    $_last[k] = y[k];
    $_started[k] = 1;
    for (j = $_first_filter[k]; j < $_first_filter[k + 1]; ++j) {
      const double *q = $_filters + 5 * j; /* b0, b1, b2, a1, a2 */
      $_s2[j] = (q[2] - q[4]) * force[k];
      $_s1[j] = (1 - q[0]) * force[k];
    }
  }
}

static void $_step(const double *y, const double *r, const double *excitation, double omega, double *f) {
  int k, j;
  $_last_speed = omega;
  for (k = 0; k < $_AXES; ++k) {
    double p[5], raw, a;
    const double e = r[k] - y[k];
    $_gains(k, omega, p);
    a = p[3] > 0 ? exp(-$_TS / p[3]) : 0;
    if (!$_started[k]) $_last[k] = y[k];
    $_started[k] = 1;
    $_derivative[k] = a * $_derivative[k] + (1 - a) * (y[k] - $_last[k]) / $_TS;
    $_last[k] = y[k];
    raw = p[0] * e - p[1] * $_derivative[k] + $_integral[k];
    for (j = $_first_filter[k]; j < $_first_filter[k + 1]; ++j) {
      const double *q = $_filters + 5 * j, u = raw;
      raw = q[0] * u + $_s1[j];
      $_s1[j] = q[1] * u - q[3] * raw + $_s2[j];
      $_s2[j] = q[2] * u - q[4] * raw;
    }
    raw += excitation[k];
    if (!((raw > p[4] && e > 0) || (raw < -p[4] && e < 0))) $_integral[k] += p[2] * $_TS * e;
    f[k] = clamped(raw, p[4]);
  }
}
)";

std::string Indices(const char* name, const std::vector<std::size_t>& values) {
  std::string text = std::string("static const int $_") + name + "[] = {";
  for (const std::size_t v : values) text += (text.ends_with('{') ? "" : ", ") + std::to_string(v);
  return text + "};\n";
}

}  // namespace

void DecentralisedPid::WriteC(CCode& c) const {
  const std::string part = c.NewPart();
  c.Define(part, "AXES", static_cast<long>(axes_.size()));
  c.Define(part, "TS", Ts_);
  const auto column = [&](const char* name, double PidParameters::*at) {
    std::vector<double> values;
    for (const PidParameters& p : axes_) values.push_back(p.*at);
    c.Constant(part, name, values);
  };
  column("kp", &PidParameters::kp);
  column("kd", &PidParameters::kd);
  column("ki", &PidParameters::ki);
  column("f_max", &PidParameters::f_max);
  c.Constant(part, "filter", filter_);
  c.Add(part, kPidInC);
  c.Add(part, kTrackByStep);
}

void FilteredPid::WriteC(CCode& c) const {
  const std::string part = c.NewPart();
  std::vector<std::size_t> first_point{0}, first_filter{0};
  std::vector<double> speeds, points, filters;
  for (const FilteredPidAxis& axis : axes_) {
    speeds.insert(speeds.end(), axis.pid.speeds.begin(), axis.pid.speeds.end());
    for (const PidParameters& p : axis.pid.points)
      points.insert(points.end(), {p.kp, p.kd, p.ki, p.derivative_time_constant, p.f_max});
    for (const Biquad& q : axis.filters)
      filters.insert(filters.end(), {q.b0, q.b1, q.b2, q.a1, q.a2});
    first_point.push_back(speeds.size());
    first_filter.push_back(filters.size() / 5);
  }
  c.Define(part, "AXES", static_cast<long>(axes_.size()));
  c.Define(part, "FILTERS", static_cast<long>(filters.size() / 5));
  if (filters.empty()) filters.assign(5, 0.0);  // C has no empty arrays
  c.Define(part, "TS", Ts_);
  c.Constant(part, "speeds", speeds);
  c.Constant(part, "points", points);
  c.Constant(part, "filters", filters);
  c.Add(part, Indices("first_point", first_point) + Indices("first_filter", first_filter));
  c.Add(part, kFilteredPidInC);
  c.Add(part, kTrackByStep);
}

}  // namespace ambrig
