/* Says what it was given, in a way that a test can read from the forces or the message. */
#include <stdio.h>

#include "ambrig_controller.h"

AMBRIG_CONTROLLER_LIBRARY

int ambrig_controller_open(ambrig_controller *c) {
  if (ambrig_parameter(c, "tell", 0) == 0) return 0;
  snprintf(c->message, sizeof c->message, "%u %u %s %s %s %s %g %g %g %u %u", c->axes, c->coils, c->axis_name[0],
           c->axis_name[c->axes - 1], c->coil_name[0], c->coil_name[c->coils - 1], c->period, c->force_limit[0],
           c->current_limit[0], (unsigned)(c->size == sizeof *c), c->version);
  return 1;
}

/* force = [sum of all inputs weighed by their place, last call, ...] */
static double last;

int ambrig_controller_hold(ambrig_controller *c) {
  last = 1000 + c->force[0];
  return 0;
}

int ambrig_controller_track(ambrig_controller *c) {
  last = 2000 + c->force[0];
  return 0;
}

int ambrig_controller_step(ambrig_controller *c) {
  c->force[0] = last;
  c->force[1] = c->time + 10 * c->speed + 100 * c->position[1] + 1000 * c->reference[1] + 10000 * c->excitation[1];
  if (c->axes > 2) c->force[2] = c->current[0] + 10 * c->set_point[1] + 100 * c->duty[2];
  c->command[0] = 1.5;
  c->command[1] = -1;
  c->command[2] = 99;
  return 0;
}
