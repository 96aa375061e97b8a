/* PI control with damping of every axis, without hold: what the FMU of tests/control/external/fmus computes. */
#include "../fmus/plain_pi.h"
#include "ambrig_controller.h"

AMBRIG_CONTROLLER_LIBRARY

static plain_pi law[16];

int ambrig_controller_open(ambrig_controller *c) {
  (void)c;
  return 0;
}

int ambrig_controller_step(ambrig_controller *c) {
  uint32_t k;
  for (k = 0; k < c->axes && k < 16; ++k)
    c->force[k] = plain_pi_step(&law[k], ambrig_parameter(c, "kp", 3e5), c->reference[k] - c->position[k], c->period);
  return 0;
}
