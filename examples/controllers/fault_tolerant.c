/* A controller that finds an open coil by itself and goes on with the other seven: commands = "currents".
 *
 * Forces are those of one PID per axis. Of every bearing with eight coils and two axes the currents are
 *
 *   i = W [c0, fx/(k c0), fy/(k c0)]'          k: force constant [N/A^2], c0: bias [A]
 *
 * Healthy, row j of W is [1, cos g_j, sin g_j], g_j the angle of pole j. A coil whose current stays below a
 * quarter of what its loop is told for five periods in a row is lost; from then on W is the matrix that gives
 * the same forces with seven coils and no current in the lost one. One table serves all eight coils: losing
 * the next coil is the same bearing turned by 45 degrees. The table is what
 *
 *   ambrig redistribute examples/reference/rig.toml --bearing A --failed 1 --json w.json
 *
 * prints for coil 1. A second loss in one bearing ends the run with a message.
 *
 *   cc -std=c99 -O2 -shared -fPIC -I control/external examples/controllers/fault_tolerant.c -o fault_tolerant.so -lm
 */
#include <math.h>
#include <stdio.h>

#include "ambrig_controller.h"

AMBRIG_CONTROLLER_LIBRARY

#define COILS 8
#define MOST_BEARINGS 4
#define PERIODS_BELOW 5

static const double kWithoutCoil1[COILS][3] = {
    {0, 0, 0},
    {1.5000000002840053, 1.2066544357785736, 1.4029216581630672},
    {0.6976352067785118, -0.5399685710982021, 0.6701638231483008},
    {1.16280533778655, -1.39734232655317, 0.32431088282962756},
    {0.6074718147148409, -0.44790662549526117, -0.18552899895688046},
    {1.162805337786571, -0.7587478102833133, -1.2173926592061877},
    {0.6976352067785023, 0.09206194560294283, -0.8556928221051799},
    {1.500000000284005, 1.84524895204843, -0.13878188387274776}};

typedef struct axis {
  double derivative, last, integral;
} axis;

typedef struct bearing {
  double W[COILS][3];
  int below[COILS]; /* periods in a row in which the current was too small */
  int lost;         /* coil, or -1 */
} bearing;

static axis axes[2 * MOST_BEARINGS];
static bearing bearings[MOST_BEARINGS];
static double kp, kd, ki, filter, force_constant, bias, first_angle;

static double angle_of(int coil) {
  const double pi = 3.14159265358979323846;
  return (first_angle + 45.0 * coil) * pi / 180;
}

static void make_healthy(bearing *b) {
  int j;
  for (j = 0; j < COILS; ++j) {
    b->W[j][0] = 1;
    b->W[j][1] = cos(angle_of(j));
    b->W[j][2] = sin(angle_of(j));
    b->below[j] = 0;
  }
  b->lost = -1;
}

/* The table for coil 1, turned to the lost one. */
static void go_on_without(bearing *b, int lost) {
  const double turn = angle_of(lost) - angle_of(0), c = cos(turn), s = sin(turn);
  int j;
  for (j = 0; j < COILS; ++j) {
    const double *w = kWithoutCoil1[j];
    double *to = b->W[(j + lost) % COILS];
    to[0] = w[0];
    to[1] = c * w[1] - s * w[2];
    to[2] = s * w[1] + c * w[2];
  }
  b->lost = lost;
}

static int watch(ambrig_controller *c, bearing *b, uint32_t first) {
  int j;
  for (j = 0; j < COILS; ++j) {
    const double wanted = c->set_point[first + (uint32_t)j], is = c->current[first + (uint32_t)j];
    const int low = j != b->lost && c->time > 0 && wanted > 0.4 && is < 0.25 * wanted;
    b->below[j] = low ? b->below[j] + 1 : 0;
    if (b->below[j] < PERIODS_BELOW) continue;
    if (b->lost >= 0) {
      snprintf(c->message, sizeof c->message, "%s is lost beside coil %d: no table for two",
               c->coil_name[first + (uint32_t)j], b->lost + 1);
      return 1;
    }
    go_on_without(b, j);
  }
  return 0;
}

int ambrig_controller_open(ambrig_controller *c) {
  uint32_t k;
  if (c->coils != COILS * (c->axes / 2) || c->axes % 2 != 0 || c->axes > 2 * MOST_BEARINGS)
    return ambrig_fail(c, "made for bearings with eight coils and two axes");
  kp = ambrig_parameter(c, "kp", 4.0e5);
  kd = ambrig_parameter(c, "kd", 900);
  ki = ambrig_parameter(c, "ki", 6.0e6);
  filter = exp(-c->period / ambrig_parameter(c, "derivative_time_constant", 1.5e-4));
  force_constant = ambrig_parameter(c, "force_constant", 16.000131384732818);
  bias = ambrig_parameter(c, "bias_current", 2);
  first_angle = ambrig_parameter(c, "first_pole_angle_deg", 22.5);
  for (k = 0; k < c->axes / 2; ++k) make_healthy(&bearings[k]);
  return 0;
}

int ambrig_controller_hold(ambrig_controller *c) {
  uint32_t k;
  for (k = 0; k < c->axes; ++k) {
    axes[k].derivative = 0;
    axes[k].last = c->position[k];
    axes[k].integral = c->force[k] - kp * (c->reference[k] - c->position[k]);
  }
  return 0;
}

static void pid(ambrig_controller *c) {
  uint32_t k;
  for (k = 0; k < c->axes; ++k) {
    axis *s = &axes[k];
    const double y = c->position[k], e = c->reference[k] - y, limit = c->force_limit[k];
    double raw;
    s->derivative = filter * s->derivative + (1 - filter) * (y - s->last) / c->period;
    s->last = y;
    raw = kp * e - kd * s->derivative + s->integral + c->excitation[k];
    if (fabs(raw) < limit || raw * e < 0) s->integral += ki * c->period * e;
    c->force[k] = fmax(-limit, fmin(limit, raw));
  }
}

int ambrig_controller_step(ambrig_controller *c) {
  uint32_t b;
  int j;
  pid(c);
  for (b = 0; b < c->axes / 2; ++b) {
    const double vx = c->force[2 * b] / (force_constant * bias), vy = c->force[2 * b + 1] / (force_constant * bias);
    const uint32_t first = COILS * b;
    if (watch(c, &bearings[b], first)) return 1;
    for (j = 0; j < COILS; ++j) {
      const double *w = bearings[b].W[j];
      c->command[first + (uint32_t)j] = w[0] * bias + w[1] * vx + w[2] * vy;
    }
  }
  return 0;
}
