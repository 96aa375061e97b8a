/* One PID per axis: the controller kind = "pid" of ambrig, written in C. It gives the same bits.
 *
 *   e = r - y;  d_k = a d_(k-1) + (1-a)(y_k - y_(k-1))/Ts,  a = exp(-Ts/tau_d)
 *   f = kp e - kd d + integral + excitation, clamped to the limit;  integral += ki Ts e
 *
 * The increment of the integral is dropped while f is beyond the limit on the side that e pushes to.
 *
 *   cc -std=c99 -O2 -ffp-contract=off -shared -fPIC -I control/external examples/controllers/pid.c -o pid.so -lm
 */
#include <math.h>

#include "ambrig_controller.h"

AMBRIG_CONTROLLER_LIBRARY

#define MOST_AXES 16

typedef struct axis {
  double derivative; /* [m/s] */
  double last;       /* [m] */
  double integral;   /* [N] */
  int started;       /* the first reading has no predecessor */
} axis;

static axis axes[MOST_AXES];
static double kp, kd, ki, filter;

int ambrig_controller_open(ambrig_controller *c) {
  double tau;
  if (c->axes > MOST_AXES) return ambrig_fail(c, "this rig has more than 16 axes");
  kp = ambrig_parameter(c, "kp", 0);
  kd = ambrig_parameter(c, "kd", 0);
  ki = ambrig_parameter(c, "ki", 0);
  tau = ambrig_parameter(c, "derivative_time_constant", 0);
  filter = tau > 0 ? exp(-c->period / tau) : 0;
  if (kp == 0) return ambrig_fail(c, "the rig file gives no kp: parameters = { kp = ..., kd = ..., ki = ... }");
  return 0;
}

int ambrig_controller_hold(ambrig_controller *c) {
  uint32_t k;
  for (k = 0; k < c->axes; ++k) {
    axes[k].derivative = 0;
    axes[k].integral = c->force[k] - kp * (c->reference[k] - c->position[k]);
    axes[k].last = c->position[k];
    axes[k].started = 1;
  }
  return 0;
}

int ambrig_controller_step(ambrig_controller *c) {
  uint32_t k;
  for (k = 0; k < c->axes; ++k) {
    axis *s = &axes[k];
    const double y = c->position[k], e = c->reference[k] - y, limit = c->force_limit[k];
    double raw;
    if (!s->started) s->last = y;
    s->started = 1;
    s->derivative = filter * s->derivative + (1 - filter) * (y - s->last) / c->period;
    s->last = y;
    raw = kp * e - kd * s->derivative + s->integral + c->excitation[k];
    if (!((raw > limit && e > 0) || (raw < -limit && e < 0))) s->integral += ki * c->period * e;
    c->force[k] = raw > limit ? limit : raw < -limit ? -limit : raw;
  }
  return 0;
}
