/// A controller in C++ that throws in its second step.
#include <stdexcept>

#include "ambrig_controller.h"

AMBRIG_CONTROLLER_LIBRARY

int ambrig_controller_open(ambrig_controller*) { return 0; }

int ambrig_controller_step(ambrig_controller* c) {
  static int steps = 0;
  if (++steps == 2) throw std::runtime_error("not again");
  for (uint32_t k = 0; k < c->axes; ++k) c->force[k] = 0;
  return 0;
}
