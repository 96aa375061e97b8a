/* Does what parameter `how` says as soon as the rig turns faster than `from_speed` and t is above 1 ms. */
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

#include "ambrig_controller.h"

AMBRIG_CONTROLLER_LIBRARY

static double how, from_speed;
static volatile int zero;

int ambrig_controller_open(ambrig_controller *c) {
  how = ambrig_parameter(c, "how", 0);
  from_speed = ambrig_parameter(c, "from_speed", -1);
  if (how == 20) return ambrig_fail(c, "no parameter pleases me");
  if (how == 21) return 7;
  if (how == 22)
    for (;;) zero = 0;
  return 0;
}

int ambrig_controller_step(ambrig_controller *c) {
  uint32_t k;
  for (k = 0; k < c->axes; ++k) c->force[k] = -4.0e5 * c->position[k];
  if (c->time < 1e-3 || c->speed <= from_speed) return 0;
  switch ((int)how) {
    case 1:
      zero = 7 / zero; /* 1 / zero would be compiled without a division */
      break;
    case 2:
      c->force[1] = NAN;
      break;
    case 3:
      for (;;) zero = 0;
    case 4:
      *(volatile int *)(intptr_t)(8 + zero) = 1;
      break;
    case 5:
      abort();
    case 6:
      return ambrig_fail(c, "the bearing smells of smoke");
    case 7:
      return 3;
    case 8:
      exit(5);
    case 9:
      c->force[0] = 1.0 / zero;
      break;
    case 10:
      c->command[2] = NAN;
      break;
    case 11:
      raise(SIGKILL);
      break;
    case 12: /* more text than there is room for */
      memset(c->message, 'x', sizeof c->message);
      return 1;
    default:
      break;
  }
  return 0;
}
